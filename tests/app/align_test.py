"""--align and --save-transform: verdicts, JSON, lists and files of A where a fit put it.

usage: align_test.py PROGRAM ROOT [unittest's own]
The truth of a pair comes from rational arithmetic: A is a few points, B a cube, and the matrix is the one in the JSON.
"""

import csv
import json
import math
import os
import random
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

PROGRAM, ROOT = os.path.abspath(sys.argv.pop(1)), sys.argv.pop(1)
CUBE = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
CUBE_FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
              (1, 5, 7), (1, 7, 3)]


def lump(rings=12, parts=18):
    """A closed, lopsided surface: vertices and faces."""
    points, faces = [], []
    for i in range(rings + 1):
        for j in range(parts):
            u, v = math.pi * i / rings, 2 * math.pi * j / parts
            r = 10 + 3 * math.sin(u) * math.cos(v) + 2 * math.sin(2 * u) * math.sin(v) + math.sin(u) * math.cos(3 * v) + math.cos(u)
            points.append((1.5 * r * math.sin(u) * math.cos(v), r * math.sin(u) * math.sin(v), 0.7 * r * math.cos(u)))
    for i in range(rings):
        for j in range(parts):
            a, b = parts * i + j, parts * i + (j + 1) % parts
            faces += [(a, b, b + parts), (a, b + parts, a + parts)]
    return points, faces


def turned(points, axis, angle, shift=(0, 0, 0)):
    length = math.sqrt(sum(x * x for x in axis))
    k = [x / length for x in axis]
    c, s = math.cos(angle), math.sin(angle)
    out = []
    for p in points:
        along = sum(a * b for a, b in zip(k, p)) * (1 - c)
        cross = (k[1] * p[2] - k[2] * p[1], k[2] * p[0] - k[0] * p[2], k[0] * p[1] - k[1] * p[0])
        out.append(tuple(p[i] * c + cross[i] * s + k[i] * along + shift[i] for i in range(3)))
    return out


def write(path, points, faces):
    with open(path, "w", encoding="ascii") as out:
        out.write("".join("v %r %r %r\n" % tuple(map(float, p)) for p in points))
        out.write("".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in faces))


def cube_distance2(p):
    if all(0 <= x <= 1 for x in p):
        return min(min(x, 1 - x) for x in p) ** 2
    return sum(max(-x, x - 1, 0) ** 2 for x in p)


class Folder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.part = lump()
        write(cls.path("part.obj"), *cls.part)
        cls.moved = turned(cls.part[0], (1, 2, 3), 1.9, (30, -40, 5))
        write(cls.path("scan.obj"), cls.moved, cls.part[1])

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder.name, name)

    def run_it(self, *words, code=0):
        done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, cwd=self.folder.name, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout if code in (0, 1, 3) else done.stderr

    def json_of(self, *words, code=0):
        return json.loads(self.run_it(*words, "--json", code=code))

    def no_run(self, answer):
        """An answer without its times and words."""
        kept = {k: v for k, v in answer.items() if k in ("interval", "transform", "boxes", "status", "verdict")}
        return kept


class OnePair(Folder):
    def test_a_verdict_says_that_it_is_after_a_fit(self):
        first = self.run_it("gate", "scan.obj", "part.obj", "--max", "0.001abs", "--align").splitlines()[0]
        self.assertTrue(first.startswith("PASS  after a fit (--align): every point of A is within 0.001"), first)
        write(self.path("larger.obj"), [tuple(1.05 * x for x in p) for p in self.moved], self.part[1])
        text = self.run_it("gate", "larger.obj", "part.obj", "--max", "0.001abs", "--align", code=1)
        self.assertTrue(text.startswith("FAIL  after a fit (--align): "), text)
        self.assertIn("  note       fit: A was moved by a fit that was found, not proven the best: ", text)
        self.assertIn("  A placed   by a matrix that a fit found, that moves", text)
        text = self.run_it("distance", "scan.obj", "part.obj", "--align")
        self.assertTrue(text.startswith("after a fit (--align): every point of A is within "), text)
        plain = self.run_it("gate", "scan.obj", "part.obj", "--max", "0.001abs", code=1)
        self.assertNotIn("fit", plain)

    def test_json_has_the_matrix_and_that_it_was_found(self):
        answer = self.json_of("distance", "scan.obj", "part.obj", "--align")
        transform = answer["transform"]
        self.assertIs(transform["found"], True)
        self.assertLess(transform["rms"], 1e-9)
        self.assertGreater(transform["share"], 0.9)
        self.assertEqual((transform["path"], transform["matrix"][3]), (None, [0, 0, 0, 1]))
        self.assertIn("fit", [note["code"] for note in answer["notes"]])
        for was, is_now in zip(self.part[0], self.moved):
            for i in range(3):
                row = transform["matrix"][i]
                self.assertAlmostEqual(sum(a * b for a, b in zip(row, (*is_now, 1))), was[i], delta=1e-9)

    def test_a_saved_matrix_gives_the_same_answer(self):
        found = self.json_of("distance", "scan.obj", "part.obj", "--align", "--save-transform", "fit.txt")
        placed = self.json_of("distance", "scan.obj", "part.obj", "--transform", "fit.txt", "--save-transform", "again.txt")
        self.assertEqual(found["transform"]["matrix"], placed["transform"]["matrix"])
        self.assertEqual(found["interval"], placed["interval"])
        self.assertNotIn("found", placed["transform"])
        with open(self.path("fit.txt"), encoding="ascii") as one, open(self.path("again.txt"), encoding="ascii") as other:
            self.assertEqual(one.read(), other.read())

    def test_a_fit_goes_on_from_a_matrix_and_a_unit(self):
        half = [f for f in self.part[1] if sum(self.part[0][i][0] for i in f) > 0]
        inches = [tuple(x / 25.4 for x in p) for p in self.moved]
        write(self.path("inches.obj"), inches, half)
        rough = turned([(1, 0, 0), (0, 1, 0), (0, 0, 1)], (1, 2, 3), -1.8)
        with open(self.path("rough.txt"), "w", encoding="ascii") as out:
            centre = turned([(30, -40, 5)], (1, 2, 3), -1.8)[0]
            out.write("".join("%r %r %r %r\n" % (*(rough[j][i] for j in range(3)), -centre[i]) for i in range(3)) + "0 0 0 1\n")
        words = ["distance", "inches.obj", "part.obj", "--unit-a", "in", "--unit-b", "mm"]
        found = self.json_of(*words, "--transform", "rough.txt", "--align", "--save-transform", "whole.txt")
        self.assertLess(found["interval"]["upper"], 1e-4)
        self.assertEqual((found["transform"]["factor"], found["transform"]["path"]), ([127, 5], "rough.txt"))
        placed = self.json_of(*words, "--transform", "whole.txt")
        self.assertEqual(found["interval"], placed["interval"])

    def test_the_same_bits_each_time(self):
        runs = {json.dumps(self.json_of("distance", "scan.obj", "part.obj", "--align")["transform"]) for _ in range(3)}
        self.assertEqual(len(runs), 1)

    def test_an_interval_after_a_fit_encloses_the_rational_truth(self):
        rng = random.Random(5)
        write(self.path("cube.obj"), CUBE, CUBE_FACES)
        for case in range(8):
            points = [tuple(x + rng.gauss(0, 0.05) for x in p) for p in CUBE]
            points = turned(points, [rng.gauss(0, 1) for _ in range(3)], 0.3, [rng.uniform(-1, 1) for _ in range(3)])
            write(self.path("points.obj"), points, [(i, i, i) for i in range(8)])
            answer = self.json_of("distance", "points.obj", "cube.obj", "--align", "--tol", "1e-9")
            rows = [[Fraction(x) for x in row] for row in answer["transform"]["matrix"]]
            truth = max(cube_distance2([sum(r * Fraction(x) for r, x in zip(row, (*p, 1.0))) for row in rows[:3]])
                        for p in points)
            lower, upper = (Fraction(float.fromhex(answer["interval"][end])) for end in ("lower_hex", "upper_hex"))
            self.assertTrue(lower ** 2 <= truth <= upper ** 2, (case, float(truth) ** 0.5, answer["interval"]))
            self.assertLess(upper - lower, Fraction(1, 10 ** 7))

    def test_at_the_exact_inverse_the_interval_has_the_true_distance(self):
        write(self.path("cube.obj"), CUBE, CUBE_FACES)
        points = [(Fraction(x) + Fraction(1, 8), Fraction(y), Fraction(z)) for x, y, z in CUBE]
        truth = max(cube_distance2(p) for p in points)
        # A is turned by 90 degrees about z and moved: both are exact, and so is the inverse.
        write(self.path("a.obj"), [(-y + 7, x - 3, z + 1) for x, y, z in points], [(i, i, i) for i in range(8)])
        with open(self.path("inverse.txt"), "w", encoding="ascii") as out:
            out.write("0 1 0 3\n-1 0 0 7\n0 0 1 -1\n0 0 0 1\n")
        answer = self.json_of("distance", "a.obj", "cube.obj", "--transform", "inverse.txt")
        lower, upper = (Fraction(float.fromhex(answer["interval"][end])) for end in ("lower_hex", "upper_hex"))
        self.assertTrue(lower ** 2 <= truth <= upper ** 2)

    def test_notes_tell_a_poor_fit_and_another_place(self):
        write(self.path("cube.obj"), CUBE, CUBE_FACES)
        write(self.path("turned.obj"), turned(CUBE, (1, 2, 3), 0.5), CUBE_FACES)
        codes = [n["code"] for n in self.json_of("distance", "turned.obj", "cube.obj", "--align")["notes"]]
        self.assertIn("other-fit", codes)
        self.assertNotIn("poor-fit", codes)
        write(self.path("rod.obj"), [(x / 9, y / 9, 9 * z) for x, y, z in CUBE], CUBE_FACES)
        codes = [n["code"] for n in self.json_of("distance", "rod.obj", "cube.obj", "--align")["notes"]]
        self.assertIn("poor-fit", codes)

    def test_what_goes_together_and_what_does_not(self):
        text = self.run_it("distance", "scan.obj", "part.obj", "--save-transform", "x.txt", code=2)
        self.assertIn("--save-transform: there is no matrix: ask for --align or --transform", text)
        text = self.run_it("distance", "scan.obj", "part.obj", "--align", "--part", "0/2", code=2)
        self.assertIn("--part: ", text)
        text = self.run_it("gate", "scan.obj", "part.obj", "--max", "1abs", "--align", "--save-transform", "part.obj", code=2)
        self.assertIn("part.obj", text)
        text = self.run_it("distance", "scan.obj", "part.obj", "--align", "--save-transform", "x", "--json=x", code=2)
        self.assertIn("two outputs", text)

    def test_certificates_are_of_the_matrix(self):
        answer = self.json_of("gate", "scan.obj", "part.obj", "--max", "0.001abs", "--align", "--certificate", "c.vhc")
        self.assertEqual(answer["verdict"], "pass")
        sys.path.insert(0, os.path.join(ROOT, "check"))
        done = subprocess.run([sys.executable, os.path.join(ROOT, "check", "vkh_check.py"), "c.vhc", "scan.obj", "part.obj"],
                              capture_output=True, text=True, cwd=self.folder.name, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_fit_that_time_ended_is_a_true_answer(self):
        answer = self.json_of("distance", "scan.obj", "part.obj", "--align", "--time", "1ms", code=3)
        self.assertNotIn("transform", answer)
        self.assertEqual((answer["status"], answer["interval"]["lower"]), ("time", 0))

    def test_build_servers_are_told(self):
        self.run_it("gate", "scan.obj", "part.obj", "--max", "1abs", "--align", "--junit", "j.xml", "--github")
        with open(self.path("j.xml"), encoding="utf-8") as file:
            self.assertIn("fit: A was moved by a fit", file.read())


class Lists(Folder):
    def lines(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return {line["id"]: line for line in map(json.loads, file)}

    def test_a_column_keys_and_resuming(self):
        with open(self.path("list.csv"), "w", encoding="ascii") as out:
            out.write("id,a,b,align\nfitted,scan.obj,part.obj,true\nplain,scan.obj,part.obj,false\n"
                      "empty,scan.obj,part.obj,\n")
        self.run_it("batch", "list.csv", "--out", "r.jsonl", "--max", "0.001abs", "--csv", "r.csv", code=1)
        lines = self.lines("r.jsonl")
        self.assertEqual([lines[i]["verdict"] for i in ("fitted", "plain", "empty")], ["pass", "fail", "fail"])
        self.assertIs(lines["fitted"]["transform"]["found"], True)
        self.assertTrue(lines["fitted"]["words"].startswith("PASS  after a fit (--align): "))
        self.assertNotEqual(lines["fitted"]["key"], lines["plain"]["key"])
        self.assertEqual(lines["empty"]["key"], lines["plain"]["key"])
        alone = self.json_of("gate", "scan.obj", "part.obj", "--max", "0.001abs", "--align")
        self.assertEqual(lines["fitted"]["transform"]["matrix"], alone["transform"]["matrix"])
        with open(self.path("r.csv"), encoding="utf-8", newline="") as file:
            row = next(r for r in csv.DictReader(file) if r["id"] == "fitted")
        self.assertIn("fit: A was moved", row["notes"])
        before = self.lines("r.jsonl")
        self.run_it("batch", "list.csv", "--out", "r.jsonl", "--max", "0.001abs", "--resume", code=1)
        self.assertEqual(before, self.lines("r.jsonl"))
        self.run_it("batch", "list.csv", "--out", "r.jsonl", "--max", "0.001abs", "--resume", "--align", code=1)
        self.assertEqual(self.lines("r.jsonl")["empty"]["verdict"], "pass")

    def test_several_side_by_side_with_one_b(self):
        with open(self.path("many.csv"), "w", encoding="ascii") as out:
            out.write("id,a,b\n" + "".join(f"{i},{i}.obj,part.obj\n" for i in range(4)) + "bad,bad.obj,part.obj\n")
        for i in range(4):
            write(self.path(f"{i}.obj"), turned(self.part[0], (i, 1, 2), 1.0 + i, (9 * i, 0, 0)), self.part[1])
        write(self.path("bad.obj"), [(math.nan, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        self.run_it("batch", "many.csv", "--out", "m.jsonl", "--max", "0.001abs", "--align", "--together", "3", code=4)
        lines = self.lines("m.jsonl")
        self.assertEqual([lines[str(i)]["verdict"] for i in range(4)], ["pass"] * 4)


if __name__ == "__main__":
    unittest.main()
