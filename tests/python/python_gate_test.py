#!/usr/bin/env python3
"""gate() and assert_within() of the Python module. Run through ctest."""
import types
import unittest

import numpy as np
import vkhausdorff as vkh
from python_shapes import SQUARE, SQUARE_FACES as FACES

A, B = (SQUARE + [0, 0, 0.25], FACES), (SQUARE, FACES)
LONG = (SQUARE * [2, 1, 1], FACES)


class Gates(unittest.TestCase):
    def test_verdicts_are_proven(self):
        within = vkh.gate(A, B, 0.3)
        self.assertEqual(within.verdict, "pass")
        self.assertLessEqual(within.upper, 0.3)
        beyond = vkh.gate(A, B, 0.2)
        self.assertEqual(beyond.verdict, "fail")
        self.assertGreater(beyond.lower, 0.2)
        self.assertAlmostEqual(beyond.witness_a[2], 0.25)
        self.assertEqual(vkh.gate(A, B, 0.25).verdict, "undecided")
        self.assertEqual(vkh.gate(A, B, max=0.3).stats["max"], 0.3)
        self.assertIsNone(vkh.distance(*A, *B).verdict)

    def test_both_directions(self):
        self.assertEqual(vkh.gate(B, LONG, 0.5).verdict, "pass")
        r = vkh.gate(B, LONG, 0.5, symmetric=True)
        self.assertEqual(r.verdict, "fail")
        self.assertEqual(r.stats["direction"], "b_to_a")
        self.assertEqual(vkh.gate(B, LONG, 1.001, symmetric=True).verdict, "pass")

    def test_an_error_about_areas_names_the_mesh_that_fails(self):
        def found(lower, upper):
            return types.SimpleNamespace(bands={}, area_within=lambda _: vkh.Interval(lower, upper))

        r = types.SimpleNamespace(verdict="fail", stats={"area": 0.99}, survey=found(0.5, 1.0), survey_back=found(0.9, 0.95))
        self.assertEqual(vkh._say_area(r, 0.1), "FAIL: at most 0.95 of B's area is within 0.1 of A; 0.99 was asked")
        r.verdict = "undecided"
        r.survey_back = found(0.995, 0.999)
        self.assertEqual(vkh._say_area(r, 0.1), "UNDECIDED: from 0.5 to 1.0 of A's area is within 0.1 of B; 0.99 was asked")

    def test_meshes_are_pairs_or_objects(self):
        as_faces = types.SimpleNamespace(vertices=A[0], faces=A[1])
        as_triangles = types.SimpleNamespace(vertices=B[0], triangles=B[1])
        self.assertEqual(vkh.gate(as_faces, as_triangles, 0.3).verdict, "pass")
        self.assertEqual(vkh.gate(list(A), as_triangles, "20%").verdict, "pass")  # of sqrt(2)
        self.assertEqual(vkh.gate(A, B, "0.2abs").verdict, "fail")
        for wrong in (None, A[0], (A[0],), types.SimpleNamespace(vertices=A[0])):
            with self.assertRaisesRegex(TypeError, "^b: expected .vertices, faces."):
                vkh.gate(A, wrong, 0.3)

    def test_worst_goes_on_to_the_farthest_point(self):
        tilted = (SQUARE + [[0, 0, 0], [0, 0, 4], [0, 0, 4], [0, 0, 0]], FACES)
        floor = (SQUARE * 20 - [5, 5, 0], FACES)
        found = vkh.gate(tilted, floor, 0.001, worst=True)
        self.assertEqual((found.verdict, found.status), ("fail", "limit"))
        self.assertLessEqual(found.upper - found.lower, 4.1e-3)
        self.assertTrue(found.lower <= 4 <= found.upper)
        plain = vkh.gate(tilted, floor, 0.001)
        self.assertEqual(plain.verdict, "fail")
        self.assertRegex(repr(plain), r"^<vkhausdorff.Result at least [0-9.]+ limit>$")
        self.assertNotIn("upper", plain._repr_html_())
        self.assertNotIn("gap", plain._repr_html_())
        self.assertRegex(repr(found), r"^<vkhausdorff.Result \[3[0-9.]+, 4[0-9.]*\] limit>$")
        self.assertIn("<th>upper</th>", found._repr_html_())
        self.assertGreaterEqual(plain.upper, found.upper)
        passed = vkh.gate(tilted, floor, 9, worst=True)
        self.assertEqual(passed.verdict, "pass")
        self.assertLessEqual(passed.upper - passed.lower, 4.1e-3)
        with self.assertRaisesRegex(TypeError, "^worst: "):
            vkh.gate(tilted, floor, 1, worst=1)

    def test_assertions(self):
        self.assertIsNone(vkh.assert_within(A, B, 0.3))
        with self.assertRaisesRegex(AssertionError, r"^FAIL: .* on face [01] of A is at least 0\.2\d+ from B; max is 0\.2$"):
            vkh.assert_within(A, B, 0.2)
        with self.assertRaisesRegex(AssertionError, r"on face [01] of B is at least 0\.9\d+ from A"):
            vkh.assert_within(B, LONG, 0.5, symmetric=True)
        with self.assertRaisesRegex(AssertionError, r"^UNDECIDED \((closed|precision)\): max 0\.25 lies in \[0\.2"):
            vkh.assert_within(A, B, 0.25)

    def test_faces_have_limits_of_their_own(self):
        self.assertEqual(vkh.gate(A, B, [0.3, 0.26]).verdict, "pass")
        r = vkh.gate(A, B, np.array([0.3, 0.2], dtype=np.float32))
        self.assertEqual((r.verdict, r.face_a), ("fail", 1))
        self.assertGreater(r.lower, 0.2)
        self.assertEqual(vkh.gate(A, B, (0.3, 0.25)).stats["faces_within"], 1)
        with self.assertRaisesRegex(ValueError, "a limit for each of 2 faces, not 3"):
            vkh.gate(A, B, [0.3] * 3)
        with self.assertRaisesRegex(ValueError, "a limit for each of 2 faces, not 0"):
            vkh.gate(A, B, [])
        with self.assertRaisesRegex(ValueError, "the limit of face 1 must be positive"):
            vkh.gate(A, B, [0.3, 0])
        with self.assertRaisesRegex(ValueError, "each direction separately"):
            vkh.gate(A, B, [0.3, 0.3], symmetric=True)
        with self.assertRaisesRegex(AssertionError, "on face 1 of A"):
            vkh.assert_within(A, B, [0.3, 0.2])

    def test_wrong_limits_are_refused(self):
        for wrong in (0, -1, float("nan"), float("inf"), "0.1", "0.1mm", "x", "-1abs"):
            with self.assertRaisesRegex(ValueError, "^max"):
                vkh.gate(A, B, wrong)
        for wrong in (None, object(), ["a", "b"], {}):
            with self.assertRaisesRegex(TypeError, "^max"):
                vkh.gate(A, B, wrong)
        with self.assertRaises(TypeError):
            vkh.gate(A, B)
        with self.assertRaises(TypeError):
            vkh.gate(A, B, 0.1, stranger=1)


if __name__ == "__main__":
    unittest.main()
