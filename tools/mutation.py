#!/usr/bin/env python3
"""Weakens each named constant and error term of the certificate, one at a time, and asks whether the tests notice.

usage: tools/mutation.py [--build out] [--only TEXT] [--cases N] [--jobs N] [--quick] [--report FILE]

The headers and sources are copied to a temporary tree; for each mutant the tests named in its row are compiled there
with the flags of the build folder, linked with its libraries, and run until one fails. A constant is weakened step by
step: first by one, then further, then removed; the first step that a test notices is the row's result. A row that
survives to its end needs a reason in docs/certificate.md, and is listed in EXPECTED_SURVIVORS below.
Exit code 1 if a row survives that is not expected to. The build folder needs its tests built (ninja).
"""

import argparse
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from mutation_table import EXPECTED_SURVIVORS, QUICK, ROWS  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
COPIED = ("shaders", "host", "engine", "tests")


class Tree:
    """A copy of the sources and how a test is built from it."""

    def __init__(self, build: pathlib.Path, cases: int):
        self.build = build.resolve()
        self.cases = cases
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vkh_mutation_"))
        for name in COPIED:
            shutil.copytree(ROOT / name, self.folder / name)

    def own(self, test: str) -> pathlib.Path:
        found, = (self.folder / "tests").glob(f"**/{test}.cpp")
        return found

    def program_of(self, test: str) -> str:
        """Its own, or that of all tests in its folder (tests/programs.cmake)."""
        alone = f"tests/{test}"
        return alone if (self.build / alone).exists() else f"tests/{self.own(test).parent.name}_tests"

    def commands(self, test: str) -> list[str]:
        """The compilation of the test's own file and its link, as ninja would run them."""
        text = subprocess.run(["ninja", "-C", str(self.build), "-t", "commands", self.program_of(test)],
                              capture_output=True, text=True, check=True).stdout.splitlines()
        compiled = [line for line in text if f"{test}.cpp.o -c " in line]
        if len(compiled) != 1:
            raise SystemExit(f"tools/mutation.py: {self.build} does not know how to compile {test}")
        return [compiled[0], text[-1]]

    def run(self, test: str, sources: list[str]) -> bool:
        """True if the test passes. A mutant that does not compile is a mistake in the table."""
        compile_line, link_line = (self.in_this_tree(line) for line in self.commands(test))
        objects = []
        for source in [str(self.own(test).relative_to(self.folder)), *sources]:
            made = self.folder / (source.replace("/", "_") + ".o")
            self.shell(compile_line.split(" -o ")[0] + f" -O1 -w -o {made} -c {self.folder / source}")
            objects.append(str(made))
        program = self.folder / test
        before, after = link_line.split(f" -o {self.program_of(test)} ")
        head = before.split(" tests/CMakeFiles/")[0]
        # The mutated objects come before the archives, whose own copies are then not taken. A unity build's archive
        # has a room in one object, which comes with the rest of the room: its second definitions are passed over.
        self.shell(f"{head} -Wl,-z,muldefs {' '.join(objects)} -o {program} {after}")
        environment = dict(os.environ, VKH_CASES=str(self.cases), VKH_TEST_NATIVE="1")  # a device runs no mutant of host/native
        return subprocess.run([str(program)], env=environment, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, timeout=600).returncode == 0

    def in_this_tree(self, line: str) -> str:
        line = line.replace(f"-I{ROOT} ", f"-I{self.folder} ")
        words = [w for w in line.split() if not w.endswith("ccache")]
        kept, skip = [], 0
        for word in words:
            if word in ("-MT", "-MF"):
                skip = 2
            if skip:
                skip -= 1
            elif word not in ("-MD", "-Werror"):
                kept.append(word)
        return " ".join(kept)

    def shell(self, line: str) -> None:
        done = subprocess.run(["bash", "-c", line], cwd=self.build, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"tools/mutation.py: does not build:\n{line}\n{done.stderr[-3000:]}")


def check_table() -> None:
    """Checks that every row's text occurs as often as stated, even if only a few rows run."""
    for row in ROWS:
        found = (ROOT / row["file"]).read_text().count(row["old"])
        if found < row.get("nth", 1):
            raise SystemExit(f"tools/mutation.py: {row['file']} has '{row['old']}' {found} times; the table is out of date")


def mutate(tree: Tree, row: dict, replacement: str) -> str:
    """Writes the mutant and returns the file's own text."""
    path = tree.folder / row["file"]
    text = path.read_text()
    at = -1
    for _ in range(row.get("nth", 1)):
        at = text.index(row["old"], at + 1)
    path.write_text(text[:at] + replacement + text[at + len(row["old"]):])
    return text


def weaken(tree: Tree, row: dict) -> dict:
    """Weakens step by step until a test fails."""
    tried = []
    for step in row["new"]:
        original = mutate(tree, row, step)
        try:
            sources = [row["file"]] if row["file"].endswith(".cpp") else []
            for test in row["tests"]:
                if not tree.run(test, sources):
                    return {"row": row, "killed_at": step, "by": test, "survived": tried}
        finally:
            (tree.folder / row["file"]).write_text(original)
        tried.append(step)
    return {"row": row, "killed_at": None, "by": "", "survived": tried}


def line_for(result: dict) -> str:
    row = result["row"]
    outcome = f"killed at '{result['killed_at']}' by {result['by']}" if result["killed_at"] is not None else "SURVIVED"
    passed = f"; unnoticed: {', '.join(repr(s) for s in result['survived'])}" if result["survived"] else ""
    expected = ""
    if result["killed_at"] is None and row["name"] in EXPECTED_SURVIVORS:
        expected = f" (expected: {EXPECTED_SURVIVORS[row['name']]})"
    return f"{row['name']}: {row['file']} '{row['old']}' {outcome}{passed}{expected}"


def worker(args, rows: list[dict]) -> list[dict]:
    tree = Tree(pathlib.Path(args.build), args.cases)
    results = []
    try:
        for row in rows:
            results.append(weaken(tree, row))
            print(line_for(results[-1]), flush=True)
    finally:
        shutil.rmtree(tree.folder)
    return results


def main() -> int:
    parser = argparse.ArgumentParser(description="Do the tests notice a weakened certificate?")
    parser.add_argument("--build", default=str(ROOT / "out"))
    parser.add_argument("--only", default="", help="rows whose name holds this")
    parser.add_argument("--cases", type=int, default=100000)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--quick", action="store_true", help="a few rows, as in the test suite")
    parser.add_argument("--report", help="write the lines there too")
    args = parser.parse_args()
    check_table()
    rows = [r for r in ROWS if args.only in r["name"]]
    if args.quick:
        rows = [dict(r, new=[r["new"][-1]]) for r in rows if r["name"] in QUICK]
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        parts = [rows[i::args.jobs] for i in range(args.jobs)]
        results = [r for part in pool.map(lambda p: worker(args, p), parts) for r in part]
    if not results:
        raise SystemExit("tools/mutation.py: no row")
    survived = [r for r in results if r["killed_at"] is None]
    surprises = [r for r in survived if r["row"]["name"] not in EXPECTED_SURVIVORS]
    first = sum(1 for r in results if r["killed_at"] is not None and not r["survived"])
    summary = (f"mutation: {len(results)} error terms, {len(results) - len(survived)} killed, {first} of them one too "
               f"small; {len(survived)} survived, {len(surprises)} of them unexpectedly")
    print(summary)
    if args.report:
        text = "\n".join(sorted(line_for(r) for r in results) + [summary]) + "\n"
        pathlib.Path(args.report).write_text(text)
    return 1 if surprises else 0


if __name__ == "__main__":
    sys.exit(main())
