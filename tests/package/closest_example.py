import numpy as np
import vkhausdorff as vkh

vb = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=np.float64)
faces = np.array([[0, 1, 2]])
points = np.array([[0.25, 0.25, 0.5], [2, 0, 0]])

distances, closest, rows = vkh.closest((vb, faces), points)
print(distances, closest, rows)  # rows: of B's faces

with vkh.Solver(vb, faces) as solver:  # for many calls with one B
    r = solver.closest(points)
    print(r.lower, r.upper, r.points, r.faces)
