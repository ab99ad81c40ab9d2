"""A's that are placed, by units and a matrix: intervals enclose what rationals say, and both checkers accept certificates.

usage: placing_test.py PROGRAM [--cases N] [--seed S] [unittest's own]
VKH_CHECK is the checking program, and so is VKH_CHECK_PROVEN, if it is set. B is a point, from which h(M A, B) is the distance of A's farthest corner: a convex
function is largest at a corner. So the truth is the root of a rational, and is found here from the decimals that are typed.
"""

import argparse
import json
import math
import os
import random
import struct
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "check"))
import vkh_check  # noqa: E402

PROVEN = os.environ.get("VKH_CHECK_PROVEN", "")
OPTIONS = argparse.Namespace(program="", cases=400, seed=1)
UNITS = {"um": Fraction(1, 1000), "mm": Fraction(1), "cm": Fraction(10), "m": Fraction(1000), "in": Fraction(127, 5),
         "ft": Fraction(1524, 5)}
MAGNITUDES = (1e-3, 1, 1, 1, 1e4)


def rotation(rng):
    x, y, z, w = (rng.gauss(0, 1) for _ in range(4))
    s = 2 / (x * x + y * y + z * z + w * w)
    return [[1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
            [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
            [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)]]


class Case:
    def __init__(self, rng, folder, number):
        self.size, self.id = rng.choice(MAGNITUDES), f"case {number}"
        self.points = [[rng.uniform(-1, 1) * self.size for _ in range(3)] for _ in range(4)]
        self.unit_a, self.unit_b = rng.choice(list(UNITS)), rng.choice(list(UNITS))
        self.rows = None
        if number % 2:
            self.rows = [[*row, rng.uniform(-9, 9) * self.size * float(self.factor())] for row in rotation(rng)]
        size = self.size * float(self.factor())
        self.b = [float(x) + rng.uniform(-2, 2) * size for x in self.placed(self.points[0])]
        self.files = [os.path.join(folder, f"{number}{name}") for name in ("a.obj", "b.obj", ".txt")]
        self.write(self.files[0], self.points, [(1, 2, 3), (1, 2, 4), (2, 3, 4), (1, 3, 4)])
        self.write(self.files[1], [self.b], [(1, 1, 1)])
        if self.rows:
            with open(self.files[2], "w", encoding="ascii") as out:
                out.write("\n".join(" ".join(map(repr, row)) for row in [*self.rows, [0, 0, 0, 1]]))

    @staticmethod
    def write(path, points, faces):
        with open(path, "w", encoding="ascii") as out:
            out.write("".join("v %r %r %r\n" % tuple(p) for p in points) + "".join("f %d %d %d\n" % f for f in faces))

    def factor(self):
        return UNITS[self.unit_a] / UNITS[self.unit_b]

    def placed(self, point):
        at = [self.factor() * Fraction(x) for x in point]
        if self.rows is None:
            return at
        return [sum(Fraction(m) * x for m, x in zip(row, at)) + Fraction(row[3]) for row in self.rows]

    def square(self):
        """The square of h(M A, B)."""
        return max(sum((x - Fraction(y)) ** 2 for x, y in zip(self.placed(p), self.b)) for p in self.points)

    def row(self):
        out = {"id": self.id, "a": self.files[0], "b": self.files[1], "unit_a": self.unit_a, "unit_b": self.unit_b}
        return {**out, "transform": self.files[2]} if self.rows else out

    def words(self):
        return [*self.files[:2], "--unit-a", self.unit_a, "--unit-b", self.unit_b,
                *(["--transform", self.files[2]] if self.rows else [])]


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, timeout=600, check=False)


class Placed(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="vkh placing ")
        rng = random.Random(OPTIONS.seed)
        self.cases = [Case(rng, self.folder.name, i) for i in range(OPTIONS.cases)]

    def tearDown(self):
        self.folder.cleanup()

    def test_intervals_enclose_the_truth(self):
        path = os.path.join(self.folder.name, "list.jsonl")
        with open(path, "w", encoding="utf-8") as out:
            out.write("".join(json.dumps(case.row()) + "\n" for case in self.cases))
        results = os.path.join(self.folder.name, "results.jsonl")
        done = run(OPTIONS.program, "batch", path, "--out", results)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(results, encoding="utf-8") as lines:
            records = {r["id"]: r for r in map(json.loads, lines) if "id" in r}
        self.assertEqual(len(records), len(self.cases))
        for case in self.cases:
            interval, truth = records[case.id]["interval"], case.square()
            self.assertLessEqual(Fraction(interval["lower"]) ** 2, truth, case.id)
            self.assertGreaterEqual(Fraction(interval["upper"]) ** 2, truth, case.id)
            self.assertLessEqual(interval["gap"], 1e-6)
            self.assertEqual(interval["unit"], case.unit_b)
            self.assertEqual("transform" in records[case.id], case.rows is not None or case.factor() != 1)

    def test_both_checkers_accept_certificates_and_refuse_others(self):
        path = os.path.join(self.folder.name, "proof.vhc")
        for case in self.cases[:12]:
            done = run(OPTIONS.program, "distance", *case.words(), "--symmetric", "--certificate", path)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(set(self.checked(path, case)), {0}, case.id)
            with open(path, "rb") as file:
                proof = file.read()
            for at, change in self.spoilt(case):
                with open(path, "wb") as file:
                    file.write(proof[:at] + change + proof[at + len(change):])
                for code in self.checked(path, case):
                    self.assertIn(code, (1, 4), f"{case.id}: {at}")

    # The header has 176 bytes; then come how A was read, 32 bytes of it before the unit, p and q and the matrix.
    def spoilt(self, case):
        yield 176 + 24, struct.pack("<d", 9999)
        yield 176 + 24, struct.pack("<d", 0.5)
        yield 176 + 32, struct.pack("<d", 7919)
        yield 176 + 40, struct.pack("<Q", 2)
        if case.rows:
            yield 176 + 48, struct.pack("<d", case.rows[0][0] + 0.5)
            yield 176 + 48 + 24, struct.pack("<d", case.rows[0][3] + 20 * case.size * float(case.factor()))
            yield 176 + 48, struct.pack("<d", math.nan)

    def checked(self, path, case):
        done = run(os.environ["VKH_CHECK"], path, *case.files[:2])
        codes = [done.returncode, vkh_check.checked(path, *case.files[:2])[0]]
        if PROVEN:
            corners = [path + ".a", path + ".b"]
            written = run(os.environ["VKH_CHECK"], path, *case.files[:2], "--corners", *corners)
            codes.append(written.returncode or run(PROVEN, path, *corners).returncode)
        return codes


if __name__ == "__main__":
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("program")
    parser.add_argument("--cases", type=int, default=OPTIONS.cases)
    parser.add_argument("--seed", type=int, default=OPTIONS.seed)
    OPTIONS, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest])
