"""batch FOLDER_A FOLDER_B: meshes are paired by their names, and what has no partner is told.

usage: folder_pairs_test.py PROGRAM
"""

import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
OBJ = "v 0 0 {z}\nv 1 0 {z}\nv 0 1 {z}\nf 1 2 3\n"
OFF = "OFF\n3 1 0\n0 0 {z}\n1 0 {z}\n0 1 {z}\n3 0 1 2\n"


def said(done):
    """Lists the lines of stderr but those of progress, which a job writes each ten seconds where there is no terminal."""
    return [line for line in done.stderr.splitlines() if not re.match(r"\d+/\d+ ", line)]


class FolderPairs(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for name in "ab":
            (self.folder / name).mkdir()

    def write(self, name, z=0.0):
        path = self.folder / name
        path.write_text((OFF if path.suffix.lower() == ".off" else OBJ).format(z=z))

    def batch(self, *words, code=0, folders=("a", "b")):
        done = subprocess.run([PROGRAM, "batch", *folders, *words], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, code, (words, done.stdout, done.stderr))
        return done

    def results(self, name="out.jsonl"):
        return {line["id"]: line for line in map(json.loads, (self.folder / name).read_text().splitlines())}

    def write_three(self):
        for i, name in enumerate(("one", "two.v1", "Three")):
            self.write(f"a/{name}.obj")
            self.write(f"b/{name}.OFF", (i + 1) / 8)

    def test_the_same_answers_as_a_list(self):
        self.write_three()
        done = self.batch("--out", "out.jsonl", "--max", "0.3abs", code=1)
        self.assertEqual(said(done), [])
        self.assertIn("2 of 3 pairs are within their limit, 1 are beyond it", done.stdout)
        (self.folder / "list.csv").write_text("id,a,b\n" + "".join(f"{n},a/{n}.obj,b/{n}.OFF\n" for n in ("one", "two.v1", "Three")))
        self.batch("--out", "listed.jsonl", "--max", "0.3abs", code=1, folders=("list.csv",))
        both = [self.results(name) for name in ("out.jsonl", "listed.jsonl")]
        self.assertEqual(set(both[0]), {"one", "two.v1", "Three"})
        for name, line in both[0].items():
            line.pop("run"), both[1][name].pop("run")
            self.assertEqual(line, both[1][name])

    def test_going_on_and_shards(self):
        self.write_three()
        self.batch("--out", "out.jsonl")
        before = (self.folder / "out.jsonl").read_bytes()
        self.batch("--out", "out.jsonl", "--resume")
        self.assertEqual((self.folder / "out.jsonl").read_bytes(), before)
        self.write("b/one.OFF", 7)
        self.batch("--out", "out.jsonl", "--resume")
        self.assertEqual((self.folder / "out.jsonl").read_text().count("\n"), 4)
        self.write("a/alone.obj")
        named = []
        for i in range(3):
            done = subprocess.run([PROGRAM, "batch", "a", "b", "--out", f"{i}.jsonl", "--shard", f"{i}/3"], cwd=self.folder, capture_output=True, text=True, timeout=120)
            named.append((done.stderr.count("a/alone.obj: no partner in b"), done.returncode))
        self.assertEqual(sorted(named), [(0, 0), (0, 0), (1, 4)])
        self.assertEqual(sorted(sum((list(self.results(f"{i}.jsonl")) for i in range(3)), [])), ["Three", "alone", "one", "two.v1"])

    def test_what_has_no_partner_is_told_and_fails_the_job(self):
        self.write_three()
        self.write("a/only_a.obj")
        self.write("b/ONE.obj")  # another name than one's
        done = self.batch("--out", "out.jsonl", "--max", "9abs", "--csv", "out.csv", "--junit", "out.xml", "--report-dir", "d", code=4)
        self.assertEqual(said(done),
                         ["vkhausdorff: warning: a/only_a.obj: no partner in b; expected a mesh named only_a there",
                          "vkhausdorff: warning: b/ONE.obj: no partner in a; expected a mesh named ONE there"])
        self.assertTrue(done.stdout.startswith("UNDECIDED  3 of 5 pairs are within their limit, 0 are beyond it, proven; 2 without a partner\n"), done.stdout)
        results = self.results()
        self.assertEqual({name: line["code"] for name, line in results.items()}, {"one": 0, "two.v1": 0, "Three": 0, "only_a": 4, "ONE": 4})
        self.assertEqual(results["ONE"]["error"]["file"], "b/ONE.obj")
        with (self.folder / "out.csv").open(newline="") as table:
            rows = {row["id"]: row for row in csv.DictReader(table)}
        self.assertEqual((rows["only_a"]["a"], rows["only_a"]["b"], rows["only_a"]["code"]), ("a/only_a.obj", "", "4"))
        self.assertIn('errors="2"', (self.folder / "out.xml").read_text())
        self.assertIn("2 without a partner", (self.folder / "d/index.html").read_text())
        # A partner that comes later is measured.
        self.write("b/only_a.obj")
        self.batch("--out", "out.jsonl", "--max", "9abs", "--resume", code=4)
        self.assertEqual(self.results()["only_a"]["verdict"], "pass")

    def test_it_may_be_allowed(self):
        self.write_three()
        self.write("a/only_a.obj")
        done = self.batch("--out", "out.jsonl", "--max", "9abs", "--allow-unpaired")
        self.assertIn("warning: a/only_a.obj: no partner", done.stderr)
        self.assertTrue(done.stdout.startswith("PASS  3 of 3 pairs are within their limit, 0 are beyond it, proven; 1 without a partner\n"), done.stdout)
        self.assertEqual(set(self.results()), {"one", "two.v1", "Three"})

    def test_other_files_are_left_out(self):
        self.write_three()
        (self.folder / "a/sub").mkdir()
        self.write("a/sub/four.obj")
        (self.folder / "a/.hidden.obj").write_text("")
        for name in ("five.step", "one.mtl"):
            (self.folder / "a" / name).write_text("")
        done = self.batch("--out", "out.jsonl")
        self.assertEqual(said(done), ["vkhausdorff: note: a: left out, since no name of a mesh: five.step, one.mtl, sub/"])

    def test_what_is_refused(self):
        self.write("a/one.obj")
        self.write("b/two.obj")
        self.assertIn("a and b: no pair; expected meshes with the same names", self.batch("--out", "out.jsonl", code=4).stderr)
        self.write("b/one.off")
        self.write("b/one.obj")
        self.assertIn("b/one.off: has the stem of b/one.obj; expected one mesh of each stem", self.batch("--out", "out.jsonl", code=4).stderr)
        (self.folder / "b/one.off").unlink()
        for folders, words, said in ((("a", "none"), [], "'none' is no folder"), (("a/one.obj", "b/one.obj"), [], "'a/one.obj' is no folder"), (("a", "a/."), [], "are one folder"),
                                     (("a",), [], "'a' is a folder: expected a list"), (("a", "b", "a"), [], "expected one LIST, two folders"),
                                     (("a/one.obj", "a/one.obj"), ["--against", "b/one.obj", "--allow-unpaired"], "is of two folders"), (("a", "b"), ["--out", "b/one.obj"], "would overwrite")):
            with self.subTest(folders):
                self.assertIn(said, self.batch(*(words if "--out" in words else ["--out", "out.jsonl", *words]), code=2, folders=folders).stderr)
        self.assertFalse((self.folder / "out.jsonl").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
