#!/usr/bin/env python3
"""Times --points on clouds of any size: makes one near a mesh, as binary PLY and LAS, and measures the program on both.

usage: points_bench.py PROGRAM MESH [--points N] [--noise SIGMA] [--seed S] [--folder D] [--formats ply,las] [--back]
                       [--times 3] [--more "--stats"]

MESH is a binary little-endian PLY of triangles with float or double columns x, y, z alone, such as out/tools/vkh_noise writes:

    out/tools/vkh_noise --faces 1000000 --seed 1 --out torus.ply
    tools/bench/points_bench.py out/vkhausdorff torus.ply --points 100000000 --folder /tmp

Each point lies on a random face, by its area, and is moved along each axis by noise of the deviation SIGMA, a share of the
mesh's largest extent [1e-3]. A cloud of 100 million points takes 1.2 GB as PLY (float) and 2 GB as LAS, and about a minute
to make; one that is there is used again. Prints a line a run: the whole time, what of it was reading, the start and the
search, the interval, and the host's largest memory; the device's is the workspace. --back asks from MESH to the cloud.
Needs numpy."""

import argparse
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import time

import numpy as np

CHUNK = 1 << 22
LAS_STEP = 2.0 ** -24  # of the largest extent: an exact scale


def read_ply(path):
    data = pathlib.Path(path).read_bytes()
    head, body = data.split(b"end_header\n", 1)
    head = head.decode()
    if "format binary_little_endian" not in head:
        sys.exit(f"{path}: expected a binary little-endian PLY")
    vertices, faces = (int(re.search(rf"element {name} (\d+)", head)[1]) for name in ("vertex", "face"))
    real = "<f8" if "property double x" in head else "<f4"
    size = vertices * 3 * np.dtype(real).itemsize
    corners = np.frombuffer(body[size:], dtype=[("count", "u1"), ("at", "<i4", 3)])
    if len(body) - size != 13 * faces or len(corners) != faces or (corners["count"] != 3).any():
        sys.exit(f"{path}: expected vertices of x, y and z alone, and triangles")
    return np.frombuffer(body[:size], dtype=real).reshape(-1, 3).astype(np.float64), corners["at"]


class Cloud:
    """Chunks of points near a mesh: the same ones for a seed."""

    def __init__(self, mesh, count, noise, seed):
        vertices, faces = read_ply(mesh)
        self.a, b, c = (vertices[faces[:, i]] for i in range(3))
        self.ab, self.ac = b - self.a, c - self.a
        areas = np.linalg.norm(np.cross(self.ab, self.ac), axis=1)
        self.upto = np.cumsum(areas) / areas.sum()
        self.origin, self.size = vertices.min(axis=0), float(np.ptp(vertices, axis=0).max())
        self.count, self.noise, self.seed = count, noise * self.size, seed

    def chunks(self):
        rng = np.random.default_rng(self.seed)
        for first in range(0, self.count, CHUNK):
            n = min(CHUNK, self.count - first)
            at = np.minimum(np.searchsorted(self.upto, rng.random(n)), len(self.upto) - 1)
            u, v = rng.random((2, n, 1))
            u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
            yield self.a[at] + u * self.ab[at] + v * self.ac[at] + self.noise * rng.standard_normal((n, 3))

    def write_ply(self, path):
        with open(path, "wb") as out:
            out.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {self.count}\n"
                       "property float x\nproperty float y\nproperty float z\nend_header\n").encode())
            for points in self.chunks():
                out.write(points.astype("<f4").tobytes())

    def write_las(self, path):
        """LAS 1.2, point format 0: 20 bytes a point."""
        step = LAS_STEP * 2.0 ** np.ceil(np.log2(self.size))
        head = bytearray(227)
        head[0:4], head[24], head[25] = b"LASF", 1, 2
        struct.pack_into("<HII", head, 94, 227, 227, 0)
        struct.pack_into("<HI", head, 105, 20, self.count)
        struct.pack_into("<6d", head, 131, step, step, step, *self.origin)
        with open(path, "wb") as out:
            out.write(head)
            for points in self.chunks():
                rows = np.zeros(len(points), dtype=[("at", "<i4", 3), ("rest", "u1", 8)])
                rows["at"] = np.rint((points - self.origin) / step)
                out.write(rows.tobytes())


def run(program, words):
    """The answer, the seconds from start to end, and the most memory that the process held."""
    start = time.monotonic()
    with subprocess.Popen([program, *words, "--json"], stdout=subprocess.PIPE) as process:
        text = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    seconds = time.monotonic() - start
    if process.returncode not in (0, 3):
        sys.exit(f"{' '.join(words)}: exit code {process.returncode}\n{text.decode()}")
    return json.loads(text), seconds, usage.ru_maxrss * 1024


def line_of(name, answer, seconds, peak):
    way = answer["directions"][0]
    times = way["times"]
    return (f"{name}: {seconds:.2f} s; read {answer['times']['read_ms'] / 1000:.2f}, start {answer['times']['start_ms'] / 1000:.2f}, "
            f"upload {times['upload_ms'] / 1000:.2f}, BVH {times['hierarchy_ms'] / 1000:.2f}, search {times['solve_ms'] / 1000:.2f}; "
            f"[{answer['interval']['lower']!r}, {answer['interval']['upper']!r}] {answer['status']}; host {peak / 2 ** 30:.2f} GiB, "
            f"workspace {way['counts']['workspace_bytes'] / 2 ** 30:.2f} GiB; {answer['device']['name']}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("mesh")
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--noise", type=float, default=1e-3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--formats", default="ply,las")
    parser.add_argument("--back", action="store_true")
    parser.add_argument("--times", type=int, default=3)
    parser.add_argument("--more", default="", help="further words for the program")
    given = parser.parse_args()
    cloud = Cloud(given.mesh, given.points, given.noise, given.seed)
    for kind in given.formats.split(","):
        path = given.folder / f"{pathlib.Path(given.mesh).stem}_{given.points}_{given.noise}_{given.seed}.{kind}"
        if not path.exists():
            {"ply": cloud.write_ply, "las": cloud.write_las}[kind](path)
        pair = [given.mesh, str(path), "--points", "b"] if given.back else [str(path), given.mesh, "--points", "a"]
        for _ in range(given.times):
            print(line_of(path.name, *run(given.program, ["distance", *pair, *given.more.split()])), flush=True)


if __name__ == "__main__":
    main()
