import numpy as np
import vkhausdorff as vkh

x, y = np.mgrid[0:9, 0:9].reshape(2, -1)
vertices = np.stack([x, y, 0.001 * x * y], axis=-1)
corner = np.flatnonzero((x < 8) & (y < 8))
faces = np.concatenate([np.stack([corner, corner + 9, corner + 1], axis=-1),
                        np.stack([corner + 1, corner + 9, corner + 10], axis=-1)])

light = vkh.simplify((vertices, faces), max=0.1)
print(light, light.interval)
assert vkh.gate((vertices, faces), light, 0.1, symmetric=True).verdict == "pass"
