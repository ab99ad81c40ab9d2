#!/usr/bin/env python3
"""Times vkhausdorff against a peer over a manifest of mesh pairs, and checks every interval.

  tools/bench/benchmark_pairs.py --manifest PAIRS/manifest.csv --program out/vkhausdorff \\
      --peer /tmp/peers/cpu_sota --max-faces 100000 --repeat 3 --out results.csv \\
      --markdown results.md [--filter substr] [--device cpu] [--extra "--disable=sort"]

Each pair runs peer, ours, peer, ours, ... so that both meet the same machine; times are medians of
--repeat runs. The peer is called as `PEER A B tolerance limit_s` and prints one line that starts
`solve_ms,lower,upper`; its solve_ms is a host clock around its solver call, B's tree included.
--peer-csv FILE takes stored peer runs instead (columns pair,solve_ms,wall_ms,lower,upper).
What the speed-ups divide is said in benchmark_report.py and in every output.

Exit status: 0 every check held, 1 some did not (the output says which), 2 usage.
"""

import argparse
import csv
import json
import math
import shlex
import statistics
import subprocess
import sys
import time
from pathlib import Path

import benchmark_report
from benchmark_report import COUNTS, Pair, Result, Run

# Peers round to nearest, so where an interval is a single point theirs may miss ours by some ulp.
PEER_SLACK = 1e-12  # of diag(A)
WIDTH_SLACK = 1 + 1e-9  # printing bounds outward widens the interval by some ulp
GRACE_S = 60  # past the limit, for files and drivers, before a process is killed


# ---- Programs ----


def read_bound(report, key):
    """The hexadecimal float is the bound itself; decimals are rounded outward from it."""
    text = report.get(key + "_hex")
    return float.fromhex(text) if text is not None else float(report[key])


def read_report(text):
    """The used part of the JSON of `vkhausdorff distance --json`: only this code knows it."""
    report = json.loads(text)
    way = report["directions"][0]
    times, interval = way["times"], report["interval"]
    return Run(
        call_ms=times["wall_ms"],
        solve_ms=times["hierarchy_ms"] + times["solve_ms"],
        hierarchy_ms=times["hierarchy_ms"],
        lower=read_bound(interval, "lower"),
        upper=read_bound(interval, "upper"),
        status=report["status"],
        diagonal_a=report["tolerance"]["diagonal"],
        device=report["device"]["name"],
        driver=report["driver"],
        counts={name: way["counts"][name] for name in COUNTS},
    )


def read_peer_line(text):
    solve_ms, lower, upper = (float(word) for word in text.strip().split(",")[:3])
    return Run(call_ms=solve_ms, solve_ms=solve_ms, lower=lower, upper=upper)


def run_program(command, read, limit_s):
    """Runs it once; any failure becomes the run's error, since one pair must not end all."""
    begin = time.perf_counter()
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, errors="replace", timeout=limit_s + GRACE_S
        )
    except subprocess.TimeoutExpired:
        return Run(status="error", error=f"killed after {limit_s + GRACE_S:g} s")
    except OSError as error:
        return Run(status="error", error=f"{command[0]}: {error.strerror}")
    wall_ms = 1e3 * (time.perf_counter() - begin)
    try:
        run = read(done.stdout)
    except (ValueError, KeyError, TypeError) as error:
        said = (done.stderr.strip() or done.stdout.strip() or "nothing")[-200:].replace("\n", " | ")
        return Run(
            status="error",
            error=f"exit {done.returncode}, answer not understood ({error!r}); it said: {said}",
        )
    run.wall_ms = wall_ms
    if not run.status:  # the peer reports only its interval
        run.status = "ran" if done.returncode == 0 else f"exit {done.returncode}"
    return run


def our_command(args, pair):
    command = [args.program, "distance", str(pair.file_a), str(pair.file_b), "--tol", args.tol]
    if args.device:
        command += ["--device", args.device]
    return command + shlex.split(args.extra) + ["--json"]


def peer_command(args, pair):
    return [args.peer, str(pair.file_a), str(pair.file_b), args.tol, f"{args.limit:g}"]


def middle(runs):
    """The run whose numbers are kept, with the medians of the times of all."""
    bad = [run for run in runs if run.error]
    if bad:
        return bad[0]
    kept = runs[-1]
    for name in ("wall_ms", "call_ms", "solve_ms", "hierarchy_ms"):
        setattr(kept, name, statistics.median(getattr(run, name) for run in runs))
    return kept


# ---- Checks ----


def overlaps(run, lower, upper, slack):
    return run.lower <= upper + slack and lower - slack <= run.upper


def is_closed(run, tolerance):
    return 0 <= run.upper - run.lower <= tolerance * WIDTH_SLACK


def check_ours(runs, tolerance):
    """The names of the checks that a pair's runs fail by themselves: the status is not trusted."""
    if any(r.error for r in runs):
        return ["error"]
    failed = []
    if any(r.status != "closed" for r in runs):
        failed.append("closed:" + "/".join(sorted({r.status for r in runs} - {"closed"})))
    elif not all(is_closed(r, tolerance) for r in runs):
        failed.append("width")
    if not all(r.lower <= r.upper for r in runs):
        failed.append("ordered")
    if len({(r.lower, r.upper) for r in runs}) > 1:
        failed.append("repeatable")
    return failed


def check_against(run, peer, known):
    """The names of the intervals that ours misses: this run's peer, the stored intervals and
    diagonal."""
    failed, others = [], {}
    if known.get("diag_a"):
        if not math.isclose(run.diagonal_a, float(known["diag_a"]), rel_tol=1e-9):
            failed.append("diagonal")
    if peer is not None and not peer.error:
        others["peer"] = (peer.lower, peer.upper)
    for key in ("cpusota", "ref"):
        if known.get(f"{key}_lower"):
            others["stored_" + key] = (float(known[f"{key}_lower"]), float(known[f"{key}_upper"]))
    slack = PEER_SLACK * run.diagonal_a
    for who, (lower, upper) in others.items():
        if not overlaps(run, lower, upper, slack):
            failed.append("overlap:" + who)
    return failed


# ---- A pair ----


def measure(args, pair, stored):
    ours, peers = [], []
    for _ in range(args.repeat):
        if args.peer:
            peers.append(run_program(peer_command(args, pair), read_peer_line, args.limit))
        ours.append(run_program(our_command(args, pair), read_report, args.limit))
    return ours, (middle(peers) if peers else stored.get(pair.name))


def ratio(a, b):
    return a / b if b > 0 else math.nan


def speedups_of(ours, peer):
    return {
        "process": ratio(peer.wall_ms, ours.wall_ms),
        "call": ratio(peer.call_ms, ours.call_ms),
        "solve": ratio(peer.solve_ms, ours.solve_ms),
    }


def judge(args, pair, runs, known):
    ours, peer = runs
    run, speedups = middle(ours), {}
    # Uses the stored diagonal if there is one, so that a wrong one of ours cannot widen it.
    tolerance = float(args.tol) * float(known.get("diag_a") or run.diagonal_a)
    failed = check_ours(ours, tolerance)
    if not run.error:
        failed += check_against(run, peer, known)
    if peer is not None and not run.error:
        if not peer.error and not is_closed(peer, tolerance):
            peer.status = "not closed"
        elif not peer.error and not failed:  # a wrong answer is not a fast one
            speedups = speedups_of(run, peer)
    return Result(pair, run, peer, failed, speedups)


# ---- Files ----


def read_pairs(args):
    folder = Path(args.manifest).parent
    with open(args.manifest, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if int(row["faces_a"]) <= args.max_faces and args.filter in row["pair"]:
                yield Pair(
                    name=row["pair"],
                    family=row["family"],
                    file_a=folder / row["file_a"],
                    file_b=folder / row["file_b"],
                    faces_a=int(row["faces_a"]),
                    faces_b=int(row["faces_b"]),
                )


def read_known(path):
    if not Path(path).exists():
        print(f"{path}: none, so no stored interval is checked", file=sys.stderr)
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        return {row["pair"]: row for row in csv.DictReader(file)}


def read_stored_peer(path):
    runs = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            if row["solve_ms"]:
                run = read_peer_line(",".join((row["solve_ms"], row["lower"], row["upper"])))
                run.wall_ms, run.status = float(row["wall_ms"] or "nan"), "stored"
                runs[row["pair"]] = run
    return runs


# ---- Main ----


def parse_arguments(argv):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--manifest", required=True, help="meshes lie beside it")
    parser.add_argument("--program", required=True, help="vkhausdorff")
    parser.add_argument("--peer", default="", help="program to race")
    parser.add_argument("--peer-csv", default="", help="stored peer runs instead of --peer")
    parser.add_argument("--known", default="", help="stored intervals; peers.csv by the manifest")
    parser.add_argument("--max-faces", type=int, default=100000, help="of mesh A")
    parser.add_argument("--filter", default="", help="part of a pair's name")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--tol", default="1e-6", help="a plain fraction of diag(A)")
    parser.add_argument("--limit", type=float, default=60, help="seconds a run")
    parser.add_argument("--device", default="")
    parser.add_argument("--extra", default="", help="more words for vkhausdorff distance")
    parser.add_argument("--commit", default="", help="where there is no git to ask")
    parser.add_argument("--out", required=True, help="CSV, written again after every pair")
    parser.add_argument("--markdown", default="")
    # argparse would take the word after --extra for an option of its own, as it starts with dashes.
    if "--extra" in argv[:-1]:
        at = argv.index("--extra")
        argv = [*argv[:at], "--extra=" + argv[at + 1], *argv[at + 2 :]]
    args = parser.parse_args(argv)
    if args.repeat < 1 or (args.peer and args.peer_csv):
        parser.error("expected --repeat of at least 1, and only one of --peer and --peer-csv")
    args.known = args.known or str(Path(args.manifest).with_name("peers.csv"))
    return args


def main(argv):
    args = parse_arguments(argv)
    known, stored = read_known(args.known), {}
    if args.peer_csv:
        stored = read_stored_peer(args.peer_csv)
    about, pairs, results = benchmark_report.describe(args), list(read_pairs(args)), []
    try:
        for at, pair in enumerate(pairs, 1):
            runs = measure(args, pair, stored)
            results.append(judge(args, pair, runs, known.get(pair.name, {})))
            row = "  ".join(benchmark_report.pair_row(results[-1]))
            print(f"[{at}/{len(pairs)}] {row}", file=sys.stderr, flush=True)
            benchmark_report.write_csv(args.out, about, results)
    except KeyboardInterrupt:
        print(f"stopped after {len(results)} of {len(pairs)} pairs", file=sys.stderr)
    if args.markdown:
        benchmark_report.write_markdown(args.markdown, about, results)
    print("\n".join(benchmark_report.summary(results)))
    return 1 if not results or any(r.failed for r in results) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
