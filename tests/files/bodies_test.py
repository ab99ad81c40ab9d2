"""Random scenes against the triangles that they were made of: the bodies that are printed or shown,
and all shapes of the file.

usage: bodies_test.py PROGRAM [--count N] [--seed S] [--keep FOLDER]

N scenes of each format, 300 by default or VKH_BODIES_COUNT. A wrong answer is printed with its file, which is kept.
"""

import argparse
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

import random_3mf
import random_gltf
from random_mesh import stl


def write_3mf(made, folder):
    (folder / "scene.3mf").write_bytes(made.bytes())
    return "scene.3mf"


def write_gltf(made, folder):
    document, files = made.files("scene")
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    return document


class Case:
    def __init__(self, kind, number, seed, folder):
        self.id = f"{kind}-{number}"
        self.folder = folder / self.id
        self.folder.mkdir()
        made = (random_3mf.Package if kind == "3mf" else random_gltf.Scene)(random.Random(f"{seed} {self.id}"))
        self.file = self.folder / (write_3mf if kind == "3mf" else write_gltf)(made, self.folder)
        of = (lambda is_all: random_3mf.Expected(made.items, is_all)) if kind == "3mf" else (
            lambda is_all: random_gltf.Expected(made, is_all))
        self.expected = {"solid": of(False), "all": of(True)}
        for bodies, expected in self.expected.items():
            # A refused file needs no B, but a list has one.
            (self.folder / f"{bodies}.stl").write_bytes(stl(expected.triangles or [((0, 0, 0), (1, 0, 0), (0, 1, 0))]))

    def wrong(self, bodies, line):
        """The error in an answer; None: there is none."""
        expected = self.expected[bodies]
        if expected.refusals or "error" in line:
            message = line.get("error", {}).get("message", "")
            if line["code"] == 4 and any(says in message for says in expected.refusals):
                return None
            return f"expected {expected.refusals or 'an answer'}, not {message or 'one'}"
        a = line["inputs"][0]
        if a["faces"] != len(expected.triangles):
            return f"{a['faces']} faces of {len(expected.triangles)}"
        notes = [f"{note['code']}: {note['text']}" for note in a["notes"] if note["code"] == "bodies"]
        if notes != [note for note in [expected.note()] if note is not None]:
            return f"{notes}, not {expected.note()}"
        files = {file["path"] for file in a["files"]}
        if files != getattr(expected, "files", set()):
            return f"of the files {files}, not {expected.files}"
        # A map rounds by 1e-13, and the next place is half a unit away.
        interval = line["interval"]
        if interval["lower"] > 1e-9 or interval["upper"] > 1e-9 + line["tolerance"]["absolute"]:
            return f"an interval [{interval['lower']}, {interval['upper']}], not 0"
        return None


def measured(program, cases, bodies, folder):
    """Results by id."""
    rows = [{"id": case.id, "a": str(case.file), "b": str(case.folder / f"{bodies}.stl")} for case in cases]
    (folder / "list.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
    results = folder / f"{bodies}.jsonl"
    words = [program, "batch", folder / "list.jsonl", "--out", results, "--symmetric", "--bodies", bodies]
    done = subprocess.run(words, capture_output=True, text=True, timeout=3600)
    if done.returncode not in (0, 3, 4):
        sys.exit(f"batch ends with {done.returncode}: {done.stderr}")
    return {line["id"]: line for line in map(json.loads, results.read_text().splitlines())}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=int(os.environ.get("VKH_BODIES_COUNT", "300")))
    parser.add_argument("--seed", default="1")
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("bodies_test_wrong"))
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        cases = [Case(kind, i, given.seed, folder) for i in range(given.count) for kind in ("3mf", "gltf")]
        wrong = read = refused = 0
        for bodies in ("solid", "all"):
            results = measured(os.path.abspath(given.program), cases, bodies, folder)
            for case in cases:
                fault = case.wrong(bodies, results[case.id])
                refused += "error" in results[case.id]
                read += "error" not in results[case.id]
                if fault is None:
                    continue
                wrong += 1
                shutil.copytree(case.folder, given.keep / case.id, dirs_exist_ok=True)
                print(f"{given.keep / case.id / case.file.name} --bodies {bodies}: {fault}")
    print(f"{read} read, {refused} refused, {wrong} wrong")
    # With too few of either, little was tried.
    return 1 if wrong or min(read, refused) < given.count // 10 else 0


if __name__ == "__main__":
    sys.exit(main())
