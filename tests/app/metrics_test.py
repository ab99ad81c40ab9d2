"""`metrics` and `batch --metrics`: figures in the table, in JSON, in lines and in CSV, codes, and what is refused.

usage: metrics_test.py PROGRAM
That figures are true, and as narrow alone as among all: tests/solve/metrics_test.cpp. One pair of squares shows here that each figure stands by its name.
"""

import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
SQUARE = "v 0 0 {z}\nv 1 0 {z}\nv 1 1 {z}\nv 0 1 {z}\nf 1 2 3\nf 1 3 4\n"
LENGTHS = {"hausdorff": 0.25, "hd_p": 0.25, "hd_p_pooled": 0.25, "masd": 0.25, "assd": 0.25, "rms": 0.25,
           "chamfer_l1": 0.5, "chamfer_l2": 0.125}
SHARES = ("nsd", "precision", "recall", "f1")


class Metrics(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        for name, z in (("a", 0), ("b", 0.25)):
            (cls.folder / f"{name}.obj").write_text(SQUARE.format(z=z))
        (cls.folder / "line.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")

    def run_program(self, *words, code=0):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def check_lifted(self, metrics, unit, percentile):
        """The figures of two squares at a distance of 0.25."""
        self.assertEqual((metrics["percentile"], metrics["met"]), (percentile, True))
        for name, truth in LENGTHS.items():
            figure = metrics[name]
            self.assertTrue(figure["lower"] <= truth * (1 + 1e-12) and truth * (1 - 1e-12) <= figure["upper"], name)
            self.assertLessEqual(figure["upper"] - figure["lower"], 0.05 * truth, name)
            self.assertTrue(figure["lower"] <= figure["estimate"] <= figure["upper"])
            self.assertEqual(figure["unit"], unit and unit + ("^2" if name == "chamfer_l2" else ""))
        for at, share in zip(metrics["within"], (0, 1), strict=True):
            for name in SHARES:
                self.assertEqual((at[name]["lower"], at[name]["upper"], at[name]["unit"]), (share, share, None))

    def test_json(self):
        answer = json.loads(self.run_program("metrics", "a.obj", "b.obj", "--bands", "0.2abs,30%", "--json", "--unit", "mm").stdout)
        self.check_lifted(answer["metrics"], "mm", 95)
        self.assertEqual((answer["command"], len(answer["directions"])), ("metrics", 2))
        self.assertEqual(answer["interval"]["upper"], answer["metrics"]["hausdorff"]["upper"])

    def test_table(self):
        text = self.run_program("metrics", "a.obj", "b.obj", "--percentile", "90", "--bands", "0.2abs,1abs", "--unit", "mm").stdout
        first, *rows = text.splitlines()
        self.assertRegex(first, r"^hausdorff 0\.2\d* mm, hd90 0\.2\d* mm, assd 0\.2\d* mm, chamfer_l1 0\.[45]\d* mm, "
                                r"f1 0 % within 0\.2 mm, f1 100 % within 1 mm")
        for row in (r"  hd90_pooled  0\.2\d*", r"  chamfer_l2   0\.1\d*, in \[0\.1\d*, 0\.1\d*\] mm\^2", r"  recall       100 % within 1 mm"):
            self.assertTrue(any(re.match(row, line) for line in rows), f"{row}\n{text}")

    def test_a_percentile_below_one_has_its_sign(self):
        text = self.run_program("metrics", "a.obj", "b.obj", "--percentile", "0.95%").stdout
        self.assertIn("hd0.95", text.splitlines()[0])

    def test_figures_that_are_asked_for_decide_the_code(self):
        words = ("metrics", "a.obj", "b.obj", "--bands", "0.2abs,0.25abs", "--effort", "2000")
        self.run_program(*words, code=3)  # so much lies at 0.25
        answer = json.loads(self.run_program(*words, "--figures", "hd95,assd", "--json").stdout)
        metrics = answer["metrics"]
        self.assertEqual((metrics["figures"], metrics["met"]), (["hd_p", "assd"], True))
        self.assertLessEqual(answer["directions"][0]["counts"]["waves"], 1)
        self.assertTrue(metrics["hausdorff"]["lower"] <= 0.25 <= metrics["hausdorff"]["upper"])
        text = self.run_program(*words, "--figures", "hd95,assd").stdout
        self.assertRegex(text.splitlines()[0], r"^hd95 0\.2\d*, assd 0\.2\d*(?:\. |$)")
        self.assertNotIn("chamfer", text)

    def test_normals(self):
        (self.folder / "wall.obj").write_text("v 0 0 -1\nv 0 1 -1\nv 0 1 1\nv 0 0 1\nf 1 2 3\nf 1 3 4\n")
        words = ("--bands", "0.3abs", "--normals", "20deg")
        metrics = json.loads(self.run_program("metrics", "a.obj", "b.obj", *words, "--json").stdout)["metrics"]
        self.assertEqual((metrics["normals"], metrics["met"]), (20, True))
        self.assertTrue(0.99 < metrics["normal_consistency"]["lower"] <= 1 <= metrics["normal_consistency"]["upper"])
        self.assertEqual(metrics["within"][0]["f1_normals"]["lower"], 1)
        metrics = json.loads(self.run_program("metrics", "a.obj", "wall.obj", *words, "--json", "--figures", "f1_normals").stdout)["metrics"]
        self.assertLess(metrics["normal_consistency"]["upper"], 5e-6)  # floats
        self.assertEqual(metrics["within"][0]["f1_normals"]["upper"], 0)
        text = self.run_program("metrics", "a.obj", "b.obj", *words).stdout
        self.assertRegex(text, r"(?m)^  f1_normals +100 % within 0\.3 and 20 degrees$")
        plain = json.loads(self.run_program("metrics", "a.obj", "b.obj", "--bands", "0.3abs", "--json").stdout)["metrics"]
        self.assertNotIn("normal_consistency", plain)
        self.assertNotIn("f1_normals", plain["within"][0])

    def test_a_jump_is_told(self):
        done = self.run_program("metrics", "a.obj", "b.obj", "--bands", "0.25abs", "--effort", "2000", code=3)
        self.assertIn("not all are as narrow as asked", done.stdout.splitlines()[0])
        self.assertIn("a jump of the distribution", done.stdout)

    def test_without_time_all_is_true(self):
        answer = json.loads(self.run_program("metrics", "a.obj", "b.obj", "--time", "1ms", "--json", code=3).stdout)
        self.assertFalse(answer["metrics"]["met"])
        self.assertEqual(answer["metrics"]["assd"]["lower"], 0)

    def test_refusals(self):
        for words, code, said in ((("a.obj", "line.obj"), 4, "without area"), (("line.obj", "a.obj"), 4, "without area"),
                                  (("a.obj", "b.obj", "--percentile", "0"), 2, "--percentile '0': expected a percentile"),
                                  (("a.obj", "b.obj", "--percentile", "101"), 2, "above 0 and at most 100"),
                                  (("a.obj", "b.obj", "--percentile", "0.95"), 2, "--percentile 0.95: could be 95 or 0.95%: write one of them"),
                                  (("a.obj", "b.obj", "--bands", "0.5"), 2, "--bands"), (("a.obj", "b.obj", "--max", "1abs"), 2, "--max"),
                                  (("a.obj", "b.obj", "--polygons", "any"), 2, "--polygons any"),
                                  (("a.obj", "b.obj", "--figures", "hd90"), 2, "--figures 'hd90': expected names of hausdorff, hd_p"),
                                  (("a.obj", "b.obj", "--figures", "f1"), 2, "--figures f1: give its distances by --bands"),
                                  (("a.obj", "b.obj", "--figures", "normal_consistency"), 2, "give the angle by --normals"),
                                  (("a.obj", "b.obj", "--normals", "91"), 2, "--normals '91': expected an angle above 0 and at most 90 degrees")):
            with self.subTest(words):
                self.assertIn(said, self.run_program("metrics", *words, code=code).stderr)
        for words, said in ((("--max", "1abs", "--metrics"), "leave out --max"), (("--bands", "1abs"), "are of --metrics"), (("--percentile", "90"), "are of --metrics")):
            with self.subTest(words):
                self.assertIn(said, self.run_program("batch", "--against", "b.obj", "a.obj", "--out", "none.jsonl", *words, code=2).stderr)

    def batch(self, name, *words, code=0):
        return self.run_program("batch", f"{name}.csv", "--out", f"{name}.jsonl", "--csv", f"{name}_out.csv", *words, code=code)

    def test_batch(self):
        (self.folder / "list.csv").write_text("id,a,b\nlifted,a.obj,b.obj\nsame,a.obj,a.obj\n")
        said = self.batch("list", "--metrics", "--bands", "0.2abs,1abs").stdout
        self.assertEqual(said.splitlines()[0], "2 of 2 pairs have all figures as narrow as asked")
        lines = {line["id"]: line for line in map(json.loads, (self.folder / "list.jsonl").read_text().splitlines())}
        self.check_lifted(lines["lifted"]["metrics"], None, 95)
        self.assertEqual({lines["same"]["metrics"][name]["upper"] for name in LENGTHS}, {0})
        with open(self.folder / "list_out.csv", newline="") as text:
            rows = {row["id"]: row for row in csv.DictReader(text, strict=True)}
        for name, line in lines.items():
            for figure in LENGTHS:
                for end in ("lower", "upper"):
                    self.assertEqual(float(rows[name][f"{figure}_{end}"]), line["metrics"][figure][end])
                self.assertEqual(float(rows[name][figure]), line["metrics"][figure]["estimate"])
            for i, at in enumerate(line["metrics"]["within"], 1):
                self.assertEqual(float(rows[name][f"within_{i}"]), at["distance"])
                self.assertEqual(float(rows[name][f"f1_{i}_upper"]), at["f1"]["upper"])
        before = (self.folder / "list.jsonl").read_bytes()
        self.batch("list", "--metrics", "--bands", "0.2abs,1abs", "--resume")
        self.assertEqual((self.folder / "list.jsonl").read_bytes(), before, "nothing was left to do")
        for more in (("--percentile", "90", "--bands", "0.2abs,1abs"), ("--bands", "0.2abs")):
            self.batch("list", "--metrics", *more, "--resume")
            now = (self.folder / "list.jsonl").read_bytes()
            self.assertGreater(len(now), len(before), "another question has another key")
            before = now

    def test_a_batch_has_normals_in_its_columns(self):
        (self.folder / "turned.csv").write_text("id,a,b\nlifted,a.obj,b.obj\n")
        self.batch("turned", "--metrics", "--bands", "0.3abs", "--normals", "20")
        with open(self.folder / "turned_out.csv", newline="") as text:
            row = next(csv.DictReader(text, strict=True))
        self.assertEqual(float(row["f1_normals_1"]), 1)
        self.assertLessEqual(0.99, float(row["normal_consistency_lower"]))
        line = json.loads((self.folder / "turned.jsonl").read_text())
        self.assertEqual(line["metrics"]["normals"], 20)
        before = (self.folder / "turned.jsonl").read_bytes()
        self.batch("turned", "--metrics", "--bands", "0.3abs", "--normals", "30", "--resume")
        self.assertGreater(len((self.folder / "turned.jsonl").read_bytes()), len(before), "another angle has another key")

    def test_a_batch_tells_what_is_wider(self):
        (self.folder / "jump.csv").write_text("id,a,b\njump,a.obj,b.obj\n")
        said = self.batch("jump", "--metrics", "--bands", "0.25abs", "--effort", "2000", code=3).stdout
        self.assertEqual(said.splitlines()[0], "0 of 1 pairs have all figures as narrow as asked; 1 with a figure that is wider")
        self.assertIn("WIDER THAN ASKED  [", said)
        said = self.batch("jump", "--metrics", "--bands", "0.25abs", "--effort", "2000", "--figures", "hd95", "--resume").stdout
        self.assertEqual(said.splitlines()[0], "1 of 1 pairs have all figures as narrow as asked")

    def test_rows_that_contradict_metrics(self):
        (self.folder / "odd.csv").write_text("id,a,b,max,symmetric\nlimit,a.obj,b.obj,1abs,\none way,a.obj,b.obj,,false\nline,a.obj,line.obj,,\n")
        self.batch("odd", "--metrics", code=4)
        lines = {line["id"]: line for line in map(json.loads, (self.folder / "odd.jsonl").read_text().splitlines())}
        self.assertEqual({name: line["code"] for name, line in lines.items()}, {"limit": 2, "one way": 2, "line": 4})


if __name__ == "__main__":
    unittest.main()
