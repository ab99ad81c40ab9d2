#!/usr/bin/env python3
"""Closest points in the Python module: arrays, devices, refusals, ends. That they are true: tests/solve/closest_test.cpp."""
import copy
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np
import vkhausdorff as vkh

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=np.float64)
CUBE_FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                       [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])


class ClosestPoints(unittest.TestCase):
    def test_rows_stay_in_order(self):
        """Each point is over the middle of a face, which is then the closest one."""
        corners = CUBE[CUBE_FACES]
        middles = corners.mean(axis=1)
        outward = (middles - 0.5) * (np.ptp(corners, axis=1) == 0)  # half a unit along the face's normal
        r = vkh.closest((CUBE, CUBE_FACES), middles + 0.25 * outward)
        self.assertEqual((r.lower.dtype, r.upper.shape, r.points.shape), (np.float64, (12,), (12, 3)))
        self.assertEqual(r.faces.tolist(), list(range(12)))
        np.testing.assert_allclose(r.points, middles, atol=1e-14)
        self.assertTrue((r.lower <= 0.125).all() and (r.upper >= 0.125).all() and (r.upper < 0.125 + 1e-10).all())

    def test_it_unpacks_copies_and_pickles(self):
        r = vkh.closest((CUBE, CUBE_FACES), [[2, 0.5, 0.5], [0.5, 0.25, 0.5]])
        distances, points, faces = r
        self.assertIs(distances, r.upper)
        self.assertIs(points, r.points)
        self.assertIs(faces, r.faces)
        np.testing.assert_allclose(distances, [1, 0.25], rtol=1e-12)
        np.testing.assert_allclose(points, [[1, 0.5, 0.5], [0.5, 0, 0.5]], atol=1e-15)
        for other in (copy.copy(r), copy.deepcopy(r), pickle.loads(pickle.dumps(r))):
            for mine, theirs in zip((r.lower, *r), (other.lower, *other)):
                np.testing.assert_array_equal(mine, theirs)
                self.assertFalse(theirs.flags.writeable)
            self.assertEqual(other, r)
        self.assertFalse(r == vkh.closest((CUBE, CUBE_FACES), [[2, 0.5, 0.5], [0.5, 0.25, 0.4]]))
        self.assertIn("<th>points</th><td>2</td>", r._repr_html_())
        self.assertEqual(repr(r), "<vkhausdorff.Closest of 2 points>")

    def test_a_solver_gives_the_same_bits(self):
        points = np.random.default_rng(3).uniform(-2, 3, (300, 3))
        r = vkh.closest((CUBE, CUBE_FACES), points)
        with vkh.Solver(CUBE, CUBE_FACES) as solver:
            for part in (points, points[:7].astype(object).astype(float)):
                again = solver.closest(part)
                np.testing.assert_array_equal(again.upper, r.upper[:len(part)])
                np.testing.assert_array_equal(again.lower, r.lower[:len(part)])
        with self.assertRaisesRegex(ValueError, "closed"):
            solver.closest(points)

    def test_over_several_devices(self):
        points = np.random.default_rng(5).uniform(-2, 3, (20000, 3))
        alone = vkh.closest((CUBE, CUBE_FACES), points, device=0)
        with vkh.Solver(CUBE, CUBE_FACES, "0,0") as solver:
            over = [vkh.closest((CUBE, CUBE_FACES), points, device="0,0"), solver.closest(points), solver.closest(points[:3])]
            self.assertEqual(solver.distance(CUBE, CUBE_FACES).upper, 0)
        for found in over:
            for mine, theirs in zip((found.lower, *found), (alone.lower, *alone)):
                np.testing.assert_array_equal(mine, theirs[:len(mine)])
        np.testing.assert_array_equal(vkh.closest((CUBE, CUBE_FACES), points[:9], device="all").faces.shape, (9,))
        with self.assertRaisesRegex(ValueError, "points: row 15000: .* not finite"):
            vkh.closest((CUBE, CUBE_FACES), np.where(np.arange(20000)[:, None] == 15000, np.nan, points), device="0,0")
        for call in (lambda wrong: vkh.closest((CUBE, CUBE_FACES), points, device=wrong),
                     lambda wrong: vkh.Solver(CUBE, CUBE_FACES, device=wrong)):
            with self.assertRaisesRegex(ValueError, "^device: expected names between commas, or 'all', not '0,,0'"):
                call("0,,0")
            with self.assertRaises(vkh.DeviceError):
                call("0,none such")
            with self.assertRaisesRegex(TypeError, "^device: expected .* several of these between commas"):
                call(["0", "0"])

    def test_every_kind_of_points(self):
        rows = [[2, 0, 0], [0, -3, 1]]
        expected = vkh.closest((CUBE, CUBE_FACES), rows)
        np.testing.assert_allclose(expected.upper, [1, 3], rtol=1e-14)
        for kind in (np.float32, np.int16, np.int64, ">f8"):
            given = np.asfortranarray(np.array(rows, dtype=kind))
            np.testing.assert_array_equal(vkh.closest((CUBE, CUBE_FACES), given).upper, expected.upper)
        none = vkh.closest((CUBE, CUBE_FACES), np.empty((0, 3)))
        self.assertEqual((none.upper.shape, none.points.shape), ((0,), (0, 3)))

    def test_wrong_points_are_named(self):
        for points, wrong in (([[0, 0]], r"points: an array of shape \(1, 2\)"), (["a"], "points: "),
                              ([[0, 0, 0], [0, np.nan, 0]], "points: row 1: .* not finite"),
                              ([[2**53 + 2, 0, 0]], "points: row 0 has 9007199254740994")):
            with self.assertRaisesRegex(ValueError, wrong):
                vkh.closest((CUBE, CUBE_FACES), points)
        with self.assertRaises(TypeError):
            vkh.closest((CUBE, CUBE_FACES))
        with self.assertRaises(TypeError):
            vkh.closest((CUBE, CUBE_FACES), [[0, 0, 0]], "")

    def test_the_example(self):
        example = pathlib.Path(__file__).parent.parent / "package" / "closest_example.py"
        done = subprocess.run([sys.executable, "-B", example], capture_output=True, text=True, timeout=120)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("[0.5 1. ]", done.stdout)

    def test_ctrl_c_ends_a_search(self):
        points = np.random.default_rng(4).uniform(-2, 3, (2_000_000, 3))
        for device in ("", "0,0"):
            started = time.monotonic()
            killer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
            killer.start()
            with self.assertRaises(KeyboardInterrupt):
                while time.monotonic() - started < 60:
                    vkh.closest((CUBE, CUBE_FACES), points, device=device)
            killer.join()
        np.testing.assert_array_equal(vkh.closest((CUBE, CUBE_FACES), [[2, 0, 0]]).faces.shape, (1,))


if __name__ == "__main__":
    unittest.main()
