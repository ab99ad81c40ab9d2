import numpy as np
import vkhausdorff as vkh

a = np.zeros((24, 24, 24), dtype=bool)
b = np.zeros((24, 24, 24), dtype=bool)
a[4:20, 4:20, 4:20] = True
b[4:20, 4:20, 6:20] = True

m = vkh.metrics(a, b, spacing=(1.0, 1.0, 2.5), percentile=95, bands=[0.5])
print(m.hd95.lower, m.hd95.upper, m.assd.estimate, m.f1[0.5], m.met)
