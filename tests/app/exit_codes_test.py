"""The exit codes of each command: those that the page's table and --help document happen, and they document the same.

usage: exit_codes_test.py PROGRAM PAGE
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, PAGE = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
COMMANDS = ("distance", "gate", "metrics", "demo", "batch", "merge", "doctor")
SQUARE = "v 0 0 {z}\nv 1 0 {z}\nv 1 1 {z}\nv 0 1 {z}\nf 1 2 3\nf 1 3 4\n"
FULL = "> /dev/full"  # standard output is a full disk
NO_DEVICE = ("--device", "no such device")


def on_page():
    """The codes of each command by the page's table, whose last column names commands, or those that have no such code."""
    table = PAGE.read_text().split("**Exit codes**")[1].split("\n\n")[1].splitlines()
    codes = {command: set() for command in COMMANDS}
    for row in table[2:]:
        _, code, _, of, _ = row.split("|")
        named = set(re.findall(r"`(\w+)`", of))
        for command in set(COMMANDS) - named if of.strip().startswith("all") else named:
            codes[command].add(int(code))
    return codes


def in_help(command):
    text = subprocess.run([PROGRAM, command, "--help"], capture_output=True, text=True, timeout=60, check=True).stdout
    said = re.sub(r"\s+", " ", text.split("Exit codes: ")[1].split("The worst counts")[0])
    return set(map(int, re.findall(r"(?:^|; )(\d+) ", said)))


class ExitCodes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder, cls.batches = pathlib.Path(scratch.name), {}
        for name, z in (("a", 0), ("b", 0.25)):
            (cls.folder / f"{name}.obj").write_text(SQUARE.format(z=z))
        (cls.folder / "bad.obj").write_text("v 0 0 zero\n")
        for name, row in (("closed", "a.obj,b.obj,"), ("fail", "a.obj,b.obj,0.1abs"), ("unit", "a.obj,b.obj,1mm"), ("open", "a.obj,b.obj,0.25abs"), ("bad", "bad.obj,b.obj,")):
            (cls.folder / f"{name}.csv").write_text(f"id,a,b,max\n{name},{row}\n")
            done = subprocess.run([PROGRAM, "batch", f"{name}.csv", "--out", f"{name}.jsonl"], cwd=cls.folder, capture_output=True, timeout=120)
            cls.batches[name] = done.returncode
        lost = json.loads((cls.folder / "bad.jsonl").read_text())
        lost["code"] = lost["error"]["code"] = 5
        lost["error"]["message"] = "the device was lost"
        (cls.folder / "lost.jsonl").write_text(json.dumps(lost, separators=(",", ":")) + "\n")

    def cases(self):
        pair, bad, out = ("a.obj", "b.obj"), ("bad.obj", "b.obj"), ("--out", "new.jsonl")
        wrong = ("--no-such-option",)
        return {
            "distance": {0: pair, 2: pair + wrong, 3: (*pair, "--waves", "0"), 4: bad, 5: pair + NO_DEVICE, 6: (*pair, FULL)},
            "gate": {0: (*pair, "--max", "1abs"), 1: (*pair, "--max", "0.1abs"), 2: pair, 3: (*pair, "--max", "0.25abs"), 4: (*bad, "--max", "1abs"),
                     5: (*pair, "--max", "1abs", *NO_DEVICE), 6: (*pair, "--max", "1abs", FULL)},
            "metrics": {0: pair, 2: pair + wrong, 3: (*pair, "--bands", "0.25abs", "--effort", "2000"), 4: bad, 5: pair + NO_DEVICE, 6: (*pair, FULL)},
            "demo": {0: ("--tol", "1e-2diag"), 2: wrong, 3: ("--waves", "1"), 5: NO_DEVICE, 6: ("--tol", "1e-2diag", FULL)},
            "batch": {5: ("closed.csv", *out, *NO_DEVICE), 6: ("closed.csv", *out, FULL)},  # and self.batches
            "merge": {0: ("closed.jsonl", *out), 1: ("fail.jsonl", *out), 2: ("unit.jsonl", *out), 3: ("open.jsonl", *out), 4: ("bad.jsonl", *out),
                      5: ("lost.jsonl", *out), 6: ("closed.jsonl", *out, FULL)},
            "doctor": {0: (), 2: wrong, 5: NO_DEVICE, 6: (FULL,)},
        }

    def code_of(self, command, words):
        (self.folder / "new.jsonl").unlink(missing_ok=True)
        with open("/dev/full" if FULL in words else "/dev/null", "w") as output:
            done = subprocess.run([PROGRAM, command, *(word for word in words if word != FULL)], cwd=self.folder, stdout=output, stderr=subprocess.PIPE, text=True, timeout=120)
        return done.returncode, done.stderr

    def test_each_documented_code_happens(self):
        cases, documented = self.cases(), on_page()
        self.assertEqual(self.batches, {"closed": 0, "fail": 1, "unit": 2, "open": 3, "bad": 4})
        for command in COMMANDS:
            happens = set(cases[command]) | set(self.batches.values() if command == "batch" else ())
            self.assertEqual(documented[command], happens, command)
            self.assertEqual(in_help(command), happens, command)
            for code, words in cases[command].items():
                with self.subTest(command=command, code=code):
                    ended, said = self.code_of(command, words)
                    self.assertEqual(ended, code, said)

    def test_the_worst_of_a_batch_counts(self):
        """5, 4, 6, 2, 1, 3, 0: two that are neighbours end with the first."""
        results = [(5, "lost"), (4, "bad"), (2, "unit"), (1, "fail"), (3, "open"), (0, "closed")]
        lines = {name: json.loads((self.folder / f"{name}.jsonl").read_text()) for _, name in results}
        for (worse, first), (_, second) in zip(results, results[1:]):
            text = "".join(json.dumps({**lines[name], "id": name}, separators=(",", ":")) + "\n" for name in (second, first))
            (self.folder / "two.jsonl").write_text(text)
            with self.subTest((first, second)):
                self.assertEqual(self.code_of("merge", ("two.jsonl", "--out", "new.jsonl"))[0], worse)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
