#!/usr/bin/env python3
"""Draws docs/images/answer.png: the demo's part, each face coloured by its certified distance.

usage: tools/docs/answer_picture.py --pair out/tools/vkh_demo_pair --out docs/images/answer.png
                                    [--intervals FILE.npy]

Runs the Python module once for the whole pair, and once for each face of A alone, with B's hierarchy
kept: h(face, B) lies in an interval, and its upper end is the colour. A face's tolerance is 0.001 mm.
On lavapipe that took eleven minutes, beside other jobs; --intervals keeps the faces' intervals in a
file, or takes them from it. First: cmake --build out --target vkh_demo_pair; tools/setup
--benchmarks; PYTHONPATH=out/host/python.
"""
import argparse
import dataclasses
import decimal
import io
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  after the choice of a back end without a display
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402  matplotlib needs it anyway

FACE_TOLERANCE = "0.001abs"
ONE_FACE = np.array([[0, 1, 2]])
COLOURS = 256  # of the picture's palette, so that it stays small
PANEL = (540, 430)


@dataclasses.dataclass(frozen=True)
class View:
    title: str
    eye: tuple  # from the part to the viewer
    light: tuple


ABOVE = View("A from above", (0.42, -0.66, 0.62), (0.15, -0.55, 0.82))
BELOW = View("and from below", (-0.30, 0.55, -0.78), (-0.25, 0.35, -0.90))


def read_off(path):
    words = pathlib.Path(path).read_text().split()
    vertex_count, face_count = int(words[1]), int(words[2])
    split = 4 + 3 * vertex_count
    vertices = np.array(words[4:split], dtype=np.float64).reshape(-1, 3)
    faces = np.array(words[split:], dtype=np.int64).reshape(face_count, 4)[:, 1:]
    return vertices, faces


def demo_pair(program):
    with tempfile.TemporaryDirectory() as folder:
        paths = [str(pathlib.Path(folder) / name) for name in ("a.off", "b.off")]
        subprocess.run([program, *paths], check=True)
        return [read_off(path) for path in paths]


def face_intervals(vkh, a, b):
    (va, fa), (vb, fb) = a, b
    intervals = np.empty((len(fa), 2))
    with vkh.Solver(vb, fb) as solver:
        for i, face in enumerate(fa):
            r = solver.distance(va[face], ONE_FACE, tol=FACE_TOLERANCE)
            intervals[i] = r.lower, r.upper
    return intervals


def unit(v):
    return np.array(v) / np.linalg.norm(v)


def project(view, vertices, size):
    """Pixel coordinates and depth (larger: nearer), without perspective."""
    back = unit(view.eye)
    right = unit(np.cross([0.0, 0.0, 1.0], back))
    up = np.cross(back, right)
    x, y, z = vertices @ right, vertices @ up, vertices @ back
    scale = 0.96 * min(size[0] / np.ptp(x), size[1] / np.ptp(y))
    px = (x - (x.max() + x.min()) / 2) * scale + size[0] / 2
    py = (y - (y.max() + y.min()) / 2) * -scale + size[1] / 2
    return px, py, z


def rasterise(view, vertices, faces, size):
    """The face that is seen in each pixel, -1 where there is none."""
    px, py, z = project(view, vertices, size)
    seen = np.full((size[1], size[0]), -1)
    depth = np.full((size[1], size[0]), -np.inf)
    for i, (a, b, c) in enumerate(faces):
        area = (px[b] - px[a]) * (py[c] - py[a]) - (px[c] - px[a]) * (py[b] - py[a])
        if area >= 0:  # seen from behind (y points down), or edge on
            continue
        x0, x1 = int(np.ceil(min(px[[a, b, c]]))), int(np.floor(max(px[[a, b, c]]))) + 1
        y0, y1 = int(np.ceil(min(py[[a, b, c]]))), int(np.floor(max(py[[a, b, c]]))) + 1
        if x0 >= x1 or y0 >= y1:
            continue
        gx, gy = np.meshgrid(np.arange(x0, x1), np.arange(y0, y1))
        v = ((gx - px[a]) * (py[c] - py[a]) - (px[c] - px[a]) * (gy - py[a])) / area
        w = ((px[b] - px[a]) * (gy - py[a]) - (gx - px[a]) * (py[b] - py[a])) / area
        at = z[a] + v * (z[b] - z[a]) + w * (z[c] - z[a])
        old = depth[y0:y1, x0:x1]
        inside = (v >= 0) & (w >= 0) & (v + w <= 1) & (at > old)
        old[inside] = at[inside]
        seen[y0:y1, x0:x1][inside] = i
    return seen


def shades(view, vertices, faces):
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals /= np.where(lengths > 0, lengths, 1)
    return (0.62 + 0.38 * np.clip(normals @ unit(view.light), 0, 1))[:, None]


def paint(view, a, values, top, size, scale=3):
    """RGB, each pixel the mean of scale x scale."""
    vertices, faces = a
    seen = rasterise(view, vertices, faces, (size[0] * scale, size[1] * scale))
    colours = plt.get_cmap("viridis")(np.clip(values / top, 0, 1))[:, :3] * shades(view, vertices, faces)
    fine = np.where(seen[..., None] >= 0, colours[seen], 1.0)
    return fine.reshape(size[1], scale, size[0], scale, 3).mean(axis=(1, 3))


def outward(value, rounding):
    return decimal.Decimal(value).quantize(decimal.Decimal("0.000001"), rounding)


def caption(a, b, report):
    lower = outward(report.lower, decimal.ROUND_FLOOR)
    upper = outward(report.upper, decimal.ROUND_CEILING)
    return (f"A: coupling hub, {len(a[1]):,} faces. B: the same with {len(b[1]):,}. "
            f"{lower} mm <= h(A,B) <= {upper} mm")


def save(figure, path):
    buffer = io.BytesIO()
    figure.savefig(buffer)
    image = Image.open(buffer).convert("RGB").quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    image.save(path, optimize=True)


def draw(a, b, intervals, report, path):
    figure = plt.figure(figsize=(11.8, 5.2), dpi=100)
    for view, left in ((ABOVE, 0.005), (BELOW, 0.463)):
        axis = figure.add_axes((left, 0.13, PANEL[0] / 1180, PANEL[1] / 520))
        axis.imshow(paint(view, a, intervals[:, 1], report.upper, PANEL))
        axis.set_title(view.title, fontsize=10, y=0.98)
        axis.axis("off")
    # The witness is the first of the points that are projected together with A's.
    x, y, _ = (c[0] for c in project(BELOW, np.vstack([[report.witness_a], a[0]]), PANEL))
    axis.annotate("witness: at least\nlower away from B", (x, y), xytext=(PANEL[0] - 70, 22), fontsize=9.5, ha="center",
                  arrowprops={"arrowstyle": "->", "color": "crimson", "lw": 1.6}, color="crimson")
    scale = plt.cm.ScalarMappable(plt.Normalize(0, report.upper), "viridis")
    bar = figure.colorbar(scale, cax=figure.add_axes((0.935, 0.18, 0.016, 0.68)))
    bar.ax.set_title("mm", fontsize=9)
    bar.ax.tick_params(labelsize=8.5)
    figure.text(0.5, 0.065, caption(a, b, report), ha="center", fontsize=11)
    figure.text(0.5, 0.02, "Colour of a face: a proven upper bound of its largest distance from B.",
                ha="center", fontsize=9.5, color="0.35")
    save(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pair", required=True, help="the program that writes the pair: vkh_demo_pair")
    parser.add_argument("--out", required=True)
    parser.add_argument("--intervals", type=pathlib.Path)
    args = parser.parse_args()
    import vkhausdorff as vkh

    a, b = demo_pair(args.pair)
    report = vkh.distance(*a, *b)
    if args.intervals and args.intervals.exists():
        intervals = np.load(args.intervals)
    else:
        intervals = face_intervals(vkh, a, b)
        if args.intervals:
            np.save(args.intervals, intervals)
    # The largest of the faces' intervals and that of the pair enclose the same number.
    if intervals[:, 0].max() > report.upper or intervals[:, 1].max() < report.lower:
        sys.exit("answer_picture: the faces' intervals and the pair's do not meet")
    draw(a, b, intervals, report, args.out)


if __name__ == "__main__":
    main()
