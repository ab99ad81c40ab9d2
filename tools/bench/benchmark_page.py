#!/usr/bin/env python3
"""Tables and charts of docs/benchmarks.md, from docs/data and docs/paper.

usage: tools/bench/benchmark_page.py [--check] [--format svg]

Tables are written between '<!-- table: NAME -->' and '<!-- end -->' in the page; charts to docs/images.
--check changes nothing and exits 1 where the page's tables are not those of the data; it needs no
matplotlib. Charts do (tools/setup --benchmarks).
"""
import argparse
import csv
import math
import pathlib
import re
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/benchmarks.md"
IMAGES = ROOT / "docs/images"
FAMILIES = {"tetwild": "TetWild", "decimation": "decimation", "envelope": "envelope", "smooth": "smoothed"}
FAMILY_COLOURS = {"tetwild": "#2a6fb0", "decimation": "#d1782a", "envelope": "#3a9a5b", "smooth": "#8d5fb5"}
PAYS, COSTS, NEITHER = "#2a6fb0", "#d1782a", "#9a9a9a"


def percentile(values, p):
    """Linear between closest ranks."""
    ordered = sorted(values)
    at = (len(ordered) - 1) * p / 100
    low = math.floor(at)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (ordered[high] - ordered[low]) * (at - low)


def rows(path):
    with open(ROOT / path, newline="") as file:
        return list(csv.DictReader(line for line in file if line.strip() and not line.startswith("#")))


def races():
    """Pairs that both closed: name, family, faces, ours, peer's (ms)."""
    peers = {row["pair"]: row for row in rows("docs/data/cpu-sota-on-the-h200-host.csv")}
    for row in rows("docs/data/h200-1e-6.csv"):
        peer = peers.get(row["pair"])
        if peer and peer["status"] == row["status"] == "closed":
            faces = int(row["faces_a"]) + int(row["faces_b"])
            yield row["pair"], row["family"], faces, float(row["gpu_ms"]), float(peer["solve_ms"])


def table(head, body):
    return "\n".join(["| " + " | ".join(line) + " |" for line in (head, ["---"] * len(head), *body)])


def race_table():
    body = []
    for family, title in FAMILIES.items():
        times = [(ours, peer) for _, f, _, ours, peer in races() if f == family]
        ours, peers = zip(*times)
        ratios = [peer / own for own, peer in times]
        body.append([title, str(len(times)), f"{statistics.median(ours):.2f} ms", f"{statistics.median(peers):,.0f} ms",
                     f"{sum(peers) / sum(ours):,.0f}x", f"{math.exp(statistics.fmean(map(math.log, ratios))):,.0f}x",
                     f"{percentile(ratios, 1):,.0f}x", f"{percentile(ratios, 99):,.0f}x"])
    return table(["pairs", "number", "ours, median", "CPU-SOTA, median", "ratio of sums", "geometric mean", "p1", "p99"], body)


def together_table():
    """Sums of GPU time that vkh_bench --together printed behind each series."""
    text = (ROOT / "docs/data/h200-together.csv").read_text()
    series = {}
    for part in text.split("# device")[1:]:
        # Pairs are cut into groups of N; the largest group is a full one.
        size = max(int(line.split(",")[1]) for line in part.splitlines() if re.match(r"\w+,\d", line))
        series[size] = {m[1]: (float(m[2]), float(m[3]))
                        for m in re.finditer(r"# (\w+): alone ([\d.]+) ms, together ([\d.]+) ms", part)}
    sizes = sorted(series)
    body = []
    for name, title in (("tetwild", "TetWild, 39"), ("decimation", "decimation, 32"), ("all", "all 80")):
        alone = [series[size][name][0] for size in sizes]
        body.append([title, f"{min(alone):.1f} to {max(alone):.1f} ms"] + [f"{series[size][name][1]:.1f} ms" for size in sizes])
    return table(["pairs", "one after the other"] + [f"{size} at once" for size in sizes], body)


def changes():
    """The default preset with one switch changed: name, ratio of sums, pairs that no longer end."""
    for row in rows("docs/paper/ablations.csv"):
        if row["base"] == "default" and row["family"] == "all" and "+sort+" not in row["variant"]:
            ended = 80 - int(row["pairs"])
            yield row["variant"], float(row["by sums"].rstrip("x")), row["p99"].rstrip("x"), ended


def switch_table():
    body = [[f"`{name}`", f"{ratio:.2f}x", f"{p99}x", str(lost)] for name, ratio, p99, lost in
            sorted(changes(), key=lambda change: -change[1])]
    return table(["change", "time, ratio of sums", "p99 of the pairs' ratios", "pairs that no longer end"], body)


def growth(surface):
    return [row for row in rows("docs/data/h200-growth.csv") if row["surface"] == surface]


def gpu_ms(row):
    return float(row["hierarchy_ms"]) + float(row["solve_ms"])


def millions(faces):
    return f"{int(faces) / 1e6:.1f} M"


def growth_table():
    body = []
    for row in growth("torus") + growth("frog"):
        million_faces = (int(row["faces_a"]) + int(row["faces_b"])) / 1e6
        body.append([row["surface"], millions(row["faces_a"]), millions(row["faces_b"]), f"{gpu_ms(row):.1f} ms",
                     f"{gpu_ms(row) / million_faces:.2f} ms", f"{float(row['load_ms']) / 1e3:.2f} s",
                     f"{float(row['upload_ms']) / 1e3:.2f} s", f"{float(row['process_ms']) / 1e3:.2f} s",
                     f"{float(row['peak_memory_gib']):.1f} GiB"])
    return table(["surface", "A", "B", "GPU", "of a million faces", "reading", "upload", "process", "host's memory"], body)


TABLES = {"race": race_table, "together": together_table, "switches": switch_table, "growth": growth_table}


def with_tables(text):
    def replace(match):
        return f"<!-- table: {match[1]} -->\n{TABLES[match[1]]()}\n<!-- end -->"

    return re.sub(r"<!-- table: (\w+) -->\n.*?<!-- end -->", replace, text, flags=re.DOTALL)


def draw(kind):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    matplotlib.rcParams.update({"svg.hashsalt": "vkhausdorff", "svg.fonttype": "none", "font.size": 9})

    def save(figure, name):
        figure.tight_layout()
        figure.savefig(IMAGES / f"{name}.{kind}", metadata={"Date": None} if kind == "svg" else {"Software": None})

    figure, axis = plt.subplots(figsize=(7.6, 4.2))
    for family, title in FAMILIES.items():
        points = [(faces, ours, peer) for _, f, faces, ours, peer in races() if f == family]
        faces, ours, peers = zip(*points)
        axis.scatter(faces, peers, s=16, marker="^", facecolors="none", edgecolors=FAMILY_COLOURS[family])
        axis.scatter(faces, ours, s=16, color=FAMILY_COLOURS[family], label=title)
    axis.set(xscale="log", yscale="log", xlabel="faces of A and B together", ylabel="time of one pair, ms",
             title="CPU-SOTA on one core: triangles. One H200: dots.")
    axis.title.set_fontsize(9.5)
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8, loc="center left")
    save(figure, "benchmark-pairs")

    figure, axis = plt.subplots(figsize=(7.6, 4.2))
    found = sorted(changes(), key=lambda change: change[1])
    names = [name + (f" ({lost} do not end)" if lost else "") for name, _, _, lost in found]
    ratios = [ratio for _, ratio, _, _ in found]
    colours = [NEITHER if abs(r - 1) < 0.03 else (PAYS if name.startswith("-") else COSTS)
               for name, r in zip(names, ratios)]
    axis.barh(range(len(found)), ratios, color=colours)
    for i, ratio in enumerate(ratios):
        axis.text(ratio + 0.02, i, f"{ratio:.2f}x", va="center", fontsize=8)
    axis.set_yticks(range(len(found)), names, fontsize=8, family="monospace")
    axis.axvline(1, color="black", linewidth=0.8)
    axis.set(xlim=(0, max(ratios) * 1.1), xlabel="time over that of the default preset, sums over the pairs",
             title="Off costs time: blue. On costs time: orange. Under 3 %: grey.")
    axis.title.set_fontsize(9.5)
    save(figure, "benchmark-switches")

    figure, axis = plt.subplots(figsize=(7.6, 4.2))
    # Pairs whose B has half of A's faces: the same kind of pair at every size.
    found = [row for row in growth("torus") if int(row["faces_b"]) < 0.6 * int(row["faces_a"])]
    faces = [int(row["faces_a"]) + int(row["faces_b"]) for row in found]
    for name, colour, value in (("process", COSTS, lambda row: float(row["process_ms"])),
                                ("reading", NEITHER, lambda row: float(row["load_ms"])), ("GPU", PAYS, gpu_ms)):
        axis.plot(faces, [value(row) for row in found], color=colour, marker="o", markersize=4, label=name)
    first = gpu_ms(found[0])
    axis.plot(faces, [first * f / faces[0] for f in faces], color="black", linewidth=0.8, linestyle=":", label="linear")
    axis.set(xscale="log", yscale="log", xlabel="faces of A and B together", ylabel="time, ms",
             title="A noisy torus against another of half its faces. One H200, 16 cores.")
    axis.title.set_fontsize(9.5)
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    save(figure, "benchmark-growth")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--format", default="svg", choices=("svg", "png"))
    args = parser.parse_args()
    text = PAGE.read_text()
    made = with_tables(text)
    if args.check:
        if made != text:
            sys.exit(f"{PAGE}: its tables are not those of the data; run {sys.argv[0]}")
        return
    PAGE.write_text(made)
    draw(args.format)


if __name__ == "__main__":
    main()
