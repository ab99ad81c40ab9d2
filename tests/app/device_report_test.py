"""vkhausdorff doctor --device-report: the document fits docs/schema/device-report.schema.json, also of a device that
breaks a promise, and of a machine without one.

usage: device_report_test.py PROGRAM SOURCE LAYER_FOLDER
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import jsonschema
except ImportError:
    jsonschema = None

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
LAYER = {"VK_LAYER_PATH": sys.argv[3], "VK_INSTANCE_LAYERS": "VK_LAYER_VKH_test"}


class Reports(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.file = pathlib.Path(scratch.name) / "device.json"

    def doctor(self, code, *words, **environment):
        done = subprocess.run([PROGRAM, "doctor", "--device-report", self.file, *words], capture_output=True, text=True,
                              timeout=300, env=os.environ | environment)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        report = json.loads(self.file.read_text())
        if jsonschema:
            schema = json.loads((SOURCE / "docs/schema/device-report.schema.json").read_text())
            jsonschema.Draft202012Validator.check_schema(schema)
            validator = jsonschema.Draft202012Validator(schema)
            validator.validate(report)
            self.assertFalse(validator.is_valid(report | {"stranger": 1}))
            self.assertFalse(validator.is_valid({key: report[key] for key in report if key != "devices"}))
        return report

    def test_a_device_that_can_be_trusted(self):
        report = self.doctor(0)
        self.assertIsNone(report["problem"])
        self.assertTrue(report["arithmetic"]["passed"] and report["self_check"]["passed"])
        self.assertIn(report["device"]["deviceName"], [one["name"] for one in report["devices"]])
        self.assertTrue(report["device"]["features"]["scalarBlockLayout"])
        self.assertGreaterEqual(report["device"]["limits"]["maxPushConstantsSize"], 128)
        for place in report["subgroup_operations"]:
            self.assertEqual(sum(place["wrong"].values()), 0)
            self.assertGreater(place["views"], 0)
        whole, branch, loop = report["subgroup_operations"]
        self.assertEqual(whole["partial"], 0)
        if report["device"]["subgroup"]["subgroupSize"] > 1:
            self.assertGreater(min(branch["partial"], loop["partial"]), 0)
        self.three_sizes_of_the_same_surfaces(report["sizes"])

    def three_sizes_of_the_same_surfaces(self, rows):
        self.assertEqual([row["faces_a"] for row in rows], [rows[0]["faces_a"] * 4**size for size in range(3)])
        self.assertEqual([row["faces_b"] for row in rows], [rows[0]["faces_b"] * 4**size for size in range(3)])
        lower, upper = (pick(float.fromhex(row[end]) for row in rows) for pick, end in ((max, "lower_hex"), (min, "upper_hex")))
        self.assertLessEqual(lower, upper, "no distance lies in all three intervals")
        self.assertEqual({row["status"] for row in rows}, {"closed"})

    def test_a_device_that_has_less_and_breaks_a_promise_is_reported_all_the_same(self):
        report = self.doctor(5, **LAYER, VKH_LAYER_REGROUP="1", VKH_LAYER_HIDE="VK_KHR_push_descriptor")
        self.assertFalse(report["arithmetic"]["passed"])
        self.assertIn("regroups sums", report["arithmetic"]["fault"])
        self.assertEqual(len(report["sizes"]), 3)
        self.assertNotIn("VK_KHR_push_descriptor", report["device"]["extensions"])
        self.assertIsNone(report["device"]["limits"]["maxPushDescriptors"])

    def test_a_machine_without_a_driver(self):
        report = self.doctor(5, VK_DRIVER_FILES="/nowhere/icd.json", VK_ICD_FILENAMES="/nowhere/icd.json")
        self.assertIn("no compatible driver; install", report["problem"])
        self.assertEqual((report["devices"], report["device"]), ([], None))

    def test_a_machine_without_a_device(self):
        report = self.doctor(5, "--device", "none such")
        self.assertIn("none such", report["problem"])
        for part in ("device", "arithmetic", "subgroup_operations", "self_check", "sizes"):
            self.assertIsNone(report[part], part)

    def test_a_file_that_cannot_be_written_is_refused_first(self):
        done = subprocess.run([PROGRAM, "doctor", "--device-report", "/nowhere/x.json"], capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertIn("--device-report", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
