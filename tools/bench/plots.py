"""Figs. 6 to 8 of the paper, from the measurements that tools/bench/tables.py reads."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  after the choice of a back end without a display


def save(figure, folder, name):
    figure.tight_layout()
    figure.savefig(folder / f"{name}.png", dpi=120, metadata={"Software": None})
    plt.close(figure)


def few(labels):
    return len(labels) <= 4


def bars(axis, title, labels, groups):
    """`groups`: name -> one value per label, None if there is none."""
    width = 0.8 / len(groups)
    for at, (name, values) in enumerate(groups.items()):
        places = [i + at * width for i in range(len(labels))]
        heights = [v if v is not None else 0 for v in values]
        for place, height in zip(places, heights):
            axis.text(place, height, f" {height:.2f}", ha="center", va="bottom", fontsize=6, rotation=0 if few(labels) else 90)
        axis.bar(places, heights, width, label=name)
    axis.axhline(1, color="black", linewidth=0.8)
    axis.set_xticks([i + 0.4 - width / 2 for i in range(len(labels))], labels, rotation=45, ha="right", fontsize=7)
    axis.set_title(title, fontsize=9)
    axis.set_ylabel("slowdown")
    axis.margins(y=0.15)
    axis.legend(fontsize=7)


def slowdowns(folder, name, bench, compared, Comparison):
    """Draws sums and p99, side by side or, for many variants, one above the other; a bar per family
    in each group. `compared`: (label, base, variant)."""
    shape = (1, 2) if few(compared) else (2, 1)
    figure, axes = plt.subplots(*shape, figsize=(8, 4) if few(compared) else (0.45 * len(compared) + 2, 9))
    for axis, title, value in ((axes[0], "by sums", Comparison.by_sums), (axes[1], "p99", Comparison.p99)):
        groups = {}
        for family in bench.families():
            found = [Comparison(bench, base, variant, family) for _, base, variant in compared]
            groups[family] = [value(c) if c else None for c in found]
        bars(axis, title, [label for label, _, _ in compared], groups)
    save(figure, folder, name)


def draw(folder, bench, changed, ablations, Comparison):
    thin = [(f"{variant} / {base}", base, variant) for base, variant in ablations if variant.endswith("-thin")]
    others = [(f"{variant} / {base}", base, variant) for base, variant in ablations if not variant.endswith("-thin")]
    baseline = [(f"baseline-gpu / {base}", base, "baseline-gpu") for base in ("default", "paper")
                if base in bench.variants and "baseline-gpu" in bench.variants]
    for name, source, compared in (("fig6", changed, others), ("fig7", changed, thin), ("fig8", bench, baseline)):
        if compared:
            slowdowns(folder, name, source, compared, Comparison)
