#!/usr/bin/env python3
"""Gates the pairs of a manifest at limits around their distances, and times it against 'distance'.

  gate_pairs.py PROGRAM MANIFEST OUT.csv [--peers PEERS.csv] [--factors 0.9,0.99,...] [--only TEXT] [--limit-s S]

h is an interval of the program at 1e-8 of the diagonal, which must meet that of PEERS.csv (ref_lower, ref_upper: the
double-precision solver's) where the pair is in it. A verdict is false where that interval refutes it. OUT.csv: a row for each
run. Exit code 1 for a false verdict, or an undecided one farther from h than the gate's tolerance.
"""

import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import time

FACTORS = "0.9,0.99,0.999,1.001,1.01,1.2,2"
TOLERANCE = 1e-7  # of the diagonal: the gate's own
COLUMNS = ["pair", "command", "factor", "max", "verdict", "status", "lower", "upper", "process_s", "search_ms", "device", "driver"]


def run(program, *words, limit):
    start = time.monotonic()
    done = subprocess.run([program, *words, "--json"], capture_output=True, text=True, timeout=limit)
    seconds = time.monotonic() - start
    answer = json.loads(done.stdout)
    if "error" in answer:
        sys.exit(f"gate_pairs: {words}: {done.stderr}")
    return answer, seconds


def bounds(answer):
    return float.fromhex(answer["interval"]["lower_hex"]), float.fromhex(answer["interval"]["upper_hex"])


def row_of(pair, command, factor, limit, answer, seconds):
    lower, upper = bounds(answer)
    times = answer["directions"][0]["times"]
    return {"pair": pair, "command": command, "factor": factor, "max": limit, "verdict": answer.get("verdict", ""),
            "status": answer["status"], "lower": repr(lower), "upper": repr(upper), "process_s": f"{seconds:.4f}",
            "search_ms": f"{times['hierarchy_ms'] + times['solve_ms']:.3f}", "device": answer["device"]["name"], "driver": answer["driver"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("program", "manifest", "out"):
        parser.add_argument(name)
    parser.add_argument("--peers")
    parser.add_argument("--factors", default=FACTORS)
    parser.add_argument("--only", default="")
    parser.add_argument("--limit-s", type=float, default=600)
    args = parser.parse_args()
    folder = pathlib.Path(args.manifest).parent
    peers = {row["pair"]: row for row in csv.DictReader(open(args.peers))} if args.peers else {}
    false, far, verdicts, seconds = [], [], [], {}
    with open(args.out, "w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()

        def note(*what):
            table.writerow(row_of(*what))
            file.flush()
            seconds.setdefault((what[1], what[2]), []).append(what[5])

        for pair in csv.DictReader(open(args.manifest)):
            name = pair["pair"]
            if args.only not in name:
                continue
            a, b = (str(folder / pair[key]) for key in ("file_a", "file_b"))
            narrow, taken = run(args.program, "distance", a, b, "--tol", "1e-8", limit=args.limit_s)
            note(name, "distance 1e-8", "", "", narrow, taken)
            plain, taken = run(args.program, "distance", a, b, limit=args.limit_s)
            note(name, "distance", "", "", plain, taken)
            lower, upper = bounds(narrow)
            if name in peers and not (lower <= float(peers[name]["ref_upper"]) and float(peers[name]["ref_lower"]) <= upper):
                false.append(f"{name}: [{lower}, {upper}] misses the double-precision solver's")
            for factor in args.factors.split(","):
                limit = float(factor) * (lower + upper) / 2
                answer, taken = run(args.program, "gate", a, b, "--max", f"{limit!r}abs", limit=args.limit_s)
                note(name, "gate", factor, repr(limit), answer, taken)
                verdict = answer["verdict"]
                verdicts.append(verdict)
                if (verdict == "pass" and lower > limit) or (verdict == "fail" and upper <= limit):
                    false.append(f"{name} at {factor} h: {verdict}")
                off = max(lower - limit, limit - upper)
                if verdict == "undecided" and off > TOLERANCE * answer["tolerance"]["diagonal"]:
                    far.append(f"{name} at {factor} h: undecided, {off / answer['tolerance']['diagonal']:.3g} of the diagonal away ({answer['status']})")
    for line in false + far:
        print(line)
    for (command, factor), times in seconds.items():
        print(f"{command:14} {factor:6} {len(times):4} runs  sum {sum(times):9.3f} s  median {statistics.median(times):7.4f} s")
    print(f"gate_pairs: {len(verdicts)} gates, {verdicts.count('pass')} pass, {verdicts.count('fail')} fail, "
          f"{verdicts.count('undecided')} undecided, {len(far)} of them far from h; {len(false)} false")
    return 1 if false or far else 0


if __name__ == "__main__":
    sys.exit(main())
