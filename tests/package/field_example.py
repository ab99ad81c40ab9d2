import numpy as np
import vkhausdorff as vkh

va = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=np.float64)
vb = va * 4 - [1, 1, 0.25]
faces = np.array([[0, 1, 2]])

r = vkh.distance(va, faces, vb, faces, field=True, statistics=True, bands=(0.1, 0.3))
print(r.field.lower, r.field.upper)  # a row for each face of A
print(r.mean.lower, r.mean.upper, r.rms, r.percentiles[0.95])
print(r.area_within(0.3))  # the share of A's area

print(vkh.gate((va, faces), (vb, faces), max=0.3, area="99.5%").verdict)
