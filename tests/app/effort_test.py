#!/usr/bin/env python3
"""--effort: a run writes the same bytes again, whatever else the machine does; words, and which pairs of a list use it.

usage: effort_test.py PROGRAM
That figures depend on the effort alone, and why surveys end: tests/solve/survey_test.cpp and wave_survey_test.cpp.
"""

import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = sys.argv.pop(1)
BUSY = "while True: pass"


def wavy(cells, height):
    """An OBJ of a wavy sheet."""
    rows = []
    for i in range(cells + 1):
        for j in range(cells + 1):
            x, y = 2 * i / cells - 1, 2 * j / cells - 1
            rows.append(f"v {x!r} {y!r} {0.1 * math.sin(5 * x) * math.cos(4 * y) + height!r}")
    for i in range(cells):
        for j in range(cells):
            corner = i * (cells + 1) + j + 1
            right, above = corner + 1, corner + cells + 1
            rows += [f"f {corner} {right} {above}", f"f {right} {above + 1} {above}"]
    return "\n".join(rows) + "\n"


def without_times(value):
    """Leaves out what is of one run: times, and the workspace, which the memory that is free decides."""
    if isinstance(value, list):
        return [without_times(item) for item in value]
    if not isinstance(value, dict):
        return value
    return {key: without_times(item) for key, item in value.items()
            if not key.endswith("_ms") and key not in ("times", "started", "workspace_bytes")}


class Effort(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        folder = pathlib.Path(cls.folder.name)
        cls.a, cls.b = folder / "a.obj", folder / "b.obj"
        cls.a.write_text(wavy(12, 0.1))
        cls.b.write_text(wavy(8, 0))

    def run_program(self, *options):
        return subprocess.run([PROGRAM, *options], capture_output=True, text=True)

    def outputs(self, *words):
        """JSON but for its times, and the bytes of all files that show an answer; of the page, all but its record and its JSON."""
        folder = pathlib.Path(self.folder.name)
        names = ("o.png", "o-b.png", "o.ply", "o-b.ply", "figures.csv", "places.csv", "o.html")
        done = self.run_program(*words, "--image", folder / "o.png", "--field", folder / "o.ply", "--figures-csv", folder / "figures.csv",
                                "--points-out", folder / "places.csv", "--report", folder / "o.html", "--json")
        self.assertIn(done.returncode, (0, 1, 3), done.stderr)
        data = {name: (folder / name).read_bytes() for name in names}
        page = data["o.html"].decode()
        page, count = re.subn(r'id="answer">.*?</script>', "", page, flags=re.S)
        page, more = re.subn(r'<section class="record">.*?</section>', "", page, flags=re.S)
        self.assertEqual((count, more), (1, 1))
        data["o.html"] = page
        data["json"] = without_times(json.loads(done.stdout))
        return data

    def test_two_runs_are_the_same_beside_a_busy_machine(self):
        words = ("gate", str(self.a), str(self.b), "--max", "0.15abs", "--symmetric", "--bands", "0.05abs", "--field-tol", "1e-5", "--effort", "2001")
        first = self.outputs(*words)
        survey = first["json"]["directions"][0]["survey"]
        self.assertEqual((survey["ended"], survey["effort"], survey["met"], survey["bounded"]), ("effort", 2001, False, 288 + 2000))
        busy = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range((os.cpu_count() or 1) + 1)]
        try:
            second = self.outputs(*words)
        finally:
            for one in busy:
                one.kill()
                one.wait()
        for name, data in first.items():
            self.assertTrue(data == second[name], name)

    def test_the_table_says_that_it_was_used(self):
        table = self.run_program("distance", str(self.a), str(self.b), "--field-tol", "1e-6", "--effort", "10")
        self.assertIn("its effort was used before all that was asked was met", table.stdout)

    def test_refusals(self):
        pair = (str(self.a), str(self.b))
        for options, said in (((*pair, "--stats", "--effort", "-1"), "--effort '-1': expected a whole number"),
                              ((*pair, "--stats", "--effort", "1e6"), "--effort '1e6': expected a whole number"),
                              ((*pair, "--stats", "--effort", ""), "--effort"),
                              ((*pair, "--effort", "5"), "--effort: is of figures and faces' bounds")):
            done = self.run_program("distance", *options)
            self.assertEqual(done.returncode, 2, options)
            self.assertIn(said, done.stderr)

    def test_pictures_of_another_effort_are_drawn_again(self):
        folder = pathlib.Path(self.folder.name)
        (folder / "list.csv").write_text("id,a,b\nsheet,a.obj,b.obj\n")
        reports = folder / "reports"

        def batch(*options):
            done = self.run_program("batch", str(folder / "list.csv"), "--out", str(folder / "results.jsonl"), "--resume",
                                    *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            return (reports / "sheet.html").stat().st_mtime_ns

        drawn = batch("--report-dir", str(reports), "--effort", "100")
        self.assertEqual(batch("--report-dir", str(reports), "--effort", "100"), drawn)
        self.assertGreater(batch("--report-dir", str(reports), "--effort", "200"), drawn)
        done = self.run_program("batch", str(folder), str(folder), "--out", str(folder / "other.jsonl"), "--effort", "5")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--effort: is of figures and of what is drawn", done.stderr)

    def test_a_list_has_one_effort_for_the_pairs_that_use_it(self):
        folder = pathlib.Path(self.folder.name)
        (folder / "signed.jsonl").write_text('{"id": "plain", "a": "a.obj", "b": "b.obj"}\n{"id": "sided", "a": "a.obj", "b": "b.obj", "signed": true}\n')
        results = folder / "signed_results.jsonl"
        done = self.run_program("batch", str(folder / "signed.jsonl"), "--out", str(results), "--effort", "100")
        self.assertIn(done.returncode, (0, 3), done.stderr)
        lines = [json.loads(line) for line in results.read_text().splitlines()]
        surveys = [line["directions"][0]["survey"] for line in lines if "survey" in line["directions"][0]]
        self.assertEqual([survey["effort"] for survey in surveys], [100])


if __name__ == "__main__":
    unittest.main()
