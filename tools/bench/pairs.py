#!/usr/bin/env python3
"""Runs the program over the pairs of a manifest, and holds what it says against something else.

  tools/bench/pairs.py --what race|certificates|gates|envelopes|metrics|estimates PROGRAM MANIFEST.csv OUT.csv [...]

A manifest is CSV with pair, family, file_a, file_b, faces_a and faces_b; its files lie beside it. OUT.csv has a row for each run.

race          against --peer, a program called as `PEER A B tolerance limit_s` that prints solve_ms,lower,upper; in turn, and
              medians of --repeat runs. Fails where ours is not closed or not the same twice, or misses the peer's interval
              or that of --known (ref_lower, ref_upper).
certificates  solved without a certificate, with one, and checked by --check (vkh_check). Fails where one is not accepted or
              proves more than the run's own upper.
gates         at --factors of h, which is an interval at 1e-8 of the diagonal. Fails for a false verdict, and for an undecided
              one farther from h than the gate's tolerance.
envelopes     the same limits against --peer NAME=PROGRAM (envelope_race.cpp), on one core: each face that a peer finds outside
              at a factor over 1 is a false one.
metrics       --pairs pairs, repeated under names of their own, by one batch --metrics: pairs a second, and cells.
estimates     each figure's estimate against --points samples of the area; needs numpy and the built module on PYTHONPATH.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import shlex
import statistics
import subprocess
import sys
import tempfile
import time

TOLERANCE = 1e-7  # of the diagonal: the gate's own
PEER_SLACK = 1e-12  # of the diagonal: peers round to nearest
WIDTH_SLACK = 1 + 1e-9  # printing outward widens an interval by some ulp


class Ran:
    """A process: its answer where it printed JSON, its code, wall time and processor's time."""

    def __init__(self, words, limit):
        before, start = os.times(), time.monotonic()
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=limit)
        self.seconds, after = time.monotonic() - start, os.times()
        self.cpu = after.children_user + after.children_system - before.children_user - before.children_system
        self.code, self.text, self.error = done.returncode, done.stdout, done.stderr


def ask(args, *words):
    """The program's answer, and its process. An error ends all: a pair that is left out would be a gap in the figures."""
    device = ["--device", args.device] if args.device else []
    ran = Ran([args.program, *words, *device, *shlex.split(args.extra), "--json"], args.limit)
    try:
        answer = json.loads(ran.text)
    except ValueError:
        answer = {"error": "no JSON"}
    if "error" in answer:
        sys.exit(f"pairs: {words}: {ran.error}")
    return answer, ran


def bounds(answer):
    return float.fromhex(answer["interval"]["lower_hex"]), float.fromhex(answer["interval"]["upper_hex"])


def search_ms(answer):
    times = answer["directions"][0]["times"]
    return times["hierarchy_ms"] + times["solve_ms"]


def machine_of(answer):
    return {"device": answer["device"]["name"], "driver": answer["driver"]}


def pairs_of(args):
    with open(args.manifest, newline="") as text:
        rows = list(csv.DictReader(text))
    chosen = [row for row in rows if args.only in row["pair"] and max(int(row["faces_a"]), int(row["faces_b"])) <= args.max_faces]
    for row in chosen[:args.pairs]:
        yield row, [str(pathlib.Path(args.manifest).parent / row[key]) for key in ("file_a", "file_b")]


class Table:
    """Rows of OUT.csv, each in the file as soon as it is known."""

    def __init__(self, path):
        self.file, self.writer, self.rows = open(path, "w", newline=""), None, []

    def add(self, row):
        if self.writer is None:
            self.writer = csv.DictWriter(self.file, row.keys(), lineterminator="\n")
            self.writer.writeheader()
        self.writer.writerow(row)
        self.file.flush()
        self.rows.append(row)

    def print_sums(self, names):
        for name in names if self.rows else ():
            values = [float(row[name]) for row in self.rows]
            print(f"{name:18} median {statistics.median(values):12.3f}  most {max(values):12.3f}  sum {sum(values):14.3f}")


def print_faults(what, count, faults):
    for fault in faults:
        print(fault)
    print(f"{what}: {count} pairs, {len(faults)} wrong")
    return 1 if faults or not count else 0


# ---- race ----


def peer_of(args, files):
    ran = Ran([args.peer[0], *files, args.tol, f"{args.limit:g}"], args.limit + 60)
    try:
        solve, lower, upper = (float(word) for word in ran.text.strip().split(",")[:3])
    except ValueError:
        return None
    return {"solve_ms": solve, "process_ms": 1000 * ran.seconds, "lower": lower, "upper": upper}


def faults_of_race(answers, others, args):
    """The names of what is wrong with a pair's runs; others: {name: (lower, upper)}."""
    ends, diagonal = [bounds(answer) for answer in answers], answers[0]["tolerance"]["diagonal"]
    faults = []
    if any(answer["status"] != "closed" for answer in answers):
        faults.append("closed")
    elif any(upper - lower > float(args.tol) * diagonal * WIDTH_SLACK for lower, upper in ends):
        faults.append("width")
    if len(set(ends)) > 1:
        faults.append("repeatable")
    slack = PEER_SLACK * diagonal
    return faults + [name for name, (lower, upper) in others.items() if ends[0][0] > upper + slack or ends[0][1] < lower - slack]


def medians(runs, names):
    return {name: statistics.median(run[name] for run in runs) for name in names}


def race(args):
    table, faults = Table(args.out), []
    known = {row["pair"]: row for row in csv.DictReader(open(args.known))} if args.known else {}
    for pair, files in pairs_of(args):
        answers, ours, peers = [], [], []
        for _ in range(args.repeat):
            peers += [peer_of(args, files)] if args.peer else []
            answer, ran = ask(args, "distance", *files, "--tol", args.tol)
            answers.append(answer)
            ours.append({"process_ms": 1000 * ran.seconds, "call_ms": answer["directions"][0]["times"]["wall_ms"], "solve_ms": search_ms(answer)})
        others = {"peer": (peers[0]["lower"], peers[0]["upper"])} if peers and all(peers) else {}
        if known.get(pair["pair"], {}).get("ref_lower"):
            others["known"] = tuple(float(known[pair["pair"]][key]) for key in ("ref_lower", "ref_upper"))
        wrong = faults_of_race(answers, others, args)
        faults += [f"{pair['pair']}: {' '.join(wrong)}"] if wrong else []
        mine = medians(ours, ours[0])
        theirs = medians(peers, ("solve_ms", "process_ms")) if "peer" in others else {}
        lower, upper = bounds(answers[0])
        table.add({"pair": pair["pair"], "family": pair["family"], "faces_a": pair["faces_a"], "faces_b": pair["faces_b"],
                   "status": answers[0]["status"], "lower": repr(lower), "upper": repr(upper), **mine, "peer_solve_ms": theirs.get("solve_ms", ""),
                   "peer_process_ms": theirs.get("process_ms", ""), "failed": " ".join(wrong), **machine_of(answers[0])})
    for family in [*sorted({row["family"] for row in table.rows}), ""]:
        print_speedups(family or "all", [row for row in table.rows if row["peer_solve_ms"] and not row["failed"] and family in ("", row["family"])])
    return print_faults("race", len(table.rows), faults)


def print_speedups(family, rows):
    """A wrong answer is not a fast one: `rows` have none."""
    for name in ("solve_ms", "process_ms") if rows else ():
        ratios = sorted(row["peer_" + name] / row[name] for row in rows)
        whole = sum(row["peer_" + name] for row in rows) / sum(row[name] for row in rows)
        print(f"{family:12} {name:10} {len(rows):3} pairs  ratio of sums {whole:.3g}, geometric mean "
              f"{math.exp(statistics.fmean(map(math.log, ratios))):.3g}, least {ratios[0]:.3g}, median {statistics.median(ratios):.3g}, most {ratios[-1]:.3g}")


# ---- certificates ----


def certificates(args):
    table, faults = Table(args.out), []
    with tempfile.TemporaryDirectory() as scratch:
        file = pathlib.Path(scratch) / "pair.vhc"
        for pair, files in pairs_of(args):
            load = os.getloadavg()[0]
            plain, plain_ran = ask(args, "distance", *files, "--tol", args.tol)
            answer, ran = ask(args, "distance", *files, "--tol", args.tol, "--certificate", file)
            way = answer["directions"][0]
            proof, size = way["certificate"], file.stat().st_size
            checked = Ran([args.check, file, *files], args.limit)
            raised = int(proof["upper"] != way["interval"]["upper"])
            faults += [f"{pair['pair']}: code {checked.code}, raised {raised}"] if checked.code or raised else []
            table.add({"pair": pair["pair"], "status": answer["status"], "faces_a": pair["faces_a"], "faces_b": pair["faces_b"],
                       "leaves": proof["leaves"], "cut": proof["cut_leaves"], "unproven": proof["unproven"], "raised": raised,
                       "cells": proof["cells"], "bytes": size, "bytes_leaf": f"{size / proof['leaves']:.2f}",
                       "solve_plain": f"{plain['directions'][0]['times']['solve_ms']:.3f}", "solve": f"{way['times']['solve_ms']:.3f}",
                       "prove_ms": f"{proof['wall_ms']:.1f}", "process_plain": f"{plain_ran.seconds:.3f}", "process": f"{ran.seconds:.3f}",
                       "process_plain_cpu": f"{plain_ran.cpu:.2f}", "process_cpu": f"{ran.cpu:.2f}", "check_rc": checked.code,
                       "check_s": f"{checked.seconds:.3f}", "check_cpu": f"{checked.cpu:.2f}", "load": f"{load:.2f}", **machine_of(answer)})
    table.print_sums(("leaves", "bytes", "prove_ms", "process_plain", "process", "process_plain_cpu", "process_cpu", "check_s", "check_cpu"))
    return print_faults("certificates", len(table.rows), faults)


# ---- gates, and envelope tests at the same limits ----


def gate_rows(args, pair, files, factors):
    """The interval at 1e-8, and a row and its answer for each limit."""
    narrow, _ = ask(args, "distance", *files, "--tol", "1e-8")
    lower, upper = bounds(narrow)
    rows = []
    for factor in factors:
        limit = float(factor) * (lower + upper) / 2
        answer, ran = ask(args, "gate", *files, "--max", f"{limit!r}abs")
        rows.append(({"pair": pair["pair"], "factor": factor, "limit": repr(limit), "faces": pair["faces_a"], "by": "vkhausdorff",
                      "verdict": answer["verdict"], "status": answer["status"], "search_ms": f"{search_ms(answer):.3f}",
                      "process_ms": f"{1000 * ran.seconds:.1f}", "asked": "", "outside": "", **machine_of(answer)}, answer))
    return (lower, upper), rows


def fault_of_gate(row, answer, ends):
    lower, upper = ends
    limit, verdict = float(row["limit"]), row["verdict"]
    if (verdict == "pass" and lower > limit) or (verdict == "fail" and upper <= limit):
        return f"{row['pair']} at {row['factor']} h: {verdict}"
    off = max(lower - limit, limit - upper) / answer["tolerance"]["diagonal"]
    if verdict == "undecided" and off > TOLERANCE:
        return f"{row['pair']} at {row['factor']} h: undecided, {off:.3g} of the diagonal away ({row['status']})"
    return None


def gates(args):
    table, faults, count = Table(args.out), [], 0
    known = {row["pair"]: row for row in csv.DictReader(open(args.known))} if args.known else {}
    for count, (pair, files) in enumerate(pairs_of(args), 1):
        ends, rows = gate_rows(args, pair, files, (args.factors or "0.9,0.99,0.999,1.001,1.01,1.2,2").split(","))
        stored = known.get(pair["pair"])
        if stored and (ends[0] > float(stored["ref_upper"]) or float(stored["ref_lower"]) > ends[1]):
            faults.append(f"{pair['pair']}: {ends} misses the known interval")
        for row, answer in rows:
            table.add(row)
            fault = fault_of_gate(row, answer, ends)
            faults += [fault] if fault else []
    print_gates(table.rows)
    return print_faults("gates", count, faults)


def print_gates(rows):
    for factor, by in sorted({(row["factor"], row["by"]) for row in rows}):
        mine = [row for row in rows if (row["factor"], row["by"]) == (factor, by) and row["search_ms"]]
        of = {name: sum(row["verdict"] == name for row in mine) for name in ("pass", "fail", "undecided")}
        times = [float(row["search_ms"]) for row in mine] or [0]
        outside, asked = (sum(int(row[name] or 0) for row in mine) for name in ("outside", "asked"))
        print(f"{factor:>6} h  {by:14} {len(mine):3} runs {of}  sum {sum(times):12.1f} ms  median {statistics.median(times):9.2f} ms"
              + (f"; {outside} of {asked} faces outside, falsely" if asked else ""))


def envelopes(args):
    table, count = Table(args.out), 0
    for count, (pair, files) in enumerate(pairs_of(args), 1):
        _, rows = gate_rows(args, pair, files, (args.factors or "1.2,2").split(","))
        for row, _ in rows:
            table.add(row)
            for name, program in (word.split("=", 1) for word in args.peer):
                table.add({**row, "by": name, "status": "", "process_ms": "", **envelope_of(args, program, files, row)})
    print_gates(table.rows)
    return 0 if count else 1


def envelope_of(args, program, files, row):
    try:
        ran = Ran([program, *files, row["limit"], "--time", args.limit], 4 * args.limit + 60)
        _, _, verdict_ms, _, asked, outside = ran.text.strip().split(",")
    except (subprocess.TimeoutExpired, ValueError):
        return {"verdict": "unknown", "search_ms": "", "asked": "", "outside": ""}
    verdict = "fail" if int(outside) else "pass" if int(asked) == int(row["faces"]) else "unknown"
    return {"verdict": verdict, "search_ms": verdict_ms, "asked": asked, "outside": outside}


# ---- metrics ----


def metrics(args):
    count = args.pairs or 1000
    args.pairs = None
    distinct = list(pairs_of(args))
    if not distinct:
        sys.exit(f"{args.manifest}: no such pair")
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        with open(scratch / "list.csv", "w", newline="") as text:
            out = csv.writer(text)
            out.writerow(("id", "a", "b"))
            for i in range(count):  # under new names, so that no mesh is read or prepared once for two pairs
                pair, files = distinct[i % len(distinct)]
                names = [f"{i}_{side}{pathlib.Path(file).suffix}" for side, file in zip("ab", files)]
                for name, file in zip(names, files):
                    (scratch / name).symlink_to(pathlib.Path(file).resolve())
                out.writerow((f"{i}_{pair['pair']}", *names))
        words = [pathlib.Path(args.program).resolve(), "batch", scratch / "list.csv", "--metrics", "--bands", "0.5%", "--out", scratch / "out.jsonl"]
        ran = Ran([*words, *(["--device", args.device] if args.device else []), *shlex.split(args.extra)], None)
        if ran.code not in (0, 3):
            sys.exit(ran.error)
        lines = [json.loads(line) for line in (scratch / "out.jsonl").read_text().splitlines()]
    table = Table(args.out)
    for line in lines:
        if "metrics" in line:
            table.add({"pair": line["id"], "met": int(line["metrics"]["met"]), "f1_met": int(line["metrics"]["within"][0]["f1"]["met"]),
                       "cells": sum(way["survey"]["bounded"] for way in line["directions"]), "gpu_ms": line["run"]["times"]["gpu_ms"],
                       "read_ms": line["run"]["times"]["read_ms"], "device": line["run"]["device"]["name"]})
    table.print_sums(("met", "f1_met", "cells", "gpu_ms", "read_ms"))
    print(f"metrics: {len(distinct)} distinct pairs, {len(table.rows)} of {count} answered, {ran.seconds:.2f} s, {count / ran.seconds:.3f} pairs a second")
    return 0 if len(table.rows) == count else 1


# ---- estimates ----


def sample(mesh, count, random):
    """Points that are uniform over the area."""
    import numpy as np
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    face = np.searchsorted(np.cumsum(area), random.uniform(0, area.sum(), count)).clip(0, len(area) - 1)
    s, t = np.sqrt(random.uniform(size=count)), random.uniform(size=count)
    return (1 - s)[:, None] * a[face] + (s * (1 - t))[:, None] * b[face] + (s * t)[:, None] * c[face]


def sampled_figures(d, band):
    """{name: (figure of the samples, its standard error)}; a percentile's is by the ranks that are one of theirs away."""
    import numpy as np
    n = len(d)
    at = lambda rank: d[int(np.clip(rank, 0, n - 1))]
    square, share = (d * d).mean(), np.searchsorted(d, band, "right") / n
    out = {"mean": (d.mean(), d.std() / np.sqrt(n)),
           "rms": (np.sqrt(square), (d * d).std() / np.sqrt(n) / (2 * np.sqrt(square)) if square else 0),
           "share": (share, np.sqrt(max(share * (1 - share), 1 / n) / n))}
    for p in (0.5, 0.95):
        wide = np.sqrt(p * (1 - p) * n)
        out[f"p{100 * p:g}"] = at(np.ceil(p * n) - 1), (at(n * p + wide) - at(n * p - wide)) / 2
    return out


def estimates(args):
    import numpy as np
    import vkhausdorff as vkh
    table, faults, count = Table(args.out), [], 0
    for count, (pair, files) in enumerate(pairs_of(args), 1):
        a, b = map(vkh.read, files)
        least = 1e-6 * np.linalg.norm(np.ptp(np.asarray(a.vertices), axis=0))
        with vkh.Solver(b) as solver:
            band, parts = float(solver.distance(a, tol=1e-3).upper / 4), []
            points = sample(a, args.points, np.random.default_rng(1))
            for part in np.array_split(points, max(1, len(points) // 250_000)):
                found = solver.closest(part)
                parts.append((found.lower + found.upper) / 2)
        of_samples = sampled_figures(np.sort(np.concatenate(parts)), band)
        answer, _ = ask(args, "distance", *files, "--stats", "--bands", f"{band!r}abs")
        known = answer["directions"][0]["statistics"]
        figures = {"mean": known["mean"], "rms": known["rms"], "share": known["bands"][0]["share"]}
        figures |= {f"p{100 * one['share']:g}": one["distance"] for one in known["percentiles"] if one["share"] in (0.5, 0.95)}
        for name, figure in figures.items():
            value, error = of_samples[name]
            off = abs(figure["estimate"] - value)
            inside = figure["lower"] <= figure["estimate"] <= figure["upper"]
            agrees = off <= max(0.01 * abs(value), 3 * error, 0 if name == "share" else least)
            table.add({"pair": pair["pair"], "figure": name, **{key: figure[key] for key in ("lower", "estimate", "upper")}, "samples": value,
                       "error": error, "off": off / value if value else off, "inside": inside, "agrees": agrees})
            faults += [] if inside and agrees else [f"{pair['pair']} {name}: {figure['estimate']:.6g}, samples {value:.6g} +- {error:.2g}"]
    return print_faults("estimates", count, faults)


WHATS = {"race": race, "certificates": certificates, "gates": gates, "envelopes": envelopes, "metrics": metrics, "estimates": estimates}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--what", choices=WHATS, required=True)
    for name in ("program", "manifest", "out"):
        parser.add_argument(name)
    parser.add_argument("--only", default="", help="part of a pair's name")
    parser.add_argument("--pairs", type=int, help="number of pairs, the first ones; metrics: in all")
    parser.add_argument("--max-faces", type=int, default=10**9, help="of either mesh")
    parser.add_argument("--tol", default="1e-6", help="a fraction of the diagonal")
    parser.add_argument("--device", default="")
    parser.add_argument("--extra", default="", help="more words for the program, as --extra='--disable=sort'")
    parser.add_argument("--limit", type=float, default=600, help="seconds a process")
    parser.add_argument("--repeat", type=int, default=3, help="race: runs of each")
    parser.add_argument("--known", help="race, gates: stored intervals, CSV")
    parser.add_argument("--peer", action="append", default=[], help="race: PROGRAM; envelopes: NAME=PROGRAM, several")
    parser.add_argument("--check", help="certificates: vkh_check")
    parser.add_argument("--factors", help="gates, envelopes: of h, between commas")
    parser.add_argument("--points", type=int, default=1_000_000, help="estimates: samples")
    args = parser.parse_args()
    if args.what == "certificates" and not args.check:
        parser.error("certificates need --check")
    return WHATS[args.what](args)


if __name__ == "__main__":
    sys.exit(main())
