"""--align and --save-transform: verdicts, JSON, lists and files of A where a fit put it.

usage: align_test.py PROGRAM ROOT [unittest's own]
That fits are good, and what an interval after one holds: tests/solve/align_test.cpp.
"""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM, ROOT = os.path.abspath(sys.argv.pop(1)), sys.argv.pop(1)
# No symmetry, and three faces that a fit cannot slide along.
PART = [(0, 0, 0), (3, 0, 0), (0, 2, 0), (0.5, 0.25, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
CUBE = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
CUBE_FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
              (1, 5, 7), (1, 7, 3)]


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


class Folder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.part = PART
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


class OnePair(Folder):
    def test_a_verdict_says_that_it_is_after_a_fit(self):
        write(self.path("larger.obj"), [tuple(1.05 * x for x in p) for p in self.moved], self.part[1])
        text = self.run_it("gate", "larger.obj", "part.obj", "--max", "0.001abs", "--align", code=1)
        self.assertTrue(text.startswith("FAIL  after a fit (--align): "), text)
        self.assertIn("  note       fit: A was moved by a fit that was found, not proven the best: ", text)
        self.assertIn("  A placed   by a matrix that a fit found, that moves", text)
        text = self.run_it("distance", "scan.obj", "part.obj", "--align")
        self.assertTrue(text.startswith("after a fit (--align): every point of A is within "), text)
        plain = self.run_it("gate", "scan.obj", "part.obj", "--max", "0.001abs", code=1)
        self.assertNotIn("fit", plain)

    def test_a_saved_matrix_gives_the_same_answer(self):
        found = self.json_of("distance", "scan.obj", "part.obj", "--align", "--save-transform", "fit.txt")
        transform = found["transform"]
        self.assertIs(transform["found"], True)
        self.assertLess(transform["rms"], 1e-9)
        self.assertGreater(transform["share"], 0.9)
        self.assertEqual((transform["path"], transform["matrix"][3]), (None, [0, 0, 0, 1]))
        self.assertIn("fit", [note["code"] for note in found["notes"]])
        for was, is_now in zip(self.part[0], self.moved):  # by rows, and of A
            for i in range(3):
                self.assertAlmostEqual(sum(a * b for a, b in zip(transform["matrix"][i], (*is_now, 1))), was[i], delta=1e-9)
        placed = self.json_of("distance", "scan.obj", "part.obj", "--transform", "fit.txt", "--save-transform", "again.txt")
        self.assertEqual(found["transform"]["matrix"], placed["transform"]["matrix"])
        self.assertEqual(found["interval"], placed["interval"])
        self.assertNotIn("found", placed["transform"])
        with open(self.path("fit.txt"), encoding="ascii") as one, open(self.path("again.txt"), encoding="ascii") as other:
            self.assertEqual(one.read(), other.read())

    def test_a_fit_goes_on_from_a_matrix_and_a_unit(self):
        inches = [tuple(x / 25.4 for x in p) for p in self.moved]
        write(self.path("inches.obj"), inches, self.part[1][1:])
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
        text = self.run_it("gate", "scan.obj", "part.obj", "--max", "0.001abs", "--align", "--certificate", "c.vhc", "--junit", "j.xml", "--github")
        self.assertIn("PASS  after a fit (--align): every point of A is within 0.001", text.splitlines()[0])
        sys.path.insert(0, os.path.join(ROOT, "check"))
        done = subprocess.run([sys.executable, os.path.join(ROOT, "check", "vkh_check.py"), "c.vhc", "scan.obj", "part.obj"],
                              capture_output=True, text=True, cwd=self.folder.name, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(self.path("j.xml"), encoding="utf-8") as file:
            self.assertIn("fit: A was moved by a fit", file.read())

    def test_a_fit_that_time_ended_is_a_true_answer(self):
        answer = self.json_of("distance", "scan.obj", "part.obj", "--align", "--time", "1ms", code=3)
        self.assertNotIn("transform", answer)
        self.assertEqual((answer["status"], answer["interval"]["lower"]), ("time", 0))


class Lists(Folder):
    def lines(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return {line["id"]: line for line in map(json.loads, file)}

    def test_a_column_keys_and_resuming(self):
        with open(self.path("list.csv"), "w", encoding="ascii") as out:
            out.write("id,a,b,align\nfitted,scan.obj,part.obj,true\nplain,scan.obj,part.obj,false\n"
                      "empty,scan.obj,part.obj,\nother,other.obj,part.obj,true\n")
        write(self.path("other.obj"), turned(self.part[0], (1, 1, 2), 2.0, (9, 0, 0)), self.part[1])
        self.run_it("batch", "list.csv", "--out", "r.jsonl", "--max", "0.001abs", "--csv", "r.csv", "--together", "4", code=1)
        lines = self.lines("r.jsonl")
        self.assertEqual([lines[i]["verdict"] for i in ("fitted", "plain", "empty", "other")], ["pass", "fail", "fail", "pass"])
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


if __name__ == "__main__":
    unittest.main()
