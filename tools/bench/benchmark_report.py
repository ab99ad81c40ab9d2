"""The results of benchmark_pairs.py as CSV and Markdown: medians, checks, speed-ups per family."""

import csv
import math
import platform
import statistics
import subprocess
from dataclasses import dataclass, field
from datetime import datetime, timezone
from pathlib import Path

COUNTS = ("waves", "candidates", "queries", "peak_frontier")
# The operands of each speed-up; README and results quote these words.
METRICS = {
    "process": "wall time of the process: start, files, device, answer",
    "call": "peer's solve_ms (host clock around its solver call, B's tree included) over ours "
    "(upload and hierarchy included)",
    "solve": "the same peer's solve_ms over our GPU time (hierarchy and solve)",
}
NEAR = 0.005  # of diag(A): a TetWild pair above it has lost or closed parts of A


@dataclass(frozen=True)
class Pair:
    name: str
    family: str
    file_a: Path
    file_b: Path
    faces_a: int
    faces_b: int


@dataclass
class Run:
    """One process, ours or the peer's."""

    wall_ms: float = math.nan
    call_ms: float = math.nan
    solve_ms: float = math.nan
    lower: float = math.nan
    upper: float = math.nan
    status: str = ""
    diagonal_a: float = math.nan
    hierarchy_ms: float = math.nan
    device: str = ""
    driver: str = ""
    counts: dict = field(default_factory=dict)
    error: str = ""


@dataclass
class Result:
    pair: Pair
    ours: Run
    peer: Run | None
    failed: list
    speedups: dict


# ---- Statistics ----


def percentile(values, p):
    """A percentile, linear between closest ranks."""
    ordered = sorted(values)
    at = (len(ordered) - 1) * p / 100
    low = math.floor(at)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (ordered[high] - ordered[low]) * (at - low)


def groups_of(result):
    groups = ["all", result.pair.family]
    if result.pair.family == "tetwild":
        near = result.ours.lower <= NEAR * result.ours.diagonal_a
        groups.append("tetwild, near (h <= 0.005 diag)" if near else "tetwild, far")
    return groups


def our_time(run, metric):
    return {"process": run.wall_ms, "call": run.call_ms, "solve": run.solve_ms}[metric]


def summary_row(group, metric, results):
    ratios = [r.speedups[metric] for r in results]
    ours = math.fsum(our_time(r.ours, metric) for r in results)
    peer = math.fsum(our_time(r.peer, metric) for r in results)
    geometric = math.exp(statistics.fmean(math.log(x) for x in ratios))
    numbers = [statistics.median(ratios), peer / ours, geometric]
    numbers += [min(ratios), percentile(ratios, 90), percentile(ratios, 99)]
    return [group, metric, str(len(ratios))] + [f"{x:.3g}" for x in numbers]


def summary_rows(results):
    groups = {}
    for result in results:
        for group in groups_of(result) if result.speedups else []:
            groups.setdefault(group, []).append(result)
    rows = []
    for group in sorted(groups, key=lambda name: (name == "all", name)):
        for metric in METRICS:
            with_time = [r for r in groups[group] if math.isfinite(r.speedups[metric])]
            if with_time:
                rows.append(summary_row(group, metric, with_time))
    return rows


# ---- CSV ----

CSV_COLUMNS = (
    "pair family faces_a faces_b status lower upper gap process_ms call_ms solve_ms hierarchy_ms "
    "waves candidates queries peak_frontier peer_status peer_process_ms peer_solve_ms peer_lower "
    "peer_upper speedup_process speedup_call speedup_solve failed error"
).split()


def number(x):
    return f"{x:.17g}" if math.isfinite(x) else ""


def csv_row(r):
    run, peer = r.ours, r.peer or Run()
    row = [r.pair.name, r.pair.family, r.pair.faces_a, r.pair.faces_b, run.status]
    gap = (run.upper - run.lower) / (run.diagonal_a or math.nan)
    row += [number(run.lower), number(run.upper), number(gap)]
    row += [f"{x:.3f}" for x in (run.wall_ms, run.call_ms, run.solve_ms, run.hierarchy_ms)]
    row += [run.counts.get(name, "") for name in COUNTS]
    row += [peer.status, f"{peer.wall_ms:.3f}", f"{peer.solve_ms:.3f}"]
    row += [number(peer.lower), number(peer.upper)]
    row += [f"{r.speedups[m]:.4g}" if r.speedups else "" for m in METRICS]
    row += [" ".join(r.failed), " ".join(filter(None, (run.error, peer.error)))]
    return ["" if cell == "nan" else cell for cell in row]


def commit_of(folder):
    def git(*words):
        done = subprocess.run(["git", "-C", str(folder), *words], capture_output=True, text=True)
        return done.stdout.strip() if done.returncode == 0 else None

    try:
        head = git("rev-parse", "HEAD") or ""
        return head + (" with local changes" if head and git("status", "--porcelain") else "")
    except OSError:  # no git here
        return ""


def cpu_name():
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if "model name" in line)
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def describe(args):
    """The facts known before the first pair; read once, since the checkout may change meanwhile."""
    peer = f"{args.peer}, run in turn with ours" if args.peer else "none"
    if args.peer_csv:
        peer = f"NOT RUN HERE: stored times of {args.peer_csv}, perhaps of another machine"
    return {
        "date": datetime.now(timezone.utc).isoformat(timespec="seconds"),
        "commit": args.commit or commit_of(Path(__file__).resolve().parent) or "unknown",
        "host": f"{cpu_name()}, {platform.system()} {platform.release()}",
        "program": args.program,
        "switches": " ".join(filter(None, (args.device and f"--device {args.device}", args.extra))),
        "peer": peer,
        "tolerance": f"{args.tol} of diag(A)",
        "runs": f"median of {args.repeat}; limit {args.limit:g} s",
        "pairs": f"{args.manifest}, faces_a <= {args.max_faces}, filter '{args.filter}'",
    }


def header(about, results):
    run = next((r.ours for r in results if r.ours.device), Run(device="unknown", driver="unknown"))
    return [*about.items(), ("device", run.device), ("driver", run.driver)]


def write_csv(path, about, results):
    with open(path, "w", newline="", encoding="utf-8") as file:
        for key, value in header(about, results):
            file.write(f"# {key}: {value}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(CSV_COLUMNS)
        writer.writerows(csv_row(r) for r in results)


# ---- Markdown ----


def table(titles, rows, left=1):
    rule = [":--"] * left + ["--:"] * (len(titles) - left)
    return ["| " + " | ".join(row) + " |" for row in (titles, rule, *rows)]


def pair_row(r):
    run, peer = r.ours, r.peer or Run()
    times = (run.wall_ms, run.call_ms, run.solve_ms, peer.wall_ms, peer.solve_ms)
    cells = [r.pair.name, str(r.pair.faces_a), run.status]
    cells += [f"{x:.2f}" if math.isfinite(x) else "-" for x in times]
    cells += [f"{r.speedups[m]:.3g}" if r.speedups else "-" for m in METRICS]
    return cells + [" ".join(r.failed) or "-"]


def failures(results):
    bad = [r for r in results if r.failed]
    rows = [f"- {r.pair.name}: {' '.join(r.failed)} {r.ours.error}".rstrip() for r in bad]
    held = f"{len(results) - len(bad)} of {len(results)} pairs hold all"
    return ["", f"## Checks: {held}", "", *rows]


def left_out(results):
    rows = []
    for r in (r for r in results if not r.speedups):
        peer = "no peer time" if r.peer is None else f"peer {r.peer.status} {r.peer.error}".rstrip()
        rows.append(f"- {r.pair.name}: ours {r.ours.status}, {peer}")
    return ["", f"## Without a speed-up: {len(rows)}", "", *rows] if rows else []


SUMMARY_TITLES = "group,time,pairs,median,sum/sum,geometric mean,min,p90,p99".split(",")
PAIR_TITLES = (
    "pair,faces A,status,process ms,call ms,solve ms,peer process ms,peer solve ms,"
    "speed-up process,call,solve,failed"
).split(",")


def summary(results):
    return table(SUMMARY_TITLES, summary_rows(results), left=2) + failures(results)


def write_markdown(path, about, results):
    lines = ["# VkHausdorff against its peer", ""]
    lines += [f"- {key}: {value or '-'}" for key, value in header(about, results)]
    lines += ["", "Speed-ups: the peer's time over ours, if both closed and all checks held.", ""]
    lines += [f"- {name}: {meaning}" for name, meaning in METRICS.items()]
    lines += ["", *summary(results), *left_out(results), "", "## Pairs", ""]
    lines += table(PAIR_TITLES, [pair_row(r) for r in results])
    Path(path).write_text("\n".join(lines) + "\n", encoding="utf-8")
