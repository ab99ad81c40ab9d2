import numpy as np
import vkhausdorff as vkh

va = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=np.float64)
vb = va + [0, 0, 0.25]
faces = np.array([[0, 1, 2]])

r = vkh.distance(va, faces, vb, faces, certificate="part.vhc")
print(r.upper, r.stats["certificate"]["upper"])  # asked, and proven

for name, vertices in (("a.obj", va), ("b.obj", vb)):  # repr() keeps all bits of a double
    with open(name, "w") as out:
        out.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist())
        out.writelines(f"f {i} {j} {k}\n" for i, j, k in (faces + 1).tolist())
