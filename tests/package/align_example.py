import numpy as np
import vkhausdorff as vkh

part = vkh.read("part.ply")
turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
scan = (np.asarray(part.vertices) @ turn.T + [5, 0, 0], part.faces)

fit = vkh.align(scan, part)
print(fit.matrix, fit.rms, fit.share, fit.rival)
r = vkh.gate(scan, part, 0.001, transform=fit.matrix)  # as align=True does
print(r.verdict, r.stats["transform"]["matrix"])
