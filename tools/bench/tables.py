#!/usr/bin/env python3
"""The paper's Tables 1-4 and Figs. 6-8 from what vkh_bench measured, as Markdown, CSV and PNG.

usage: tools/bench/tables.py --bench BENCH.csv... [--ablations ABLATIONS.csv...] [--peer PEER.csv] [--memory MEMORY.csv...]
                       --out FOLDER [--time solve_ms]

BENCH.csv, ABLATIONS.csv (by default the same), MEMORY.csv: what vkh_bench prints. Slowdowns of Figs. 6 and 7 are within
ABLATIONS.csv alone. PEER.csv: pair, solve_ms, status. Where a file has a pair and preset twice,
the last row counts. Times are those of the column --time names: solve_ms (default; seed, waves and report on the device,
as the paper has it), gpu_ms (the hierarchy besides) or wall_ms. Percentiles are linear between closest ranks. Plots need
matplotlib (Debian: python3-matplotlib); without it the tables are written and the output says so.
"""
import argparse
import csv
import pathlib
import statistics
import sys

from benchmark_page import percentile, rows as rows_of

PRESETS = ("default", "paper", "baseline-gpu")
FAMILIES = ("tetwild", "decimation")
TOP = 5


def read_rows(paths):
    return {(row["pair"], row["preset"]): row for path in paths for row in rows_of(pathlib.Path(path).resolve())}


def base_of(variant):
    """The preset that a variant changes, '' for a preset itself: '-u3' and '+sort' are default's."""
    for preset in PRESETS:
        if variant == preset:
            return ""
        if variant.startswith((preset + "-", preset + "+")):
            return preset
    return "default" if variant[:1] in "+-" else ""


class Bench:
    def __init__(self, paths, column):
        self.column = column
        # A limit that is the same for all of a file's rows is no property of the variant.
        self.rows = {(pair, name.split("@")[0]): row for (pair, name), row in read_rows(paths).items()}
        self.variants = list(dict.fromkeys(name for _, name in self.rows))
        self.wrong = sorted(pair for (pair, _), row in self.rows.items() if row["verdict"] != "ok")

    def families(self):
        found = {row["family"] for row in self.rows.values()}
        return [f for f in FAMILIES if f in found] + sorted(found - set(FAMILIES))

    def closed(self, variant, family=None):
        """Pair -> row, for the pairs that the variant closes."""
        return {pair: row for (pair, name), row in self.rows.items()
                if name == variant and row["status"] == "closed" and family in (None, row["family"])}

    def time(self, row):
        return float(row[self.column])

    def count(self, variant, status):
        return sum(1 for (_, name), row in self.rows.items() if name == variant and row["status"] == status)


class Output:
    """A page of Markdown, and a CSV per table."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.page = []

    def say(self, text=""):
        self.page.append(text)

    def table(self, name, title, header, rows):
        with open(self.folder / f"{name}.csv", "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([header, *rows])
        self.say(f"## {title}\n")
        for cells in (header, ["---"] * len(header), *rows):
            self.say("| " + " | ".join(str(c) for c in cells) + " |")
        self.say()

    def write(self):
        (self.folder / "README.md").write_text("\n".join(self.page).rstrip() + "\n")


def ms(x):
    return f"{x:.2f}"


def times(x):
    return f"{x:.2f}x"


# ---- Tables 1 and 2: against the peer


def speedup_rows(bench, peer, family, presets):
    """Compares over the pairs that the peer and all of the presets close, as the paper does."""
    common = {p for p, row in peer.items() if row["status"] == "closed"}
    for preset in presets:
        common &= bench.closed(preset, family).keys()
    rows = []
    for preset in presets if common else []:
        ours = bench.closed(preset, family)
        own = [bench.time(ours[p]) for p in sorted(common)]
        theirs = [float(peer[p]["solve_ms"]) for p in sorted(common)]
        ratios = [t / o for t, o in zip(theirs, own)]
        rows.append([preset, len(common), ms(statistics.median(theirs)), ms(statistics.median(own)),
                     times(sum(theirs) / sum(own)), times(statistics.geometric_mean(ratios)), times(percentile(ratios, 90)),
                     times(percentile(ratios, 99))])
    return rows


def write_peer_tables(out, bench, peer):
    presets = [p for p in PRESETS if p in bench.variants]
    header = ["preset", "pairs", "peer median ms", "median ms", "mean-ratio", "geo-mean", "p90", "p99"]
    number = {"tetwild": "Table 1", "decimation": "Table 2"}
    for family in bench.families():
        rows = speedup_rows(bench, peer, family, presets)
        if rows:
            out.table(f"peer-{family}", f"{number.get(family, 'Likewise')}: {family}, against the peer on one core", header, rows)


# ---- Table 3: where the time goes


def write_breakdown(out, bench, preset="default"):
    rows = []
    for family in bench.families():
        closed = bench.closed(preset, family).values()
        if not closed:
            continue

        def median(sum_of):
            return ms(statistics.median(sum(float(r[c]) for c in sum_of) for r in closed))

        before = ("load_ms", "upload_ms", "hierarchy_ms", "setup_ms")
        rows.append([family, len(closed), median(["load_ms"]), median(["upload_ms", "hierarchy_ms"]), median(["setup_ms"]),
                     median(before), median(["solve_ms"]), median([*before, "solve_ms"])])
    if rows:
        out.table("breakdown", f"Table 3: medians end to end, preset {preset}, ms",
                  ["family", "pairs", "load", "upload + hierarchy", "GPU init", "setup", "solve", "total"], rows)
        out.say("The paper's CPU pre (its hierarchy) is upload + hierarchy here, built on the GPU. GPU init is device and pipelines.\n")


# ---- Table 4 and Figs. 6 to 8: against another preset


class Comparison:
    """Times of two variants on the pairs that both close."""

    def __init__(self, bench, base, variant, family=None):
        ours, other = bench.closed(base, family), bench.closed(variant, family)
        self.pairs = sorted(ours.keys() & other.keys())
        self.base = [bench.time(ours[p]) for p in self.pairs]
        self.other = [bench.time(other[p]) for p in self.pairs]
        self.slowdowns = [o / b for o, b in zip(self.other, self.base)]

    def __bool__(self):
        return bool(self.pairs)

    def by_sums(self):
        return sum(self.other) / sum(self.base)

    def p99(self):
        return percentile(self.slowdowns, 99)

    def slowest(self, least=1.05):
        """The pairs with the largest slowdowns, if any is worth naming."""
        ranked = sorted(zip(self.slowdowns, self.pairs, self.base, self.other), reverse=True)
        return [r for r in ranked[:TOP] if r[0] > least]


def write_top(out, bench, base, number):
    c = Comparison(bench, base, "baseline-gpu")
    if not c:
        return
    rows = [[pair, ms(own), ms(other), times(slow)] for slow, pair, own, other in c.slowest(least=0)]
    out.table(f"top-{base}", f"{number}: largest speed-ups of {base} over baseline-gpu",
              ["pair", f"{base} ms", "baseline-gpu ms", "speed-up"], rows)


NOISE = 0.03  # one preset's sums differ by as much from one place in the turn to another


def does_it_pay(base, variant, slowdown):
    change = variant.removeprefix(base)
    name = change.lstrip("+-")
    without = change.startswith("-")
    if abs(slowdown - 1) <= NOISE:
        return f"{name}: no difference"
    return f"{name} pays" if (slowdown > 1) == without else f"{name} does not pay"


def ablations(bench):
    """(base, variant) of each variant that changes a preset that was measured."""
    return [(base_of(v), v) for v in bench.variants if base_of(v) and base_of(v) in bench.variants]


def write_ablations(out, bench):
    rows = []
    for base, variant in ablations(bench):
        for family in [None, *bench.families()]:
            c = Comparison(bench, base, variant, family)
            if not c:
                continue
            lost = [bench.count(variant, s) - bench.count(base, s) for s in ("time", "memory", "precision")] if not family else ["", "", ""]
            rows.append([base, variant, family or "all", len(c.pairs), times(c.by_sums()), times(statistics.median(c.slowdowns)),
                         times(c.p99()), *lost, does_it_pay(base, variant, c.by_sums())])
    if rows:
        out.table("ablations", "Fig. 6: slowdown of each variant, sums and p99",
                  ["base", "variant", "family", "pairs", "by sums", "median", "p99", "time-outs more", "memory losses more",
                   "precision more", ""], rows)


def write_midpoint(out, bench):
    for base, variant in ablations(bench):
        if not variant.endswith("-thin"):
            continue
        rows = [[base, pair, ms(own), ms(other), times(slow)]
                for slow, pair, own, other in Comparison(bench, base, variant).slowest()]
        if rows:
            out.table(f"midpoint-{base}", f"Fig. 7: pairs where midpoints alone are slower, {base}",
                      ["base", "pair", "mixed ms", "midpoints ms", "slowdown"], rows)


def write_baseline(out, bench):
    rows = []
    for base in ("default", "paper"):
        for family in [None, *bench.families()]:
            c = Comparison(bench, base, "baseline-gpu", family)
            if c:
                rows.append([base, family or "all", len(c.pairs), times(c.by_sums()), times(statistics.median(c.slowdowns)),
                             times(c.p99())])
    if rows:
        out.table("baseline", "Fig. 8: slowdown of baseline-gpu", ["against", "family", "pairs", "by sums", "median", "p99"], rows)


# ---- memory


def write_memory(out, paths):
    rows = read_rows(paths)
    names = list(dict.fromkeys(name for _, name in rows))
    table = []
    for name in names:
        own = [row for (_, n), row in rows.items() if n == name]
        count = {s: sum(1 for r in own if r["status"] == s) for s in ("closed", "time", "memory", "precision")}
        variant, _, memory = name.partition("@")
        table.append([variant, memory or "recommended", len(own), *count.values(), ms(sum(float(r["gpu_ms"]) for r in own if r["status"] == "closed"))])
    out.table("memory", "Memory (6.3): what ends a run in how much",
              ["variant", "workspace", "pairs", "closed", "time-outs", "memory losses", "precision", "GPU ms of the closed"], table)


def summary(out, bench, title):
    out.say(f"## {title}\n")
    for name in bench.variants:
        lost = ", ".join(f"{bench.count(name, s)} {s}" for s in ("time", "memory", "precision") if bench.count(name, s))
        out.say(f"- {name}: {len(bench.closed(name))} closed" + (f", {lost}" if lost else ""))
    out.say()
    if bench.wrong:
        out.say(f"WRONG, intervals that do not meet or repeats that differ: {', '.join(bench.wrong)}\n")


def draw(folder, bench, changed):
    try:
        import plots  # beside this file
    except ImportError as missing:
        print(f"tables.py: no plots: {missing} (Debian: python3-matplotlib)", file=sys.stderr)
        return False
    plots.draw(pathlib.Path(folder), bench, changed, ablations(changed), Comparison)
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bench", nargs="+", required=True)
    parser.add_argument("--ablations", nargs="+")
    parser.add_argument("--peer")
    parser.add_argument("--memory", nargs="+")
    parser.add_argument("--out", required=True)
    parser.add_argument("--time", default="solve_ms", choices=("solve_ms", "gpu_ms", "wall_ms"))
    args = parser.parse_args()
    bench = Bench(args.bench, args.time)
    changed = Bench(args.ablations, args.time) if args.ablations else bench
    out = Output(args.out)
    device = [line[2:].strip() for path in args.bench for line in open(path) if line.startswith("# device")]
    out.say(f"# The paper's tables and figures\n\nMade by `tools/bench/tables.py`; times are `{args.time}`, medians. {'; '.join(dict.fromkeys(device))}.\n")
    summary(out, bench, "Presets")
    if changed is not bench:
        summary(out, changed, "Changes of presets")
    if args.peer:
        write_peer_tables(out, bench, {row["pair"]: row for row in rows_of(pathlib.Path(args.peer).resolve())})
    write_breakdown(out, bench)
    write_top(out, bench, "default", "Table 4")
    write_top(out, bench, "paper", "Likewise")
    write_ablations(out, changed)
    write_midpoint(out, changed)
    write_baseline(out, bench)
    if args.memory:
        write_memory(out, args.memory)
    if draw(args.out, bench, changed):
        for figure in ("fig6", "fig7", "fig8"):
            if (out.folder / f"{figure}.png").exists():
                out.say(f"![{figure}]({figure}.png)\n")
    out.write()
    return 1 if bench.wrong or changed.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
