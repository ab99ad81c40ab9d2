"""The outputs of batch and merge: lines of docs/schema/pair.schema.json, CSV and JUnit's XML, by
readers that are not ours.

usage: pair_schema_test.py PROGRAM SOURCE. Exit code 77: neither jsonschema nor junitparser is here.
"""

import csv
import json
import pathlib
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

PROGRAM, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
SQUARE = "v 0 0 {z}\nv {x} 0 {z}\nv {x} 1 {z}\nv 0 1 {z}\nf 1 2 3\nf 1 3 4\n"
ODD = "it's <a>, \"b\" \u00e9\u6f22\x07\nand a line"
# A batch's possible questions, and the code of each line.
PAIRS = [({"id": "closed", "a": "a.obj", "b": "low.obj"}, 0),
         ({"id": "same", "a": "a.obj", "b": "a.obj"}, 0),
         ({"id": "both ways", "a": "a.obj", "b": "wide.obj", "symmetric": True}, 0),
         ({"id": "pass", "a": "quad.obj", "b": "high.obj", "max": "0.3abs"}, 0),
         ({"id": "fail", "a": "a.obj", "b": "wide.obj", "symmetric": True, "max": "0.5in", "unit": "in"}, 1),
         ({"id": "undecided", "a": "a.obj", "b": "b.obj", "max": "0.25abs", "tol": "1e-3"}, 3),
         ({"id": "shared 1", "a": "a.obj", "b": "shared.obj"}, 0),
         ({"id": "shared 2", "a": "b.obj", "b": "shared.obj"}, 0),
         ({"id": ODD, "a": "a.obj", "b": "shared.obj", "tol": "1%"}, 0),
         ({"id": "signed", "a": "a.obj", "b": "high.obj", "signed": True}, 0),
         ({"id": "signed both ways", "a": "a.obj", "b": "wide.obj", "signed": True, "symmetric": True}, 0),
         ({"id": "within its side", "a": "a.obj", "b": "high.obj", "max": "+0.1abs,-0.3abs"}, 0),
         ({"id": "beyond its side", "a": "a.obj", "b": "high.obj", "max": "-0.2abs,+0.3abs", "signed": True}, 1),
         ({"id": "sides of both", "a": "a.obj", "b": "high.obj", "max": "+0.1abs,-0.3abs", "symmetric": True}, 2),
         ({"id": "missing", "a": "missing.obj", "b": "b2.obj"}, 4),
         ({"id": "no B", "a": "a.obj", "b": "gone.obj"}, 4),
         ({"id": "malformed", "a": "bad.obj", "b": "b3.obj"}, 4),
         ({"id": "no unit", "a": "a.obj", "b": "b4.obj", "max": "1mm"}, 2),
         ({"id": "wrong row", "a": "a.obj", "b": "b5.obj", "unit": "parsec"}, 2)]
CODES = {pair["id"]: code for pair, code in PAIRS}


def run(*words, folder):
    return subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True, timeout=600)


def lines_of(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def schema_of(name):
    return json.loads((SOURCE / f"docs/schema/{name}.schema.json").read_text())


def pair_schema():
    """The schema of lines with that of answers, to which it refers, in it."""
    schema = schema_of("pair")
    schema["$defs"]["of an answer"] = schema_of("answer")
    return schema


class Batch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = folder = pathlib.Path(scratch.name)
        for name, x, z in (("a", 1, 0), ("wide", 2, 0), *((name, 1, 0.25) for name in ("b", "b2", "b3", "b4", "b5", "low", "high", "shared"))):
            (folder / f"{name}.obj").write_text(SQUARE.format(x=x, z=z))
        (folder / "quad.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3 4\n")
        (folder / "bad.obj").write_text("v 0 0 zero\n")
        (folder / "list.jsonl").write_text("".join(json.dumps(pair) + "\n" for pair, _ in PAIRS))
        (folder / "late.csv").write_text("id,a,b\nlate,a.obj,b.obj\n")
        cls.done = run("batch", "list.jsonl", "--effort", "20000", "--out", "out.jsonl", "--csv", "out.csv", "--junit", "out.xml", folder=folder)
        cls.late = run("batch", "late.csv", "--out", "late.jsonl", "--time", "0.001ms", folder=folder)
        cls.merged = run("merge", "out.jsonl", "late.jsonl", "--out", "all.jsonl", "--reproducible", "--csv", "all.csv", folder=folder)

    def test_codes(self):
        self.assertEqual({line["id"]: line["code"] for line in lines_of(self.folder / "out.jsonl")}, CODES, self.done.stderr)
        self.assertEqual(self.done.returncode, 4)
        self.assertEqual([line["status"] for line in lines_of(self.folder / "late.jsonl")], ["time"])
        self.assertEqual((self.late.returncode, self.merged.returncode), (3, 4))

    @unittest.skipIf(jsonschema is None, "no jsonschema here")
    def test_every_line_is_of_the_schema(self):
        schema = pair_schema()
        jsonschema.Draft202012Validator.check_schema(schema)
        validator = jsonschema.Draft202012Validator(schema)
        for file, has_run in (("out.jsonl", True), ("late.jsonl", True), ("all.jsonl", False)):
            for line in lines_of(self.folder / file):
                with self.subTest(file=file, id=line["id"]):
                    validator.validate(line)
                    self.assertEqual("error" in line, line["code"] in (2, 4))
                    self.assertEqual("run" in line, has_run)
                for spoilt in ({"stranger": 1}, {"code": 9}, {"id": ""}, {"key": "0"}, {"run": {}}, {"schema": "vkhausdorff.answer/2"}):
                    self.assertFalse(validator.is_valid(line | spoilt), f"{line['id']}: {spoilt} passes")
        merged = lines_of(self.folder / "all.jsonl")
        self.assertEqual([line["id"] for line in merged], sorted([*CODES, "late"], key=str.encode))

    def test_definitions_are_those_of_an_answer(self):
        ours, answers = schema_of("pair")["$defs"], schema_of("answer")["$defs"]
        # A line has no times or waves of a direction, and names of its own in answers and failures.
        self.assertEqual(set(ours) & set(answers), {"direction", "answer", "failure"})
        for name, shared in (("direction", "search"), ("answer", "common")):
            self.assertEqual((ours[name]["$ref"], answers[name]["$ref"]), (f"../answer/2#/$defs/{shared}", f"#/$defs/{shared}"))

    def test_csv_is_read_by_another(self):
        lines = {line["id"]: line for line in lines_of(self.folder / "out.jsonl")}
        for file, ids, more in (("out.csv", set(CODES), {"gpu_ms", "total_ms", "host", "started"}), ("all.csv", {*CODES, "late"}, set())):
            with open(self.folder / file, newline="", encoding="utf-8") as text:
                rows = list(csv.DictReader(text, strict=True))
            self.assertEqual({row["id"] for row in rows}, ids)
            self.assertEqual(more, set(rows[0]) & {"gpu_ms", "total_ms", "host", "started"})
            for row in rows:
                line = lines.get(row["id"])
                if line is None:
                    continue
                self.assertEqual(int(row["code"]), line["code"])
                self.assertEqual(row["words"], line["error"]["message"] if "error" in line else line["words"])
                self.assertEqual([row["a"], row["b"]], [side["path"] for side in line["inputs"]])
                ends = line.get("interval", {"lower": 0, "upper": 1})
                is_known = ends["upper"] is not None and ends["upper"] - ends["lower"] <= 2e-3 * ends["lower"]
                is_sought = "error" not in line and (line.get("verdict") != "fail" or is_known)
                self.assertEqual((row["upper"] != "", row["gap"] != ""), (is_sought, is_sought), row["id"])
                signed = {} if "error" in line else line["directions"][0].get("signed", {})
                self.assertEqual(row["signed_p50_lower"] != "", bool(signed.get("mean")), row["id"])
                self.assertEqual(row["over_upper"] != "", bool(signed), row["id"])
                if signed.get("mean"):
                    self.assertEqual((float(row["signed_mean_lower"]), float(row["signed_mean_upper"])),
                                     (signed["mean"]["lower"], signed["mean"]["upper"]))
                    for p in signed["percentiles"]:
                        name = f"signed_p{100 * p['share']:g}"
                        self.assertEqual((float(row[name + "_lower"]), float(row[name + "_upper"])),
                                         (p["distance"]["lower"], p["distance"]["upper"]))
                    self.assertEqual(float(row["under_lower"]), signed["under"]["lower"])
                    rest = 1 - signed["areas"]["over"]["lower"] - signed["areas"]["under"]["lower"]
                    self.assertAlmostEqual(float(row["unsigned_share"]), rest, 12)
                if row["upper"]:
                    self.assertEqual((float(row["lower"]), float(row["upper"])), (line["interval"]["lower"], line["interval"]["upper"]))

    @unittest.skipIf(junitparser is None, "no junitparser here")
    def test_junit_is_read_by_another(self):
        suites = junitparser.JUnitXml.fromfile(str(self.folder / "out.xml"))
        suites.update_statistics()
        bad = [code for code in CODES.values() if code != 0]
        self.assertEqual((suites.tests, suites.failures, suites.errors), (len(CODES), bad.count(1), len(bad) - bad.count(1)))
        cases = {case.name: [type(result) for result in case.result] for suite in suites for case in suite}
        printed = {id.replace("\x07", "\\x07").replace("\n", "\\x0a"): code for id, code in CODES.items()}
        kinds = {0: [], 1: [junitparser.Failure]}
        self.assertEqual(cases, {id: kinds.get(code, [junitparser.Error]) for id, code in printed.items()})


if __name__ == "__main__":
    if jsonschema is None and junitparser is None:
        print("pair_schema_test: skipped, neither jsonschema nor junitparser")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
