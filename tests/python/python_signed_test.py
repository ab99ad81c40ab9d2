#!/usr/bin/env python3
"""Sides in the Python module: signed figures, fields of both sides, and limits that differ by side. That they are true: tests/solve/signed_test.cpp."""

import json
import pickle
import unittest

import numpy as np

import vkhausdorff as vkh

FLOOR = (np.array([[-2, -2, 0], [3, -2, 0], [3, 3, 0], [-2, 3, 0]], float), np.array([[0, 1, 2], [0, 2, 3]]))
# From 0.1 under the floor to 0.15 over it, evenly.
RAMP = (np.array([[0, 0, -0.1], [1, 0, 0.15], [1, 1, 0.15], [0, 1, -0.1]], float), np.array([[0, 1, 2], [0, 2, 3]]))
TURNED = (FLOOR[0], FLOOR[1][:, ::-1])


class Signed(unittest.TestCase):
    def test_a_ramp_through_a_floor(self):
        r = vkh.distance(RAMP, FLOOR, field=True, statistics=True, signed=True)
        s = r.signed
        self.assertIs(s, r.survey.signed)
        self.assertEqual(s.inside, "open")
        self.assertEqual(s.open_edges, 4)
        self.assertIn(0.15, vkh.Interval(s.over.lower, s.over.upper + 1e-12))
        self.assertIn(0.1, vkh.Interval(s.under.lower, s.under.upper + 1e-12))
        self.assertIn(0.025, s.mean)
        self.assertIn(0.025, s.percentiles[0.5])
        self.assertLess(s.percentiles[0.01].upper, 0)
        self.assertGreater(s.areas["over"].lower, 0.54)
        self.assertGreater(s.areas["under"].lower, 0.34)
        self.assertLess(s.areas["unsigned"]["meets"].upper, 0.051)
        self.assertEqual(len(s.over_field), 2)
        self.assertTrue((s.over_field.upper <= r.field.upper).all())

    def test_far_points_and_sides_of_faces(self):
        r = vkh.distance(RAMP, FLOOR, field=True, statistics=True, signed=True)
        over, under = r.signed.over_witness, r.signed.under_witness
        self.assertEqual((over.point[2], under.point[2]), (0.15, -0.1))
        self.assertIn(over.face, (0, 1))
        self.assertLessEqual(over.lower, 0.15)
        self.assertGreater(over.lower, 0.15 - 1e-12)
        signed = r.field.signed
        self.assertIsInstance(signed, vkh.SignedField)
        self.assertTrue((signed.lower <= -0.1).all() and (signed.upper >= 0.15).all())
        self.assertEqual(signed.side.tolist(), [0, 0])
        self.assertEqual(signed.side.dtype, np.int8)
        high = vkh.distance((RAMP[0] + [0, 0, 1], RAMP[1]), FLOOR, field=True, signed=True)
        self.assertEqual(high.field.signed.side.tolist(), [1, 1])
        self.assertIsNone(high.signed.under_witness)
        low = vkh.distance((RAMP[0] - [0, 0, 1], RAMP[1]), FLOOR, field=True, signed=True)
        self.assertEqual(low.field.signed.side.tolist(), [-1, -1])
        self.assertEqual(pickle.loads(pickle.dumps(low.field)), low.field)
        self.assertNotEqual(low.field, high.field)
        self.assertIsNone(vkh.distance(RAMP, FLOOR, field=True).field.signed)

    def test_a_stop_before_the_sides(self):
        stops = []

        def progress(*args):
            stops.append(args)
            return False

        r = vkh.distance(RAMP, FLOOR, statistics=True, signed=True, progress=progress)
        self.assertTrue(stops)
        self.assertEqual(r.survey.ended, "cancelled")
        if r.signed is not None:
            self.assertEqual(r.signed.areas["unsigned"]["ended"].upper, 1)

    def test_many_pairs(self):
        pairs = [("ramp", RAMP, FLOOR), ("turned", RAMP, TURNED)]
        found = {r.id: r for r in vkh.distances(pairs, max="+0.16abs,-0.11abs", signed=True, statistics=True)}
        self.assertEqual({id: r.verdict for id, r in found.items()}, {"ramp": "pass", "turned": "fail"})
        self.assertIn(0.025, found["ramp"].signed.mean)
        self.assertIn(-0.025, found["turned"].signed.mean)
        bad = (FLOOR[0], np.array([[0, 1, 2], [0, 3, 2]]))
        (refused,) = vkh.distances([(RAMP, bad)], signed=True)
        self.assertIsInstance(refused.error, ValueError)

    def test_plain_values_and_pickles(self):
        survey = vkh.distance(RAMP, FLOOR, statistics=True, signed=True).survey
        self.assertEqual(pickle.loads(pickle.dumps(survey)), survey)
        self.assertEqual(json.loads(json.dumps(survey.to_dict()))["signed"]["inside"], "open")
        self.assertIsNone(vkh.distance(RAMP, FLOOR, statistics=True).signed)

    def test_limits_of_two_sides(self):
        for limits, verdict in (("+0.16abs,-0.11abs", "pass"), ("-0.09abs,+0.2abs", "fail")):
            self.assertEqual(vkh.gate(RAMP, FLOOR, limits).verdict, verdict)
        with self.assertRaisesRegex(ValueError, "symmetric: limits of two sides"):
            vkh.gate(RAMP, FLOOR, "+0.16abs,-0.11abs", symmetric=True)

    def test_a_mesh_that_is_inside_out(self):
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
        outward = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
        inner = (0.2 + 0.2 * corners, outward)
        for faces, how in ((outward, "none"), (outward[:, ::-1], "all")):
            with self.subTest(how):
                r = vkh.distance(inner, (corners, faces), signed=True)
                self.assertEqual((r.signed.inside, r.signed.inside_out), ("proven", how))
                self.assertEqual(r.to_dict()["survey"]["signed"]["inside_out"], how)
                self.assertEqual("inside-out" in [note["code"] for note in r.notes], how == "all")

    def test_faces_against_each_other_are_refused(self):
        bad = (FLOOR[0], np.array([[0, 1, 2], [0, 3, 2]]))
        with self.assertRaisesRegex(ValueError, "oriented against each other"):
            vkh.distance(RAMP, bad, signed=True)


if __name__ == "__main__":
    unittest.main()
