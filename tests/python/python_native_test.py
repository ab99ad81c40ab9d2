#!/usr/bin/env python3
"""device="native" in the Python module: every function answers without a driver. That answers are true: the tests of solve that run natively, too."""
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import vkhausdorff as vkh
from python_shapes import grid

NATIVE = {"device": "native"}
A, B = grid(6, bend=0.12), grid(4, height=0.02)


class Native(unittest.TestCase):
    def meets(self, x, y):
        self.assertLessEqual(max(x.lower, y.lower), min(x.upper, y.upper))

    def test_distance(self):
        found = vkh.distance(A, B, symmetric=True, tol=1e-9, **NATIVE)
        self.meets(found, vkh.distance(A, B, symmetric=True))
        self.assertEqual(found.stats["device"]["type"], "native")

    def test_gate_and_limits_of_faces(self):
        self.assertEqual(vkh.gate(A, B, max=0.5, **NATIVE).verdict, "pass")
        self.assertEqual(vkh.gate(A, B, max=0.001, **NATIVE).verdict, "fail")
        self.assertEqual(vkh.gate(A, B, max=np.full(len(A[1]), 0.5), **NATIVE).verdict, "pass")

    def test_closest(self):
        points = np.random.default_rng(3).uniform(-2, 2, (50, 3))
        native, device = vkh.closest(B, points, **NATIVE), vkh.closest(B, points)
        self.assertTrue((np.maximum(native.lower, device.lower) <= np.minimum(native.upper, device.upper)).all())

    def test_a_solver_and_a_device(self):
        for device in ("native", vkh.Device("native")):
            with vkh.Solver(B, device=device) as solver:
                alone = vkh.distance(A, B, **NATIVE)
                self.assertEqual((solver.distance(A).lower, solver.distance(A).upper), (alone.lower, alone.upper))
                self.assertEqual(solver.closest([[0, 0, 1]]).lower.shape, (1,))

    def test_distances(self):
        found = {r.index: r for r in vkh.distances([(A, B), (B, A), (A, A)], symmetric=True, **NATIVE)}
        self.meets(found[0], found[1])
        self.assertEqual((found[2].lower, found[2].upper), (0, 0))

    def test_metrics_and_figures(self):
        found = vkh.metrics(A, B, bands=[0.05], figures=["hd95", "f1"], effort=2000, **NATIVE)
        self.assertTrue(0 < found.hd95.lower <= found.hd95.upper <= found.hausdorff.upper)
        self.assertLess(found.f1[0.05].upper - found.f1[0.05].lower, 0.1)

    def test_a_certificate_proves_the_interval(self):
        with tempfile.TemporaryDirectory() as folder:
            found = vkh.distance(A, B, certificate=pathlib.Path(folder) / "ab.vhc", **NATIVE)
            self.assertEqual(found.stats["certificate"]["upper"], found.upper)
            self.assertGreater((pathlib.Path(folder) / "ab.vhc").stat().st_size, 100)

    def test_a_fit(self):
        turn = np.array([[math.cos(0.3), -math.sin(0.3), 0], [math.sin(0.3), math.cos(0.3), 0], [0, 0, 1]])
        moved = A[0] @ turn.T + [3, 1, -2], A[1]
        self.assertLess(vkh.distance(moved, A, align=True, **NATIVE).upper, 1e-6)

    def test_refused(self):
        for options in ({"preset": "paper"}, {"disable": ["u3"]}):
            with self.subTest(options), self.assertRaisesRegex(ValueError, "Vulkan device"):
                vkh.distance(A, B, **options, **NATIVE)
        with self.assertRaises(ValueError):
            vkh.closest(B, [[0, 0, 0]], device="native,0")

    def test_no_driver_is_needed(self):
        code = ("import vkhausdorff as vkh; b = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]];"
                "print(vkh.distance(b, b, device='native').upper, vkh.closest(b, [[0, 0, 2]], device='native').lower[0])")
        nowhere = str(pathlib.Path(tempfile.gettempdir()) / "nowhere.json")
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120,
                              env=os.environ | {"VK_DRIVER_FILES": nowhere, "VK_ICD_FILENAMES": nowhere})
        self.assertEqual(done.returncode, 0, done.stderr)
        zero, two = map(float, done.stdout.split())
        self.assertEqual(zero, 0)
        self.assertAlmostEqual(two, 2, places=12)


if __name__ == "__main__":
    unittest.main()
