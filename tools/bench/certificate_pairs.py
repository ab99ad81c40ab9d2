#!/usr/bin/env python3
"""Certificates of the pairs of a manifest: written, given to vkh_check, and both timed.

  certificate_pairs.py PROGRAM VKH_CHECK MANIFEST.csv OUT.csv [--tol T] [--only TEXT] [--device D] [--limit-s S]

Each pair is solved without a certificate, then with one, then checked. OUT.csv: a row for each pair, with wall time and
the processor's time of each process. Exit code 1 where a certificate is not written, is not accepted, or proves more than
the run's own upper.
"""

import argparse
import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

COLUMNS = ["pair", "status", "faces_a", "faces_b", "leaves", "cut", "unproven", "raised", "cells", "bytes", "bytes_leaf", "solve_plain",
           "solve", "prove_ms", "process_plain", "process", "process_plain_cpu", "process_cpu", "check_rc", "check_s", "check_cpu", "load",
           "device", "driver"]
SUMMED = ["leaves", "bytes", "prove_ms", "process_plain", "process", "process_plain_cpu", "process_cpu", "check_s", "check_cpu"]


def timed(words, limit):
    """The process, its wall time, and the processor's time that it took."""
    before, start = os.times(), time.monotonic()
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=limit)
    seconds, after = time.monotonic() - start, os.times()
    return done, seconds, after.children_user + after.children_system - before.children_user - before.children_system


def answer_of(done, words):
    try:
        answer = json.loads(done.stdout)
    except ValueError:
        answer = {"error": "no JSON"}
    if "error" in answer:
        sys.exit(f"certificate_pairs: {words}: {done.stderr}")
    return answer


def row_of(args, pair, folder, file):
    meshes = [folder / pair[key] for key in ("file_a", "file_b")]
    words = [args.program, "distance", *meshes, "--json", "--tol", args.tol, "--device", args.device]
    load = os.getloadavg()[0]
    done, plain_s, plain_cpu = timed(words, args.limit_s)
    plain = answer_of(done, words)["directions"][0]
    done, seconds, cpu = timed([*words, "--certificate", file], args.limit_s)
    answer = answer_of(done, words)
    way = answer["directions"][0]
    proof, size = way["certificate"], file.stat().st_size
    checked, check_s, check_cpu = timed([args.check, file, *meshes], args.limit_s)
    return {"pair": pair["pair"], "status": answer["status"], "faces_a": pair["faces_a"], "faces_b": pair["faces_b"],
            "leaves": proof["leaves"], "cut": proof["cut_leaves"], "unproven": proof["unproven"],
            "raised": int(proof["upper"] != way["interval"]["upper"]), "cells": proof["cells"], "bytes": size,
            "bytes_leaf": f"{size / proof['leaves']:.2f}", "solve_plain": f"{plain['times']['solve_ms']:.3f}",
            "solve": f"{way['times']['solve_ms']:.3f}", "prove_ms": f"{proof['wall_ms']:.1f}", "process_plain": f"{plain_s:.3f}",
            "process": f"{seconds:.3f}", "process_plain_cpu": f"{plain_cpu:.2f}", "process_cpu": f"{cpu:.2f}",
            "check_rc": checked.returncode, "check_s": f"{check_s:.3f}", "check_cpu": f"{check_cpu:.2f}", "load": f"{load:.2f}",
            "device": answer["device"]["name"], "driver": answer["driver"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("program", "check", "manifest", "out"):
        parser.add_argument(name)
    parser.add_argument("--tol", default="1e-6")
    parser.add_argument("--only", default="")
    parser.add_argument("--device", default="")
    parser.add_argument("--limit-s", type=float, default=600)
    args = parser.parse_args()
    rows = []
    with open(args.out, "w", newline="") as file, tempfile.TemporaryDirectory() as scratch:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()
        for pair in csv.DictReader(open(args.manifest)):
            if args.only not in pair["pair"]:
                continue
            rows.append(row_of(args, pair, pathlib.Path(args.manifest).parent, pathlib.Path(scratch) / "pair.vhc"))
            table.writerow(rows[-1])
            file.flush()
    for name in SUMMED:
        values = [float(row[name]) for row in rows]
        print(f"{name:18} median {statistics.median(values):12.3f}  most {max(values):12.3f}  sum {sum(values):14.3f}")
    refused, raised = sum(row["check_rc"] != 0 for row in rows), sum(row["raised"] for row in rows)
    print(f"certificate_pairs: {len(rows)} pairs, {refused} not accepted, {raised} raised")
    return 1 if refused or raised else 0


if __name__ == "__main__":
    sys.exit(main())
