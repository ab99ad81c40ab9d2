#!/usr/bin/env python3
"""Many pairs by `vkhausdorff batch --metrics`: pairs a second, and the device's part of the time; and what F1 costs.

usage: metrics_pairs.py PROGRAM PAIRS [--pairs 1000] [--faces 30000] [--device D] [--effort N] [--keep FOLDER]

PAIRS: a folder with manifest.csv, of pair, file_a, file_b, faces_a and faces_b. Its pairs of up to so many faces a mesh are
repeated, each time under names of their own, so that no mesh is read or prepared once for two pairs.
"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import time


def rows_of(folder, faces):
    with open(folder / "manifest.csv", newline="") as text:
        rows = list(csv.DictReader(text))
    return [row for row in rows if int(row["faces_a"]) <= faces and int(row["faces_b"]) <= faces]


def write_list(asked, scratch):
    """Links the meshes under new names, and lists the pairs."""
    rows = rows_of(asked.folder, asked.faces)
    if not rows:
        sys.exit(f"{asked.folder}: no pair of up to {asked.faces} faces")
    with open(scratch / "list.csv", "w", newline="") as text:
        out = csv.writer(text)
        out.writerow(("id", "a", "b"))
        for i in range(asked.pairs):
            row, names = rows[i % len(rows)], []
            for side in ("file_a", "file_b"):
                source = (asked.folder / row[side]).resolve()
                names.append(f"{i}_{side}{source.suffix}")
                (scratch / names[-1]).symlink_to(source)
            out.writerow((f"{i}_{row['pair']}", *names))
    return len(rows)


def summary_of(results):
    """Times, cells and goals of the lines."""
    lines = [json.loads(line) for line in results.read_text().splitlines()]
    answers = [line for line in lines if "metrics" in line]
    cells = [sum(direction["survey"]["bounded"] for direction in line["directions"]) for line in answers]
    return {
        "pairs": len(lines), "answers": len(answers), "all goals met": sum(line["metrics"]["met"] for line in answers),
        "f1 met": sum(line["metrics"]["within"][0]["f1"]["met"] for line in answers),
        "cells of a pair, median": sorted(cells)[len(cells) // 2] if cells else 0, "cells of all": sum(cells),
        "gpu_ms of searches": round(sum(line["run"]["times"]["gpu_ms"] for line in answers)),
        "read_ms": round(sum(line["run"]["times"]["read_ms"] for line in answers)),
        "device": answers[0]["run"]["device"]["name"] if answers else None,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--pairs", type=int, default=1000)
    parser.add_argument("--faces", type=int, default=30000)
    parser.add_argument("--device", default="")
    parser.add_argument("--effort", type=int)
    parser.add_argument("--keep", type=pathlib.Path, help="the folder that results.jsonl stays in")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        distinct = write_list(asked, scratch)
        results = (asked.keep or scratch) / "results.jsonl"
        words = [asked.program.resolve(), "batch", scratch / "list.csv", "--metrics", "--bands", "0.5%", "--out", results.resolve()]
        words += ["--device", asked.device] if asked.device else []
        words += ["--effort", str(asked.effort)] if asked.effort is not None else []
        start = time.monotonic()
        done = subprocess.run(words, capture_output=True, text=True)
        wall = time.monotonic() - start
        if done.returncode not in (0, 3):
            sys.exit(done.stderr)
        print(done.stdout)
        print(json.dumps({"distinct": distinct, "wall_s": round(wall, 2), "pairs_a_second": round(asked.pairs / wall, 3),
                          **summary_of(results)}, indent=1))


if __name__ == "__main__":
    main()
