#!/usr/bin/env python3
"""Races 'vkhausdorff gate' against envelope tests over the pairs of a manifest, in turn on one host.

  race_envelopes.py PROGRAM MANIFEST OUT.csv --peer NAME=PROGRAM... [--factors 1.2,2] [--only TEXT] [--time S] [--jobs N]

A peer is what envelope_race.cpp makes. h is the middle of the program's interval at 1e-8 of the diagonal; a limit is a factor
of it, over 1, so that the true verdict is 'within' for every face: each face that a peer finds outside is a false one. The
peer runs on one core, beyond reading files; the program is timed as a process and by its search. OUT.csv: a row for each run.
The program's runs come first and one at a time; --jobs says how many of the peers' run at once, each on a core.
"""

import argparse
import concurrent.futures
import csv
import json
import pathlib
import statistics
import subprocess
import time

COLUMNS = ["pair", "factor", "limit", "peer", "build_ms", "verdict_ms", "all_ms", "asked", "outside", "faces", "verdict", "process_ms"]


def gate(program, a, b, limit):
    start = time.monotonic()
    done = subprocess.run([program, "gate", a, b, "--max", f"{limit!r}abs", "--json"], capture_output=True, text=True, timeout=600)
    process_ms = 1000 * (time.monotonic() - start)
    answer = json.loads(done.stdout)
    times = answer["directions"][0]["times"]
    return answer["verdict"], times["hierarchy_ms"] + times["solve_ms"], process_ms


def envelope(program, a, b, limit, seconds):
    try:
        done = subprocess.run([program, a, b, repr(limit), "--time", str(seconds)], capture_output=True, text=True, timeout=4 * seconds + 60)
        eps, build, verdict, all_ms, asked, outside = done.stdout.strip().split(",")
        return {"build_ms": build, "verdict_ms": verdict, "all_ms": all_ms, "asked": int(asked), "outside": int(outside)}
    except (subprocess.TimeoutExpired, ValueError):
        return {"build_ms": "", "verdict_ms": "", "all_ms": "", "asked": 0, "outside": 0}


def ours(args, folder, pair):
    """The program's own rows, and the questions for the peers."""
    a, b = (str(folder / pair[key]) for key in ("file_a", "file_b"))
    narrow = json.loads(subprocess.run([args.program, "distance", a, b, "--tol", "1e-8", "--json"], capture_output=True, text=True).stdout)
    h = (float.fromhex(narrow["interval"]["lower_hex"]) + float.fromhex(narrow["interval"]["upper_hex"])) / 2
    rows = []
    for factor in args.factors.split(","):
        limit = float(factor) * h
        verdict, search, process = gate(args.program, a, b, limit)
        rows.append({"pair": pair["pair"], "factor": factor, "limit": repr(limit), "faces": pair["faces_a"], "peer": "vkhausdorff",
                     "verdict_ms": f"{search:.3f}", "verdict": verdict, "process_ms": f"{process:.1f}"})
    return rows, (a, b)


def theirs(args, row, files, name, program):
    found = {**{key: row[key] for key in ("pair", "factor", "limit", "faces")}, "peer": name,
             **envelope(program, *files, float(row["limit"]), args.time)}
    whole = found["asked"] == int(row["faces"])
    found["verdict"] = "fail" if found["outside"] else "pass" if whole else "unknown"
    return found


def summary(rows):
    for key in sorted({(r["factor"], r["peer"]) for r in rows}):
        mine = [r for r in rows if (r["factor"], r["peer"]) == key and r["verdict_ms"]]
        times = [float(r["verdict_ms"]) for r in mine]
        whole = [float(r["all_ms"]) for r in mine if r.get("all_ms")]
        false = sum(r["verdict"] == "fail" for r in mine)
        print(f"{key[0]:>6} h  {key[1]:14} {len(mine):3} pairs  {sum(r['verdict'] == 'pass' for r in mine):3} pass  {false:3} fail, falsely"
              f"  sum {sum(times):12.1f} ms  median {statistics.median(times):9.2f} ms")
        outside, asked = sum(r.get("outside") or 0 for r in mine), sum(r.get("asked") or 0 for r in mine)
        if asked:
            print(f"{'':24} all faces: sum {sum(whole):.1f} ms; {outside} of {asked} faces outside, falsely ({100 * outside / asked:.3f} %)")
        if key[1] == "vkhausdorff":
            print(f"{'':24} processes: {sum(float(r['process_ms']) for r in mine):.1f} ms")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("program", "manifest", "out"):
        parser.add_argument(name)
    parser.add_argument("--peer", action="append", default=[])
    parser.add_argument("--factors", default="1.2,2")
    parser.add_argument("--only", default="")
    parser.add_argument("--time", type=float, default=60)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--max-faces", type=int, default=10**9)
    args = parser.parse_args()
    peers = [word.split("=", 1) for word in args.peer]
    folder = pathlib.Path(args.manifest).parent
    pairs = [p for p in csv.DictReader(open(args.manifest)) if args.only in p["pair"] and int(p["faces_a"]) <= args.max_faces]
    rows = []
    with open(args.out, "w", newline="") as file, concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()
        asked = []
        for pair in pairs:
            mine, files = ours(args, folder, pair)
            rows += mine
            asked += [(row, files, *peer) for row in mine for peer in peers]
        table.writerows(rows)
        for row in pool.map(lambda what: theirs(args, *what), asked):
            table.writerow(row)
            file.flush()
            rows.append(row)
    summary(rows)


if __name__ == "__main__":
    main()
