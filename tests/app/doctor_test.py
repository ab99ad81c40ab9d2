"""vkhausdorff doctor --json: what it says of a device, also of one that breaks a promise, and of a machine without one.

usage: doctor_test.py PROGRAM LAYER_FOLDER
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]
LAYER = {"VK_LAYER_PATH": sys.argv[2], "VK_INSTANCE_LAYERS": "VK_LAYER_VKH_test"}
PARTS = ("device", "arithmetic", "subgroup_operations", "self_check", "times")


def run(*words, **environment):
    return subprocess.run([PROGRAM, "doctor", *words], capture_output=True, text=True, timeout=300, env=os.environ | environment)


class Doctor(unittest.TestCase):
    def found(self, code, *words, **environment):
        done = run("--json", *words, **environment)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        found = json.loads(done.stdout)
        self.assertEqual(list(found), ["schema", "version", "system", "problem", "native", "loader", "devices", *PARTS])
        return found

    def test_a_device_that_can_be_trusted(self):
        found = self.found(0)
        self.assertIsNone(found["problem"])
        self.assertTrue(found["arithmetic"]["passed"])
        check = found["self_check"]
        self.assertTrue(check["passed"] and check["lower"] <= check["distance"] <= check["upper"])
        self.assertIn(found["device"]["deviceName"], [one["name"] for one in found["devices"]])
        self.assertTrue(found["device"]["features"]["scalarBlockLayout"])
        self.assertGreaterEqual(found["device"]["limits"]["maxPushConstantsSize"], 128)
        for place in found["subgroup_operations"]:
            self.assertEqual(sum(place["wrong"].values()), 0)
            self.assertGreater(place["views"], 0)
        whole, branch, loop = found["subgroup_operations"]
        self.assertEqual(whole["partial"], 0)
        if found["device"]["subgroup"]["subgroupSize"] > 1:
            self.assertGreater(min(branch["partial"], loop["partial"]), 0)
        self.assertEqual(found["times"]["status"], "closed")
        self.assertGreater(found["times"]["wall_ms"], 0)

    def test_a_device_that_has_less_and_breaks_a_promise_is_told_all_the_same(self):
        found = self.found(5, **LAYER, VKH_LAYER_REGROUP="1", VKH_LAYER_HIDE="VK_KHR_push_descriptor")
        self.assertFalse(found["arithmetic"]["passed"])
        self.assertIn("regroups sums", found["arithmetic"]["fault"])
        self.assertIsNotNone(found["times"])
        self.assertNotIn("VK_KHR_push_descriptor", found["device"]["extensions"])
        self.assertIsNone(found["device"]["limits"]["maxPushDescriptors"])

    def test_a_machine_without_a_driver(self):
        found = self.found(5, VK_DRIVER_FILES="/nowhere/icd.json", VK_ICD_FILENAMES="/nowhere/icd.json")
        self.assertIn("no compatible driver; install", found["problem"])
        self.assertEqual((found["devices"], found["device"]), (None, None))

    def test_the_processor_alone_needs_neither_driver_nor_loader(self):
        hidden = {"VK_DRIVER_FILES": "/nowhere/icd.json", "VK_ICD_FILENAMES": "/nowhere/icd.json"}
        found = self.found(0, "--device", "native", **hidden)
        self.assertTrue(found["native"].startswith("native, "))
        self.assertEqual(found["arithmetic"], {"passed": True, "fault": None})
        self.assertTrue(found["self_check"]["passed"])
        self.assertEqual(found["times"]["status"], "closed")
        unused = ("problem", "loader", "devices", "device", "subgroup_operations")
        self.assertEqual([found[part] for part in unused], [None] * len(unused))
        self.assertEqual(self.found(5, **hidden)["native"], found["native"])

    def test_a_machine_without_the_device_that_is_named(self):
        found = self.found(5, "--device", "none such")
        self.assertIn("none such", found["problem"])
        self.assertGreater(len(found["devices"]), 0)
        self.assertEqual([found[part] for part in PARTS], [None] * len(PARTS))

    def test_a_file_stands_beside_the_words(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "device.json"
            done = run(f"--json={file}", "--device", "none such")
            self.assertEqual((done.returncode, "devices, the preferred first" in done.stdout), (5, True), done.stderr)
            self.assertIn("none such", json.loads(file.read_text())["problem"])

    def test_a_file_that_cannot_be_written_is_refused_first(self):
        done = run("--json=/nowhere/x.json")
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertIn("--json", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
