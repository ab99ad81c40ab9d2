import numpy as np
import vkhausdorff as vkh

va = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=np.float64)
vb = va + [0, 0, 0.25]
faces = np.array([[0, 1, 2]])

r = vkh.distance(va, faces, vb, faces, tol=1e-6, symmetric=True)
print(r.lower, r.upper, r.closed, r.witness_a, r.face_b)

with vkh.Solver(vb, faces) as solver:  # B's BVH is built once
    for scale in (1, 2, 3):
        r = solver.distance(va * scale, faces, time=10)
        print(f"{r.lower} <= h <= {r.upper}: {r.status}")
