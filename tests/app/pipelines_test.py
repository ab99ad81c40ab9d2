#!/usr/bin/env python3
"""The pipelines that a command makes: one set for all that its question needs.

usage: pipelines_test.py PROGRAM   (VKH_LAYER_FOLDER: the test layer, docs/test_layer.md)
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "platforms"))

import meshes  # noqa: E402

PROGRAM = os.path.abspath(sys.argv.pop(1))
LAYER = os.environ["VKH_LAYER_FOLDER"]
QUICK = ["--effort", "0"]
CELLS = 12  # kernels: the bounds of cells, and what a survey does with them


class Pipelines(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        for name, count, radius in (("a", 12, 1.0), ("b", 10, 1.1), ("large", 10, 3.0)):
            (cls.folder / f"{name}.ply").write_bytes(meshes.as_ply(*meshes.sphere(count, radius)))
        faces = len(meshes.sphere(12, 1.0)[1])
        (cls.folder / "limits.csv").write_text("face,max\n" + "".join(f"{i},{0.5 + i % 2}\n" for i in range(faces)))
        rows = [{"id": str(i), "a": "a.ply", "b": "b.ply"} for i in range(4)]
        (cls.folder / "list.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
        cls.plain = cls.made("distance", "a.ply", "b.ply")

    @classmethod
    def made(cls, *words):
        """The number of compute pipelines."""
        counts = cls.folder / "counts"
        for old in (counts, cls.folder / "out.jsonl"):
            old.unlink(missing_ok=True)
        layer = {"VK_LAYER_PATH": f"{LAYER}:/usr/share/vulkan/explicit_layer.d",
                 "VK_INSTANCE_LAYERS": "VK_LAYER_VKH_test", "NODEVICE_SELECT": "1", "VKH_LAYER_COUNT": str(counts)}
        done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, cwd=cls.folder, env={**os.environ, **layer})
        assert done.returncode in (0, 1, 3), done.stderr
        found = re.search(r"^vkCreateComputePipelines (\d+)$", counts.read_text(), re.M)
        return int(found[1])

    def check(self, more, *words):
        with self.subTest(words=words):
            self.assertEqual(self.made(*words), self.plain + more)

    def test_a_distance_needs_one_set(self):
        self.check(0, "distance", "a.ply", "b.ply", "--symmetric")
        self.check(0, "gate", "a.ply", "b.ply", "--max", "1abs")

    def test_cells_add_their_kernels(self):
        self.check(CELLS, "distance", "a.ply", "b.ply", "--stats", *QUICK)
        self.check(CELLS, "distance", "a.ply", "b.ply", "--field", "field.ply", *QUICK)
        self.check(CELLS, "metrics", "a.ply", "b.ply", *QUICK)
        self.check(CELLS, "distance", "a.ply", "b.ply", "--certificate", "it.vhc")

    def test_the_hosts_check_needs_no_set_of_its_own_for_a_survey(self):
        alone = self.made("distance", "a.ply", "b.ply", "--verify")
        self.assertEqual(self.made("distance", "a.ply", "b.ply", "--verify", "--stats", *QUICK), alone + CELLS)

    def test_a_mesh_is_prepared_with_what_runs_need(self):
        self.check(0, "gate", "a.ply", "b.ply", "--max", "1abs", "--face-max", "limits.csv")
        self.check(0, "batch", "list.jsonl", "--out", "out.jsonl")
        self.check(CELLS, "batch", "list.jsonl", "--out", "out.jsonl", "--signed", *QUICK)
        self.check(0, "batch", "list.jsonl", "--out", "out.jsonl", "--max", "1abs")

    def test_a_fit_adds_one_kernel(self):
        self.check(1, "distance", "a.ply", "b.ply", "--align")
        self.check(1, "gate", "a.ply", "b.ply", "--max", "1abs", "--align")

    def test_lanes_share_theirs(self):
        self.check(0, "batch", "list.jsonl", "--out", "out.jsonl", "--lanes", "3", "--together", "1")

    # Not before A is known to be so much smaller.
    def test_a_tolerance_that_is_fine_for_b_alone_needs_another(self):
        self.assertGreater(self.made("distance", "a.ply", "large.ply", "--symmetric"), self.plain)


if __name__ == "__main__":
    unittest.main()
