"""batch and merge as newcomers type them: lists of spreadsheets, outputs in the wrong place, shards.

usage: many_pairs_test.py PROGRAM
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
SQUARE = "v 0 0 {z}\nv 1 0 {z}\nv 1 1 {z}\nv 0 1 {z}\nf 1 2 3\nf 1 3 4\n"
MESHES = 12


class ManyPairs(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for i in range(MESHES):
            (self.folder / f"{i}.obj").write_text(SQUARE.format(z=i / 8))

    def run_program(self, *words, code=0):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, timeout=120)
        self.assertEqual(done.returncode, code, (words, done.stderr))
        return done.stderr.decode(errors="replace")

    def results(self, name):
        return {line["id"]: line for line in map(json.loads, (self.folder / name).read_text().splitlines())}

    def write_list(self, name="list.csv", pairs=MESHES):
        (self.folder / name).write_text("id,a,b\n" + "".join(f"{i},{i}.obj,{(5 * i + 1) % MESHES}.obj\n" for i in range(pairs)))
        return name

    def test_lists_of_spreadsheets(self):
        for text in (b"\xef\xbb\xbfid,a,b,symmetric\r\nx,0.obj,1.obj,TRUE\r\n", b'\xef\xbb\xbf"id","a","b","symmetric"\n"x","0.obj","1.obj","yes"',
                     b'symmetric,b,a,id\n1,1.obj,0.obj,x\n\n', b"\xef\xbb\xbfid;a;b;symmetric\r\nx;0.obj;1.obj;TRUE\r\n"):
            with self.subTest(text):
                (self.folder / "list.CSV").write_bytes(text)
                self.run_program("batch", "list.CSV", "--out", "out.jsonl")
                line = self.results("out.jsonl")["x"]
                self.assertEqual(([side["path"] for side in line["inputs"]], line["options"]["symmetric"]), (["0.obj", "1.obj"], True))
                (self.folder / "out.jsonl").unlink()

    def test_what_is_wrong_with_a_list_is_said(self):
        for text, said in ((b"", "line 1: no pair"), (b"x,0.obj,1.obj\n", "line 1: no column 'id'"), (b"id;a\nx;0.obj\n", "line 1: no column 'b'; expected a heading with id, a, b and perhaps max, tol, symmetric, "),
                           (b"id;a;b;max\nx;0.obj;1.obj;0,1mm\n", "line 2: max '0,1mm': did you mean 0.1mm?"),
                           (b"id,a\nx,0.obj\n", "line 1: no column 'b'"), (b"id,a,a,b\n", "line 1: more than one column 'a'"), (b"id,a,b\n,0.obj,1.obj\n", "line 2: no id;"),
                           (b"id,a,b\nx,0.obj\n", "line 2: 2 cells; expected 3"), (b'id,a,b\nx,0.obj,"1.obj\n', "line 2: a quote does not end"),
                           (b"id,a,b\nx,0.obj,1.obj\nx,1.obj,2.obj\n", "line 3: the id 'x' is that of line 2"), (b"id,a,b\n\xe9,0.obj,1.obj\n", "line 2: the id"),
                           (b"id,a,b,symmetric\nx,0.obj,1.obj,perhaps\n", "line 2: 'perhaps': expected true or false")):
            with self.subTest(text):
                (self.folder / "list.csv").write_bytes(text)
                self.assertIn("list.csv: " + said, self.run_program("batch", "list.csv", "--out", "out.jsonl", code=4))
                self.assertFalse((self.folder / "out.jsonl").exists())

    def test_outputs_in_the_wrong_place(self):
        self.write_list()
        (self.folder / "one.jsonl").write_text('{"id": "x", "a": "0.obj", "b": "1.obj"}')  # which adding lines would cut off
        before = {path: path.read_bytes() for path in self.folder.iterdir()}
        for words in (("--out", "0.obj"), ("--out", "-"), ("--out", "list.csv"), ("--out", "./list.csv", "--resume"), ("--out", "."), ("--out", "none/out.jsonl"),
                      ("--out", "/dev/null"), ("--out", "out.jsonl", "--csv", "./out.jsonl"), ("--out", "out.jsonl", "--csv", "t", "--junit", "./t"),
                      ("--out", "out.jsonl", "--csv", "0.obj"), ("--out", "out.jsonl", "--junit", "list.csv")):
            with self.subTest(words):
                self.run_program("batch", "list.csv", *words, code=2)
        self.run_program("batch", "one.jsonl", "--out", "one.jsonl", "--resume", code=2)
        self.assertEqual({path: path.read_bytes() for path in self.folder.iterdir()}, before)

    def test_a_value_that_is_empty_is_refused(self):
        """The option of a script whose variable is not set: the program would do less than the script
        asks."""
        self.write_list()
        self.run_program("batch", "list.csv", "--out", "done.jsonl")
        before = {path: path.read_bytes() for path in self.folder.iterdir()}
        for option in ("--csv", "--junit", "--max", "--tol", "--shard", "--against", "--unit", "--time", "--image-dir"):
            for words in ((option, ""), (option + "=",)):
                with self.subTest(words):
                    said = self.run_program("batch", "list.csv", "--out", "out.jsonl", *words, code=2)
                    self.assertIn(option, said)
        for option in ("--csv", "--junit", "--list"):
            with self.subTest(option):
                self.assertIn(option, self.run_program("merge", "done.jsonl", "--out", "all.jsonl", option, "", code=2))
        self.assertEqual({path: path.read_bytes() for path in self.folder.iterdir()}, before)

    def test_pipes(self):
        """A list may come from a pipe, whose folder is not the files' one; results may not, since they are read twice."""
        (self.folder / "sub").mkdir()
        pipe = self.folder / "sub/pipe"
        os.mkfifo(pipe)
        writer = threading.Thread(target=pipe.write_text, args=('{"id": "x", "a": "0.obj", "b": "1.obj"}\n',), daemon=True)
        writer.start()
        self.run_program("batch", "sub/pipe", "--out", "out.jsonl")
        writer.join(timeout=60)
        self.assertEqual(list(self.results("out.jsonl")), ["x"])
        self.assertIn("sub/pipe: is no file", self.run_program("merge", "sub/pipe", "--out", "all.jsonl", code=4))
        self.assertIn("sub: is no file", self.run_program("merge", "sub", "--out", "all.jsonl", code=4))

    def github(self, *words, code):
        summary = self.folder / "summary.md"
        summary.write_text("before\n")
        done = subprocess.run([PROGRAM, "batch", *words, "--github"], cwd=self.folder, capture_output=True, text=True, timeout=120,
                              env={**os.environ, "GITHUB_STEP_SUMMARY": str(summary)})
        self.assertEqual(done.returncode, code, (words, done.stderr))
        return [line for line in done.stdout.splitlines() if line.startswith("::")], summary.read_text()

    def test_annotations_for_github(self):
        (self.folder / "lists").mkdir()
        (self.folder / "bad.obj").write_text("v 0 0 zero\n")
        (self.folder / "far.obj").write_text("v 9 0 0\nv 10 0 0\nv 9 1 0\nf 1 2 3\n")
        rows = ["pass,../0.obj,../1.obj,1abs", "barely,../0.obj,../2.obj,0.2abs", "far | 100%,../far.obj,../0.obj,1abs", "no B,../0.obj,../gone.obj,1abs",
                "bad A,../bad.obj,../0.obj,1abs", "open,../0.obj,../3.obj,0.375abs"]
        (self.folder / "lists/list.csv").write_text("id,a,b,max\n" + "\n".join(rows))
        lines, summary = self.github("lists/list.csv", "--out", "out.jsonl", "--tol", "1e-3", code=4)
        self.assertEqual(lines[0], "::notice title=vkhausdorff batch::FAIL  1 of 6 pairs are within their limit, 2 are beyond it, proven; 1 undecided; 2 without an answer")
        heads = [line.split("::")[1] for line in lines[1:]]
        self.assertEqual(heads, ["error file=far.obj,title=vkhausdorff batch%3A far | 100%25", "error file=0.obj,title=vkhausdorff batch%3A barely",
                                 "error file=bad.obj,title=vkhausdorff batch%3A bad A", "error file=gone.obj,title=vkhausdorff batch%3A no B",
                                 "warning file=0.obj,title=vkhausdorff batch%3A open", "notice file=0.obj,title=vkhausdorff batch%3A pass"])
        self.assertRegex(lines[1], r"::FAIL  at least .*%0Aapart: ", "its notes are there")
        self.assertIn("../bad.obj: line 1", lines[3])
        self.assertTrue(summary.startswith("before\n### :x: vkhausdorff batch\n\n`FAIL  1 of 6 pairs"), summary)
        table = [line.split(" | ")[1] for line in summary.splitlines() if line.startswith("| :")]
        self.assertEqual(table, ["`far \\| 100%`", "`barely`", "`bad A`", "`no B`", "`open`", "`pass`"])

    def test_github_hears_of_a_batch_that_passes_or_cannot_begin(self):
        (self.folder / "list.csv").write_text("id,a,b,max\nx,0.obj,0.obj,1abs\n")
        lines, summary = self.github("list.csv", "--out", "out.jsonl", code=0)
        self.assertEqual(lines, ["::notice title=vkhausdorff batch::PASS  1 of 1 pairs are within their limit, 0 are beyond it, proven"])
        self.assertIn("### :white_check_mark:", summary)
        (self.folder / "list.csv").write_text("id,a\n")
        lines, summary = self.github("list.csv", "--out", "other.jsonl", code=4)
        self.assertEqual([line[:34] for line in lines], ["::error file=list.csv,title=vkhaus"])
        self.assertEqual(summary, "before\n")
        lines, _ = self.github("list.csv", "--out", "other.jsonl", "--max", "1,5mm", code=2)
        self.assertEqual([line[:33] for line in lines], ["::error title=vkhausdorff::--max "])
        lines, _ = self.github("list.csv", code=2)
        self.assertEqual(lines, ["::error title=vkhausdorff::--out is required (see vkhausdorff batch --help-all)"])

    def test_shards_are_the_whole(self):
        self.write_list()
        self.run_program("batch", "list.csv", "--out", "whole.jsonl")
        self.run_program("merge", "whole.jsonl", "--out", "whole", "--reproducible")
        shards = [f"shard-{i}.jsonl" for i in range(3)]
        for i, shard in enumerate(shards):
            self.run_program("batch", "list.csv", "--shard", f"{i}/3", "--out", shard)
        missing = self.run_program("merge", *shards[1:], "--list", "list.csv", "--out", "some", code=3)
        self.assertEqual({line.split(": ")[-1] for line in missing.splitlines()}, set(self.results(shards[0])))
        self.run_program("merge", *reversed(shards), "--list", "list.csv", "--out", "merged", "--reproducible")
        self.assertEqual((self.folder / "merged").read_bytes(), (self.folder / "whole").read_bytes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
