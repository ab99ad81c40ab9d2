import numpy as np
import vkhausdorff as vkh

x, y = np.mgrid[0:33, 0:33].reshape(2, -1) / 32
vertices = np.stack([x, y, 0.1 * np.sin(5 * x) * np.cos(4 * y)], axis=-1)
corner = np.flatnonzero((x < 1) & (y < 1))
faces = np.concatenate([np.stack([corner, corner + 33, corner + 1], axis=-1),
                        np.stack([corner + 1, corner + 33, corner + 34], axis=-1)])

chain = vkh.simplify_levels((vertices, faces), max="5%", levels=5, ratio=0.5)
levels = [(0.0, len(faces)), *((level.interval.upper, len(level.faces)) for level in chain)]  # level 0 is A
for distance in (1, 10, 100):
    pixel = distance * 2 * np.tan(np.radians(60) / 2) / 1080  # of 1,080 over 60 degrees
    drawn = max(k for k, (error, _) in enumerate(levels) if error <= pixel)
    print(f"from {distance} away: level {drawn}, {levels[drawn][1]} faces")
