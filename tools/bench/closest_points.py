#!/usr/bin/env python3
"""Times Solver.closest on a bumpy sphere, and measures its widths. PYTHONPATH names the built module.

usage: closest_points.py [CELLS [POINTS]]: about CELLS^2 faces
"""
import sys
import time

import numpy as np
import vkhausdorff as vkh


def bumpy_sphere(cells):
    rows = cells // 2 + 1
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, cells, endpoint=False), np.linspace(0, np.pi, rows), indexing="ij")
    r = 1 + 0.05 * np.sin(7 * u) * np.sin(5 * v)
    vertices = np.stack([r * np.sin(v) * np.cos(u), r * np.sin(v) * np.sin(u), r * np.cos(v)], -1).reshape(-1, 3)
    i, j = np.arange(cells)[:, None], np.arange(rows - 1)[None, :]
    a, b = i * rows + j, (i + 1) % cells * rows + j
    return vertices, np.concatenate([np.stack(f, -1).reshape(-1, 3) for f in ((a, b, a + 1), (b, b + 1, a + 1))])


def main():
    cells, count = (int(x) for x in (sys.argv[1:] + ["316", "100000"][len(sys.argv) - 1:]))
    vertices, faces = bumpy_sphere(cells)
    random = np.random.default_rng(0)
    directions = random.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    near = directions * (1 + 0.05 * random.normal(size=(count, 1)))
    print(f"{len(faces)} faces, {count} points")
    with vkh.Solver(vertices, faces) as solver:
        box = random.uniform(-1.5, 1.5, (count, 3))
        solver.closest(box[:10])  # pipelines
        for name, points in (("in the box", box), ("near", near)) * 2:
            wall, cores = time.perf_counter(), time.process_time()
            r = solver.closest(points)
            wall, cores = time.perf_counter() - wall, time.process_time() - cores
            width = r.upper - r.lower
            print(f"{name}: {wall:.2f} s, {cores:.2f} s of all cores; width mean {width.mean():.1e}, most {width.max():.1e}, "
                  f"of the distance {np.median(width / r.upper):.1e} (median)")


if __name__ == "__main__":
    main()
