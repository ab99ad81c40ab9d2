import numpy as np
import vkhausdorff as vkh

t = np.linspace(0, 1, 20)
faces = np.array([[i, i + 1, i + 20] for i in range(19)])
reference = np.vstack([np.c_[t, t**2, 0 * t], np.c_[t, t, 0 * t + 1]]), faces
parts = {f"part {k}": (reference[0] * (1 + k / 100), faces) for k in range(5)}

for r in vkh.distances(((name, part, reference) for name, part in parts.items()), tol=1e-4):
    print(r.index, r.id, r.error or f"{r.lower} <= h <= {r.upper}")

with vkh.distances(
    [*parts.items(), ("gone", "gone.stl")], against=reference, max=0.05
) as results:
    for r in results:
        print(r.id, r.verdict if r.error is None else r.error)
