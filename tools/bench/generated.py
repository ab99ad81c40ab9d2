#!/usr/bin/env python3
"""Holds the program, or the module on PYTHONPATH, against inputs that are made here, whose answers are known. Needs numpy.

  tools/bench/generated.py --what poses FOLDER [--count 10] [--noise 0.001]
  tools/bench/generated.py --what closest [--faces 100000] [--points 100000]
  tools/bench/generated.py --what sided [--count 2000] [--seed 1]
  tools/bench/generated.py --what points PROGRAM MESH.ply [--points N] [--noise 0.001] [--seed 1] [--folder D] [--back] [--extra W]
  tools/bench/generated.py --what moved RESULTS.jsonl MOVES.csv BASE_RESULTS.jsonl

poses     fits of scans in random poses. A scan of a mesh of FOLDER is moved by normal noise, a share of the diagonal, and posed:
          whole, anywhere; half of its faces (on one side of a plane) turned by up to 20 degrees and moved by 5 % of the
          diagonal; or half of them, anywhere. A fit is back if its error (root mean square, without the noise) is under a tenth
          of the noise's deviation. Fewer than 15,000 vertices, or a symmetry, do not average the noise to that.
closest   times Solver.closest on a bumpy sphere of about this many faces, and measures its widths.
sided     limits that differ by side: A is a surface of random heights over a plate, multiples of 2^-12, B the plate, a box or a
          sheet, looking up or down; limits lie about the largest heights. Exits with 1 for a false verdict.
points    times --points on clouds near a mesh, binary little-endian PLY of triangles with x, y and z alone, such as vkh_noise
          writes: as PLY and as LAS, of any size. One that is there is used again. --back asks from MESH to the cloud.
moved     a batch's results of vkh_moved's pairs: each interval, divided by its power of two, must meet its base's, exactly.
"""

import argparse
import collections
import csv
import json
import os
import pathlib
import random
import re
import shlex
import struct
import subprocess
import sys
import time
from fractions import Fraction

import numpy as np

# ---- poses ----


def turn_of(q):
    x, y, z, w = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def scan_of(points, faces, kind, noise, rng):
    """The scan, its faces, and the places of its vertices before and after the pose, without noise."""
    diagonal, rows = np.linalg.norm(np.ptp(points, axis=0)), np.arange(len(points))
    if kind != "whole":
        height = points[faces].mean(1) @ rng.normal(size=3)
        kept = faces[height <= np.median(height)]
        rows, faces = np.unique(kept, return_inverse=True)
        faces = faces.reshape(kept.shape)
    if kind == "half20":
        axis, angle = rng.normal(size=3), np.radians(rng.uniform(0, 20))
        turn = turn_of(np.append(axis / np.linalg.norm(axis) * np.sin(angle / 2), np.cos(angle / 2)))
        shift = rng.uniform(-1, 1, 3) * 0.05 * diagonal
    else:
        turn, shift = turn_of(rng.normal(size=4)), rng.normal(size=3) * diagonal
    centre, truth = points.mean(0), points[rows]
    moved = lambda p: (p - centre) @ turn.T + centre + shift
    return moved(truth + rng.normal(size=truth.shape) * noise * diagonal), faces, truth, moved(truth)


def poses(args):
    import vkhausdorff as vkh
    meshes = [vkh.read(path) for path in sorted(pathlib.Path(args.words[0]).glob("*.ply"))]
    for kind in ("whole", "half20", "half"):
        back = near = told = 0
        for mesh in meshes:
            points, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
            deviation, errors, seconds = args.noise * np.linalg.norm(np.ptp(points, axis=0)), [], []
            for pose in range(args.count or 10):
                scan, of_scan, truth, posed = scan_of(points, faces, kind, args.noise, np.random.default_rng([pose, 7]))
                start = time.time()
                fit = vkh.align((scan, of_scan), mesh)
                seconds.append(time.time() - start)
                off = posed @ fit.matrix[:3, :3].T + fit.matrix[:3, 3] - truth
                errors.append(np.sqrt((off * off).sum(1).mean()) / deviation)
                told += errors[-1] > 1 and (fit.poor or fit.rival is not None)
            back, near = back + sum(e < 0.1 for e in errors), near + sum(e < 1 for e in errors)
            print(f"{kind} {mesh.name}: {sum(e < 0.1 for e in errors)} of {len(errors)} back, {sum(e < 1 for e in errors)} within the noise, "
                  f"median error {np.median(errors):.3f}, largest {max(errors):.3g}, {np.median(seconds):.2f} s", flush=True)
        print(f"{kind}: {back} back, {near} within the noise, {told} of the others told by a note", flush=True)


# ---- closest ----


def bumpy_sphere(cells):
    rows = cells // 2 + 1
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, cells, endpoint=False), np.linspace(0, np.pi, rows), indexing="ij")
    r = 1 + 0.05 * np.sin(7 * u) * np.sin(5 * v)
    vertices = np.stack([r * np.sin(v) * np.cos(u), r * np.sin(v) * np.sin(u), r * np.cos(v)], -1).reshape(-1, 3)
    i, j = np.arange(cells)[:, None], np.arange(rows - 1)[None, :]
    a, b = i * rows + j, (i + 1) % cells * rows + j
    return vertices, np.concatenate([np.stack(f, -1).reshape(-1, 3) for f in ((a, b, a + 1), (b, b + 1, a + 1))])


def closest(args):
    import vkhausdorff as vkh
    vertices, faces = bumpy_sphere(int(args.faces ** 0.5))
    rng, count = np.random.default_rng(0), args.points
    directions = rng.normal(size=(count, 3))
    near = directions / np.linalg.norm(directions, axis=1)[:, None] * (1 + 0.05 * rng.normal(size=(count, 1)))
    print(f"{len(faces)} faces, {count} points")
    with vkh.Solver(vertices, faces) as solver:
        box = rng.uniform(-1.5, 1.5, (count, 3))
        solver.closest(box[:10])  # pipelines
        for name, points in (("in the box", box), ("near", near)) * 2:
            wall, cores = time.perf_counter(), time.process_time()
            r = solver.closest(points)
            wall, cores = time.perf_counter() - wall, time.process_time() - cores
            width = r.upper - r.lower
            print(f"{name}: {wall:.2f} s, {cores:.2f} s of all cores; width mean {width.mean():.1e}, most {width.max():.1e}, "
                  f"of the distance {np.median(width / r.upper):.1e} (median)")


# ---- sided ----


def grid(n, heights, size=1.0):
    points = [(size * i / n, size * j / n, heights[i][j]) for i in range(n + 1) for j in range(n + 1)]
    corners = [(i * (n + 1) + j, (i + 1) * (n + 1) + j) for i in range(n) for j in range(n)]
    return np.array(points), np.array([t for a, b in corners for t in ((a, b, b + 1), (a, b + 1, a + 1))])


def plate(kind, rng):
    """A plate whose upper side is z = 0, far wider than A, and thicker than any height."""
    if kind == "box":
        corners = np.array([[(-2, -2, -4)[i] if not k >> i & 1 else (3, 3, 0)[i] for i in range(3)] for k in range(8)], float)
        quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        return corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    n = 1 + rng.randrange(4)
    vertices, faces = grid(n, [[0.0] * (n + 1) for _ in range(n + 1)], 5.0)
    return vertices - np.array([2, 2, 0]), faces


def sided(args):
    import vkhausdorff as vkh
    counts, wrong, total = collections.Counter(), 0, args.count or 2000
    for k in range(total):
        rng = random.Random(args.seed * 1000003 + k)
        n, tilt = 1 + rng.randrange(4), rng.choice((-0.3, 0.0, 0.0, 0.3))
        heights = [[round((tilt + rng.uniform(-0.4, 0.4) * rng.choice((1, 0.1))) * 4096) / 4096 for _ in range(n + 1)] for _ in range(n + 1)]
        flat = [h for row in heights for h in row]
        sides = [max(0.0, *flat), max(0.0, *(-h for h in flat))]
        limits = [max(1 / 4096, x + rng.choice((-1, 1)) * rng.choice((1, 3, 40, 400)) / 4096) for x in sides]
        kind = rng.choice(("box", "sheet"))
        a, b = grid(n, heights), plate(kind, rng)
        if rng.random() < 0.5:  # B looks down: over and under change places
            b, sides, limits = (b[0], b[1][:, ::-1]), sides[::-1], limits[::-1]
        verdict = vkh.gate(a, b, f"+{limits[0]!r}abs,-{limits[1]!r}abs", effort=200000).verdict
        truth = "pass" if sides[0] <= limits[0] and sides[1] <= limits[1] else "fail"
        counts[kind, truth, verdict] += 1
        wrong += verdict not in (truth, "undecided")
        if verdict != truth:
            print("undecided" if verdict == "undecided" else "WRONG", k, kind, truth, verdict, sides, limits)
    for key, count in sorted(counts.items()):
        print(*key, count)
    print(f"{total} pairs, {wrong} wrong")
    return wrong > 0


# ---- points ----


def read_ply(path):
    head, body = pathlib.Path(path).read_bytes().split(b"end_header\n", 1)
    head = head.decode()
    vertices, faces = (int(re.search(rf"element {name} (\d+)", head)[1]) for name in ("vertex", "face"))
    real = np.dtype("<f8" if "property double x" in head else "<f4")
    if "format binary_little_endian" not in head or len(body) != vertices * 3 * real.itemsize + 13 * faces:
        sys.exit(f"{path}: expected a binary little-endian PLY of vertices of x, y and z alone, and triangles")
    corners = np.frombuffer(body[vertices * 3 * real.itemsize:], dtype=[("count", "u1"), ("at", "<i4", 3)])
    return np.frombuffer(body, dtype=real, count=3 * vertices).reshape(-1, 3).astype(np.float64), corners["at"]


def cloud(args):
    """Chunks of points near a mesh, uniform over its area: the same ones for a seed."""
    vertices, faces = read_ply(args.words[1])
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    ab, ac, rng = b - a, c - a, np.random.default_rng(args.seed)
    areas = np.cumsum(np.linalg.norm(np.cross(ab, ac), axis=1))
    noise = args.noise * np.ptp(vertices, axis=0).max()
    for first in range(0, args.points, 1 << 22):
        n = min(1 << 22, args.points - first)
        at = np.minimum(np.searchsorted(areas / areas[-1], rng.random(n)), len(areas) - 1)
        u, v = rng.random((2, n, 1))
        u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
        yield a[at] + u * ab[at] + v * ac[at] + noise * rng.standard_normal((n, 3))


def write_ply(args, out):
    out.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {args.points}\n"
               "property float x\nproperty float y\nproperty float z\nend_header\n").encode())
    for points in cloud(args):
        out.write(points.astype("<f4").tobytes())


def write_las(args, out):
    """LAS 1.2, point format 0: 20 bytes a point. The scale is a power of two."""
    vertices, _ = read_ply(args.words[1])
    origin, step = vertices.min(axis=0), 2.0 ** (np.ceil(np.log2(np.ptp(vertices, axis=0).max())) - 24)
    head = bytearray(227)
    head[0:4], head[24], head[25] = b"LASF", 1, 2
    struct.pack_into("<HII", head, 94, 227, 227, 0)
    struct.pack_into("<HI", head, 105, 20, args.points)
    struct.pack_into("<6d", head, 131, step, step, step, *origin)
    out.write(head)
    for points in cloud(args):
        rows = np.zeros(len(points), dtype=[("at", "<i4", 3), ("rest", "u1", 8)])
        rows["at"] = np.rint((points - origin) / step)
        out.write(rows.tobytes())


def points(args):
    program, mesh = args.words
    for kind, write in (("ply", write_ply), ("las", write_las)):
        path = args.folder / f"{pathlib.Path(mesh).stem}_{args.points}_{args.noise}_{args.seed}.{kind}"
        if not path.exists():
            with open(path, "wb") as out:
                write(args, out)
        pair = [mesh, path, "--points", "b"] if args.back else [path, mesh, "--points", "a"]
        for _ in range(args.count or 3):
            start = time.monotonic()
            with subprocess.Popen([program, "distance", *pair, *shlex.split(args.extra), "--json"], stdout=subprocess.PIPE) as process:
                text = process.stdout.read()
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
            seconds, answer = time.monotonic() - start, json.loads(text)
            if "error" in answer:
                sys.exit(f"{path.name}: {answer['error']['message']}")
            way, whole = answer["directions"][0], answer["times"]
            print(f"{path.name}: {seconds:.2f} s; read {whole['read_ms'] / 1000:.2f}, start {whole['start_ms'] / 1000:.2f}, "
                  f"upload {way['times']['upload_ms'] / 1000:.2f}, BVH {way['times']['hierarchy_ms'] / 1000:.2f}, "
                  f"search {way['times']['solve_ms'] / 1000:.2f}; [{answer['interval']['lower']!r}, {answer['interval']['upper']!r}] "
                  f"{answer['status']}; host {usage.ru_maxrss / 2 ** 20:.2f} GiB, workspace {way['counts']['workspace_bytes'] / 2 ** 30:.2f} GiB; "
                  f"{answer['device']['name']}", flush=True)


# ---- moved ----


def intervals(path):
    found, without = {}, []
    with open(path) as lines:
        for result in map(json.loads, lines):
            if "interval" not in result:
                without.append(result["id"])
                continue
            ends = (result["interval"][key] for key in ("lower_hex", "upper_hex"))
            found[result["id"]] = [Fraction(float.fromhex(end)) if end != "inf" else None for end in ends]
    return found, without


def moved(args):
    (results, without), (bases, _) = intervals(args.words[0]), intervals(args.words[2])
    wrong, checked = [], 0
    with open(args.words[1]) as moves:
        for row in csv.DictReader(moves):
            if row["id"] not in results:
                continue
            (lower, upper), factor = results[row["id"]], Fraction(2) ** int(row["exponent"])
            base_lower, base_upper = (end * factor for end in bases[row["base"]])
            checked += 1
            if lower > base_upper or upper is None or upper < base_lower:
                wrong.append(row["id"])
    print(f"{checked} checked, {len(wrong)} do not meet their base's interval, {len(without)} without an interval", *(wrong + without)[:10])
    return 1 if wrong or without or not checked else 0


WHATS = {"poses": (poses, 1), "closest": (closest, 0), "sided": (sided, 0), "points": (points, 2), "moved": (moved, 3)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--what", choices=WHATS, required=True)
    parser.add_argument("words", nargs="*")
    parser.add_argument("--count", type=int, help="poses of a mesh, pairs, or runs of a cloud")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--noise", type=float, default=1e-3, help="its deviation: a share of the diagonal, or of a cloud's extent")
    parser.add_argument("--faces", type=int, default=100_000)
    parser.add_argument("--points", type=int, default=100_000)
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--back", action="store_true")
    parser.add_argument("--extra", default="", help="more words for the program")
    args = parser.parse_args()
    what, words = WHATS[args.what]
    if len(args.words) != words:
        parser.error(f"--what {args.what}: expected {words} words")
    return what(args)


if __name__ == "__main__":
    sys.exit(main())
