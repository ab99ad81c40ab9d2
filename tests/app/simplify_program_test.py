"""vkhausdorff simplify: what is written passes gate in a process of its own, and vkh_check takes its
certificate; nothing is written where nothing was found; --json fits docs/schema/simplify.schema.json.

usage: simplify_program_test.py PROGRAM SOURCE [VKH_CHECK]
What is found of any mesh, and how few faces it has: tests/solve/simplify_test.cpp.
"""

import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

try:
    import jsonschema
except ImportError:
    jsonschema = None

PROGRAM, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
CHECK = pathlib.Path(sys.argv[3]).resolve() if len(sys.argv) > 3 else None
STEPS = 20  # coordinates that no float32 has


def bump(x, y):
    return 0.1 * math.sin(5 * x) * math.cos(4 * y)


def wavy(offset=0.0):
    """A wavy sheet of 800 faces as OBJ."""
    rows = [f"v {offset + i / STEPS!r} {j / STEPS!r} {bump(i / STEPS, j / STEPS)!r}" for i in range(STEPS + 1) for j in range(STEPS + 1)]
    for i in range(STEPS):
        for j in range(STEPS):
            a = i * (STEPS + 1) + j + 1
            c = a + STEPS + 1
            rows += [f"f {a} {c} {a + 1}", f"f {a + 1} {c} {c + 1}"]
    return "\n".join(rows) + "\n"


class Simplify(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "a.obj").write_text(wavy())

    def run_program(self, *words, code=0):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def check_gate(self, a, b, limit, *more):
        self.assertTrue(self.run_program("gate", a, b, "--max", limit, *more).stdout.startswith("PASS"))

    def test_each_format_passes_gate_as_written(self):
        for name in ("b.ply", "b.obj", "b.stl", "b.glb"):
            with self.subTest(name):
                first, *rest = self.run_program("simplify", "a.obj", "--max", "0.01abs", "--out", name).stdout.splitlines()
                found = re.fullmatch(r"(\d+) of 800 faces, proven within 0\.01 of A, both ways "
                                     r"\(largest deviation (0\.00\d+)\)", first)
                self.assertTrue(found, first)
                self.assertLess(int(found[1]), 500)
                self.assertTrue(any("UVs, normals and colours" in row for row in rest))
                self.check_gate("a.obj", name, "0.01abs", "--symmetric")
        self.assertEqual(self.files(), ["a.obj", "b.glb", "b.obj", "b.ply", "b.stl"])

    def test_one_way_and_borders(self):
        text = self.run_program("simplify", "a.obj", "--max", "1%", "--out", "b.ply", "--one-way", "--lock-borders").stdout
        self.assertIn("proven within 1 % of A's diagonal, A to it alone", text)
        self.check_gate("a.obj", "b.ply", "1%")

    def test_doubles_stay_doubles_and_floats_are_judged_as_floats(self):
        (self.folder / "far.obj").write_text(wavy(1e6))  # a float32 there is a multiple of 1/16
        self.run_program("simplify", "far.obj", "--max", "0.004abs", "--out", "far.ply")
        self.check_gate("far.obj", "far.ply", "0.004abs", "--symmetric")
        done = self.run_program("simplify", "far.obj", "--max", "0.004abs", "--out", "far.stl", code=3)
        self.assertIn("nothing written: no mesh within 0.004 of A was found", done.stdout)
        self.assertEqual(self.files(), ["a.obj", "far.obj", "far.ply"])

    def test_a_certificate_is_of_the_file_as_written(self):
        self.run_program("simplify", "a.obj", "--max", "0.01abs", "--out", "b.stl", "--certificate", "b.vhc")
        data = (self.folder / "b.stl").read_bytes()
        self.assertEqual(len(data), 84 + 50 * struct.unpack("<I", data[80:84])[0])
        if CHECK is None:
            self.skipTest("no vkh_check")
        done = subprocess.run([CHECK, "b.vhc", "a.obj", "b.stl"], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_levels_are_a_chain(self):
        words = ["simplify", "a.obj", "--max", "0.05abs", "--out", "l.ply", "--levels", "3", "--ratio", "0.4", "--json"]
        answer = json.loads(self.run_program(*words).stdout)
        self.assertEqual([file["path"] for file in answer["files"]], ["l-1.ply", "l-2.ply", "l-3.ply"])
        faces = [800, *[file["faces"] for file in answer["files"]]]
        for finer, coarser in zip(faces, faces[1:]):
            self.assertLessEqual(coarser, 0.4 * finer + 1)
        for file in answer["files"]:
            self.check_gate("a.obj", file["path"], f"{file['upper'] * (1 + 1e-4) + 1e-6!r}abs", "--symmetric")

    def test_a_chain_says_why_it_is_short_and_leaves_no_level_of_another(self):
        words = ["simplify", "a.obj", "--out", "l.ply", "--ratio", "0.4"]
        whole = json.loads(self.run_program(*words, "--max", "0.05abs", "--levels", "3", "--json").stdout)
        self.assertRegex(whole["words"], r"^3 levels, \d+ to \d+ of 800 faces, proven within 0\.05 of A, both ways$")
        files = {path.name: path.read_bytes() for path in self.folder.iterdir()}
        said = self.run_program(*words, "--max", "0.05abs", "--levels", "2", code=2).stderr
        self.assertIn("--levels 2: 'l-3.ply' is a further level of another chain", said)
        self.assertEqual({path.name: path.read_bytes() for path in self.folder.iterdir()}, files)
        limit = f"{math.sqrt(whole['files'][0]['upper'] * whole['files'][1]['lower'])!r}abs"
        first, *rows = self.run_program(*words, "--max", limit, "--levels", "3", "--json=l.json").stdout.splitlines()
        self.assertRegex(first, r"^1 of 3 levels, .*; level 2 is beyond the limit$")
        self.assertEqual([row.split()[1] for row in rows if row.startswith("  removed")], ["l-2.ply:", "l-3.ply:"])
        self.assertEqual(json.loads((self.folder / "l.json").read_text())["removed"], ["l-2.ply", "l-3.ply"])
        self.assertEqual(self.files(), ["a.obj", "l-1.ply", "l.json"])
        self.assertEqual(json.loads(self.run_program(*words, "--max", limit, "--levels", "3", "--json").stdout)["removed"], [])

    def test_nothing_found_removes_nothing(self):
        (self.folder / "l-1.ply").write_text("of another")
        self.run_program("simplify", "a.obj", "--out", "l.ply", "--levels", "3", "--max", "1e-9abs", code=3)
        self.assertEqual((self.folder / "l-1.ply").read_text(), "of another")

    def test_without_time_nothing_is_written(self):
        for more in ([], ["--levels", "2"]):
            done = self.run_program("simplify", "a.obj", "--max", "1%", "--out", "b.ply", "--time", "1e-9s", *more, code=3)
            self.assertEqual(self.files(), ["a.obj"], done.stdout)

    def test_misuse(self):
        for words, named in [(["--max", "0", "--out", "b.ply"], "--max"),
                             (["--max", "+1abs,-1abs", "--out", "b.ply"], "expected one length"),
                             (["--max", "1mm", "--out", "b.ply"], "--max"),
                             (["--max", "1%", "--out", "b.off"], ".ply, .obj, .stl or .glb"),
                             (["--max", "1%", "--out", "a.obj"], "would overwrite"),
                             (["--max", "1mm", "--unit", "mm", "--out", "b.glb"], "glTF is in metres"),
                             (["--max", "1%", "--out", "b.ply", "--ratio", "0.5"], "--levels"),
                             (["--max", "1%", "--out", "b.ply", "--levels", "2", "--certificate", "b.vhc"], "--levels"),
                             (["--max", "1%", "--out", "b.ply", "--json=b.ply"], "two outputs"),
                             (["--max", "1%", "--out", "b.ply", "--certificate", "b.txt"], ".vhc")]:
            with self.subTest(words):
                self.assertIn(named, self.run_program("simplify", "a.obj", *words, code=2).stderr)
        self.assertEqual(self.files(), ["a.obj"])

    @unittest.skipIf(jsonschema is None, "no jsonschema")
    def test_json_fits_its_schema(self):
        schema = json.loads((SOURCE / "docs/schema/simplify.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        cases = [(["--out", "b.ply"], 0), (["--out", "b.stl", "--one-way"], 0), (["--out", "b.obj", "--levels", "2"], 0),
                 (["--out", "b.ply", "--certificate", "b.vhc"], 0), (["--out", "none.stl", "--max", "1e-9abs"], 3)]
        for words, code in cases:
            with self.subTest(words):
                limit = [] if "--max" in words else ["--max", "1%"]
                text = self.run_program("simplify", "a.obj", *limit, "--json", *words, code=code).stdout
                answer = json.loads(text)
                jsonschema.validate(answer, schema)
                self.check_bounds(json.loads(text, parse_float=Fraction))
                for file in answer["files"]:
                    self.assertEqual(float.fromhex(file["upper_hex"]), file["upper"])
                    self.assertLessEqual(file["upper"], answer["max"]["within"])
                self.assertEqual(answer["found"], code == 0)
                broken = {key: value for key, value in answer.items() if key != "files"}
                with self.assertRaises(jsonschema.ValidationError):
                    jsonschema.validate(broken, schema)

    def check_bounds(self, answer):
        """Each decimal is on the outer side of its double, in exact arithmetic."""
        for part in (answer["max"], *answer["files"], *(file[way] or {} for file in answer["files"] for way in ("a_to_b", "b_to_a"))):
            for low, high in (("lower", "upper"), ("within", "beyond")):
                if low in part:
                    self.assertLessEqual(part[low], Fraction(float.fromhex(part[f"{low}_hex"])))
                    self.assertGreaterEqual(part[high], Fraction(float.fromhex(part[f"{high}_hex"])))

    @unittest.skipIf(jsonschema is None, "no jsonschema")
    def test_an_error_is_an_object(self):
        schema = json.loads((SOURCE / "docs/schema/simplify.schema.json").read_text())
        (self.folder / "bad.obj").write_text("v 0 0 zero\n")
        limit = ["--max", "1%", "--out", "b.ply"]
        for words, code, file in ((["missing.obj", *limit], 4, "missing.obj"), (["bad.obj", *limit], 4, "bad.obj"),
                                  (["a.obj", *limit, "--device", "none such"], 5, None), (["a.obj", "--out", "b.ply"], 2, None),
                                  (["a.obj", "--max", "1%", "--out", "a.obj"], 2, None), (["a.obj", *limit, "--levls", "2"], 2, None),
                                  (["a.obj", "--max", "1mm", "--out", "b.ply"], 2, None), (["a.obj", *limit, "--time", "1e-9s"], 3, None)):
            with self.subTest(words):
                done = self.run_program("simplify", *words, "--json=out.json" if file else "--json", code=code)
                answer = json.loads((self.folder / "out.json").read_text() if file else done.stdout)
                jsonschema.validate(answer, schema)
                self.assertEqual((answer["error"]["code"], answer["error"]["file"]), (code, file))
                self.assertEqual(done.stderr, f"vkhausdorff: {answer['error']['message']}\n")
        self.assertNotIn("b.ply", self.files())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
