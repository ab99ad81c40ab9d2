#!/usr/bin/env python3
"""Limits that differ by side, on generated pairs whose largest distances over and under B are known without rounding.

usage: sided_gate.py [--count N] [--seed S], with the package vkhausdorff on the path. A is a surface of random heights over a
plate, all of them multiples of 2^-12, B the plate: a box, a sheet, or a box with its faces split; limits lie about the largest
heights. Prints the verdicts counted, and each wrong one; exits with 1 if there is any.
"""

import argparse
import collections
import random
import sys

import numpy as np

import vkhausdorff as vkh


def grid(n, heights, size=1.0):
    points = [(size * i / n, size * j / n, heights[i][j]) for i in range(n + 1) for j in range(n + 1)]
    faces = []
    for i in range(n):
        for j in range(n):
            a, b = i * (n + 1) + j, (i + 1) * (n + 1) + j
            faces += [(a, b, b + 1), (a, b + 1, a + 1)]
    return np.array(points), np.array(faces)


def box(low, high):
    corners = np.array([[(low, high)[k >> i & 1][i] for i in range(3)] for k in range(8)], float)
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def plate(kind, rng):
    """A plate whose upper side is z = 0, far wider than A, and thicker than any height."""
    if kind == "box":
        return box((-2, -2, -4), (3, 3, 0))
    n = 1 + rng.randrange(4)
    vertices, faces = grid(n, [[0.0] * (n + 1) for _ in range(n + 1)], 5.0)
    return vertices - np.array([2, 2, 0]), faces


def ask(rng):
    n = 1 + rng.randrange(4)
    tilt = rng.choice((-0.3, 0.0, 0.0, 0.3))
    heights = [[round((tilt + rng.uniform(-0.4, 0.4) * rng.choice((1, 0.1))) * 4096) / 4096 for _ in range(n + 1)] for _ in range(n + 1)]
    flat = [h for row in heights for h in row]
    over, under = max(0.0, *flat), max(0.0, *(-h for h in flat))
    limits = [max(1 / 4096, x + rng.choice((-1, 1)) * rng.choice((1, 3, 40, 400)) / 4096) for x in (over, under)]
    kind = rng.choice(("box", "sheet"))
    a, b = grid(n, heights), plate(kind, rng)
    if rng.random() < 0.5:  # B looks down: over and under change places
        b = (b[0], b[1][:, ::-1])
        over, under = under, over
        limits.reverse()
    ends = vkh.gate(a, b, f"+{limits[0]!r}abs,-{limits[1]!r}abs", effort=200000)
    truth = "pass" if over <= limits[0] and under <= limits[1] else "fail"
    return kind, truth, ends.verdict, (over, under, limits, ends.signed)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    counts, wrong = collections.Counter(), 0
    for k in range(args.count):
        kind, truth, verdict, what = ask(random.Random(args.seed * 1000003 + k))
        counts[kind, truth, verdict] += 1
        if verdict not in (truth, "undecided"):
            wrong += 1
            print("WRONG", k, kind, truth, verdict, what)
        if verdict == "undecided":
            print("undecided", k, kind, truth, what)
    for key, count in sorted(counts.items()):
        print(*key, count)
    print(f"{args.count} pairs, {wrong} wrong")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main())
