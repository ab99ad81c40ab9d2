#!/usr/bin/env python3
"""Compares the estimates of a survey with samples of the area. PYTHONPATH names the built module.

usage: estimate_samples.py PROGRAM MANIFEST.csv OUT.csv [--pairs N] [--points N] [--max-faces N] [--seed S]

Takes the first N pairs of the manifest whose meshes have no more faces than that together. Each figure's estimate is to lie in
its interval, and within 1 % of the samples' figure, three of their standard errors, or a millionth of A's diagonal.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import time

import numpy as np
import vkhausdorff as vkh

PERCENTILES = (0.5, 0.95)
BATCH = 250_000


def sample(mesh, count, random):
    """Points that are uniform over the area."""
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    face = np.searchsorted(np.cumsum(area), random.uniform(0, area.sum(), count)).clip(0, len(area) - 1)
    s, t = np.sqrt(random.uniform(size=count)), random.uniform(size=count)
    return (1 - s)[:, None] * a[face] + (s * (1 - t))[:, None] * b[face] + (s * t)[:, None] * c[face]


def distances(solver, points):
    parts = []
    for at in range(0, len(points), BATCH):
        found = solver.closest(points[at:at + BATCH])
        parts.append((found.lower + found.upper) / 2)
    return np.sort(np.concatenate(parts))


def quantile_error(d, p):
    """The standard error of a percentile, by the order statistics that are one standard error of their rank away."""
    n, wide = len(d), np.sqrt(p * (1 - p) * len(d))
    at = lambda rank: d[int(np.clip(rank, 0, n - 1))]
    return (at(n * p + wide) - at(n * p - wide)) / 2


def figures(d, band):
    """{name: (figure of the samples, its standard error)}"""
    n = len(d)
    square, share = (d * d).mean(), np.searchsorted(d, band, "right") / n
    out = {"mean": (d.mean(), d.std() / np.sqrt(n)),
           "rms": (np.sqrt(square), (d * d).std() / np.sqrt(n) / (2 * np.sqrt(square)) if square else 0)}
    for p in PERCENTILES:
        out[f"p{100 * p:g}"] = d[min(int(np.ceil(p * n)) - 1, n - 1)], quantile_error(d, p)
    out["share"] = share, np.sqrt(max(share * (1 - share), 1 / n) / n)
    return out


def survey(program, files, band):
    """{name: {lower, estimate, upper}} and the seconds that it took, by the program's JSON."""
    start = time.perf_counter()
    words = [program, "distance", *files, "--stats", "--bands", f"{band!r}abs", "--json"]
    answer = json.loads(subprocess.run(words, check=False, capture_output=True, text=True).stdout)
    statistics = answer["directions"][0]["statistics"]
    out = {"mean": statistics["mean"], "rms": statistics["rms"]}
    for p in PERCENTILES:
        out[f"p{100 * p:g}"] = next(at["distance"] for at in statistics["percentiles"] if at["share"] == p)
    out["share"] = statistics["bands"][0]["share"]
    return out, time.perf_counter() - start


def rows_of(pair, folder, args):
    files = [folder / pair[key] for key in ("file_a", "file_b")]
    a, b = map(vkh.read, files)
    least = 1e-6 * np.linalg.norm(np.ptp(np.asarray(a.vertices), axis=0))
    with vkh.Solver(b) as solver:
        band = float(solver.distance(a, tol=1e-3).upper / 4)
        start = time.perf_counter()
        d = distances(solver, sample(a, args.points, np.random.default_rng(args.seed)))
        samples_s = time.perf_counter() - start
    known, survey_s = survey(args.program, files, band)
    of_samples = figures(d, band)
    for name, interval in known.items():
        value, error = of_samples[name]
        lower, estimate, upper = (interval[key] for key in ("lower", "estimate", "upper"))
        off = abs(estimate - value)
        slack = 0 if name == "share" else least
        yield {"pair": pair["pair"], "figure": name, "lower": lower, "estimate": estimate, "upper": upper, "samples": value, "error": error,
               "off": off / value if value else off, "errors": off / error if error else 0, "inside": lower <= estimate <= upper,
               "agrees": off <= max(0.01 * abs(value), 3 * error, slack), "survey_s": round(survey_s, 2), "samples_s": round(samples_s, 2)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("manifest", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--pairs", type=int, default=20)
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--max-faces", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    with open(args.manifest, newline="") as text:
        pairs = [row for row in csv.DictReader(text) if int(row["faces_a"]) + int(row["faces_b"]) <= args.max_faces][:args.pairs]
    with open(args.out, "w", newline="") as text:
        writer = None
        for pair in pairs:
            for row in rows_of(pair, args.manifest.parent, args):
                writer = writer or csv.DictWriter(text, row.keys())
                if text.tell() == 0:
                    writer.writeheader()
                writer.writerow(row)
                text.flush()
                print(row["pair"], row["figure"], f"{row['estimate']:.6g} {row['samples']:.6g} {100 * row['off']:.3f} % {row['errors']:.1f} errors",
                      "" if row["agrees"] and row["inside"] else "DIFFERS", flush=True)


if __name__ == "__main__":
    main()
