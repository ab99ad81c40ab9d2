"""A list of pairs that are spheres in spheres, and the process that writes a batch's results."""

import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "platforms"))

import meshes  # noqa: E402

PAIRS = 24
FAIL = 1  # a batch of them all


def write_pairs(folder: pathlib.Path) -> pathlib.Path:
    """LIST, and its files. One of two pairs with a limit is beyond it."""
    with open(folder / "list.jsonl", "w") as rows:
        for i in range(PAIRS):
            for side, n, radius in (("a", 60 + i, 1.0), ("b", 61 + i, 1.1)):
                (folder / f"{side}{i}.ply").write_bytes(meshes.as_ply(*meshes.sphere(n, radius)))
            limit = {7: {"max": "0.05abs"}, 8: {"max": "0.2abs"}}.get(i, {})
            rows.write(json.dumps({"id": f"pair {i}", "a": f"a{i}.ply", "b": f"b{i}.ply", **limit}) + "\n")
    return folder / "list.jsonl"


def lines(path: pathlib.Path) -> list[bytes]:
    return path.read_bytes().splitlines() if path.exists() else []


def begun(results: pathlib.Path) -> int:
    """The program that writes them, as soon as there is a whole line; otherwise 0."""
    if not results.exists() or b"\n" not in results.read_bytes():
        return 0
    for process in pathlib.Path("/proc").iterdir():
        try:
            words = (process / "cmdline").read_text().split("\0") if process.name.isdigit() else []
            if "batch" in words and "--out" in words:
                if (process / "cwd").resolve() / words[words.index("--out") + 1] == results:
                    return int(process.name)
        except (OSError, UnicodeDecodeError):  # it has ended, or it is none of ours
            continue
    return 0
