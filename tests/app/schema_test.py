"""The output of --json fits docs/schema/answer.schema.json, and that of --junit is JUnit's, by
readers that are not ours.

usage: schema_test.py PROGRAM SOURCE. Exit code 77: neither jsonschema nor junitparser is here.
"""

import html
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import jsonschema
except ImportError:
    jsonschema = None
try:
    import junitparser
except ImportError:
    junitparser = None

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SQUARE = "v 0 0 {z}\nv {x} 0 {z}\nv {x} 1 {z}\nv 0 1 {z}\nf 1 2 3\nf 1 3 4\n"


def run(*words, folder):
    return subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, timeout=600)


class Outputs(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for name, x, z in (("a", 1, 0), ("b", 1, 0.25), ("wide", 2, 0)):
            (self.folder / f"{name}.obj").write_text(SQUARE.format(x=x, z=z))
        (self.folder / "quad.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3 4\n")
        (self.folder / "bad.obj").write_text("v 0 0 zero\n")

    @unittest.skipIf(jsonschema is None, "no jsonschema here")
    def test_every_answer_is_of_the_schema(self):
        schema = json.loads((SOURCE / "docs/schema/answer.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        validator = jsonschema.Draft202012Validator(schema)
        for words, code in ((["distance", "a.obj", "b.obj", "--symmetric", "--verify", "--signed", "--stats", "--bands", "0.1abs,20%", "--field-tol", "1%",
                              "--effort", "2000", "--certificate", "out.vhc"], 0),
                            (["distance", "quad.obj", "b.obj", "--unit", "mm", "--tol", "0.001mm", "--device", "0,0"], 0),
                            (["distance", "a.obj", "b.obj", "--waves", "1", "--tol", "1e-9"], None),
                            (["distance", "a.obj", "b.obj", "--time", "1ms", "--stats"], 3), (["distance", "a.obj", "b.obj", "--align"], 0),
                            (["distance", "a.obj", "b.obj", "--part", "1/2", "--verify", "--known-lower", "1abs"], 0), (["demo", "--waves", "1"], 3),
                            (["gate", "a.obj", "wide.obj", "--symmetric", "--max", "0.5in", "--unit", "in", "--image", "o.png"], 1),
                            (["gate", "a.obj", "b.obj", "--max", "0.25abs"], 3), (["gate", "a.obj", "b.obj", "--max", "10%", "--worst"], 1),
                            (["gate", "a.obj", "b.obj", "--max", "0.3abs", "--area", "99%"], 0),
                            (["metrics", "a.obj", "wide.obj", "--bands", "0.1abs,20%", "--unit", "mm", "--normals", "20"], 0), (["metrics", "a.obj", "b.obj", "--time", "1ms"], 3),
                            (["gate", "a.obj", "b.obj", "--max=+0.3abs,-0.3abs", "--signed", "--stats"], 0), (["gate", "a.obj", "b.obj", "--max=+0.1abs"], 2),
                            (["gate", "a.obj", "b.obj", "--max", "1mm"], 2), (["distance", "a.obj", "b.obj", "--tll=1e-3"], 2),
                            (["distance", "missing.obj", "b.obj"], 4), (["distance", "a.obj", "bad.obj"], 4),
                            (["distance", "a.obj", "b.obj", "--device", "none such"], 5)):
            with self.subTest(words):
                done = run(*words, "--json", folder=self.folder)
                self.assertIn(done.returncode, (0, 3) if code is None else (code,), done.stderr)
                answer = json.loads(done.stdout)
                validator.validate(answer)
                self.assertEqual("error" in answer, done.returncode in (2, 4, 5))
        for spoilt in ({"lower": -1}, {"stranger": 1}, {"upper_hex": "1.5"}):
            self.assertFalse(validator.is_valid(answer | spoilt), f"{spoilt} passes")

    def test_what_is_misspelt_is_told_where_answers_go(self):
        before = (self.folder / "b.obj").read_text()
        done = run("gate", "a.obj", "b.obj", "--mx=1abs", "--github", "--json=out.json", "--junit", "out.xml", folder=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(json.loads((self.folder / "out.json").read_text())["error"]["code"], 2)
        self.assertIn(b"did you mean --max?", (self.folder / "out.xml").read_bytes())
        self.assertTrue(done.stdout.startswith(b"::error title=vkhausdorff::"), done.stdout)
        for word in ("--json=b.obj", "--junit=b.obj"):  # which is B: nothing is written over it
            self.assertEqual(run("gate", "a.obj", "b.obj", "--mx=1abs", word, folder=self.folder).returncode, 2)
            self.assertEqual((self.folder / "b.obj").read_text(), before)

    def test_a_case_has_one_name_whatever_its_outcome(self):
        (self.folder / "against.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 4 3\n")
        pair, sided = ("a.obj", "b.obj"), ("--max=-0.3abs,+0.2abs",)
        for words, code, name in (((*pair, "--max", "9abs"), 0, "a.obj -> b.obj within 9abs"), ((*pair, "--max", "9abs", "--device", "none such"), 5, "a.obj -> b.obj within 9abs"),
                                  ((*pair, "--max=9abs", "--symmetric"), 0, "a.obj <-> b.obj within 9abs"), ((*pair, "--symmetric", "--max", "9abs", "--memry"), 2, "a.obj <-> b.obj within 9abs"),
                                  ((*pair, *sided), None, "a.obj -> b.obj within +0.2abs,-0.3abs"), ((*pair, *sided, "--memry"), 2, "a.obj -> b.obj within +0.2abs,-0.3abs"),
                                  (("a.obj", "against.obj", *sided), 4, "a.obj -> against.obj within +0.2abs,-0.3abs"),
                                  (("missing.obj", "b.obj", "--max", "9abs"), 4, "missing.obj -> b.obj within 9abs")):
            with self.subTest(words):
                done = run("gate", *words, "--junit", "name.xml", "--json=name.json", folder=self.folder)
                self.assertIn(done.returncode, (0, 1, 3) if code is None else (code,), done.stderr)
                self.assertEqual(html.unescape(re.search('<testcase [^>]* name="([^"]*)"', (self.folder / "name.xml").read_text())[1]), name)
                if code == 4:
                    self.assertEqual(json.loads((self.folder / "name.json").read_text())["error"]["file"], words["against.obj" in words])

    @unittest.skipIf(junitparser is None, "no junitparser here")
    def test_every_suite_is_read_by_another(self):
        file = self.folder / "out.xml"
        odd = "it's <a> & \"b\"\x07.obj"
        (self.folder / odd).write_text((self.folder / "a.obj").read_text())
        for a, limit, counts, kind in (("a.obj", "0.3abs", (1, 0, 0), None), ("a.obj", "0.2abs", (1, 1, 0), junitparser.Failure),
                                       ("a.obj", "0.25abs", (1, 0, 1), junitparser.Error), (odd, "0.2abs", (1, 1, 0), junitparser.Failure),
                                       ("missing.obj", "1abs", (1, 0, 1), junitparser.Error)):
            with self.subTest(a=a, limit=limit):
                run("gate", a, "b.obj", "--max", limit, f"--junit={file}", folder=self.folder)
                suites = junitparser.JUnitXml.fromfile(str(file))
                suites.update_statistics()
                self.assertEqual((suites.tests, suites.failures, suites.errors), counts)
                case = next(iter(next(iter(suites))))
                self.assertEqual([type(result) for result in case.result], [kind] if kind else [])
                self.assertTrue(case.name.startswith(os.path.basename(a).replace("\x07", "\\x07")), case.name)
                if kind:
                    self.assertTrue(case.result[0].message.startswith(("FAIL", "UNDECIDED", "missing.obj")), case.result[0].message)


if __name__ == "__main__":
    if jsonschema is None and junitparser is None:
        print("schema_test: skipped, neither jsonschema nor junitparser")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
