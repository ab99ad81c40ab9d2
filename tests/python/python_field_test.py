#!/usr/bin/env python3
"""Fields and statistics in the Python module: attributes, refusals, pickles, files, ends. usage: python_field_test.py [PROGRAM], whose JSON is the same.

That they are true: tests/solve/survey_test.cpp and wave_survey_test.cpp.
"""
import copy
import json
import math
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np
import vkhausdorff as vkh
from python_shapes import SQUARE, SQUARE_FACES as FACES, grid

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else None
FLOOR = (4 * SQUARE - [1.5, 1.5, 0], FACES)
LIFTED = (SQUARE + [0, 0, 0.25], FACES)
# A mesh over the floor, from 0 at x = 0 to 1 at x = 1: the distance is the height, and uniform.
WEDGE = (SQUARE + [[0, 0, 0], [0, 0, 1], [0, 0, 1], [0, 0, 0]], FACES)
ALL = dict(field=True, statistics=True, bands=(0.25, 0.5))


class Fields(unittest.TestCase):
    def encloses(self, interval, value, width):
        lower, upper = interval
        self.assertLessEqual(lower, value)
        self.assertGreaterEqual(upper, value)
        self.assertLessEqual(upper - lower, width)

    def test_a_square_above_another(self):
        r = vkh.distance(*LIFTED, *FLOOR, field=True, statistics=True)
        self.assertEqual((r.field.lower.dtype, r.field.upper.shape, len(r.field)), (np.float64, (2,), 2))
        for face in range(2):
            self.encloses((r.field.lower[face], r.field.upper[face]), 0.25, 0.01 * 0.25)
        for interval in (r.mean, r.rms, *r.percentiles.values()):
            self.encloses(interval, 0.25, 0.01 * 0.25)
        self.assertEqual(list(r.percentiles), [0.5, 0.9, 0.95, 0.99])
        self.assertEqual((tuple(r.area_within(0.2)), tuple(r.area_within(0.3))), ((0, 0), (1, 1)))
        self.assertIs(r.survey_met, True)
        self.assertIn(0.25, r.mean)
        self.assertNotIn(0.3, r.mean)
        self.assertEqual(r.mean.estimate, r.mean.lower + (r.mean.upper - r.mean.lower) / 2)
        lower, upper = r.mean
        self.assertEqual(r.mean, (lower, upper))
        self.assertEqual(pickle.loads(pickle.dumps(r.mean)).estimate, r.mean.estimate)
        self.assertIs(r.percentiles[0.5].jump, False)
        self.assertAlmostEqual(r.survey.area, 1, places=6)
        self.assertIsNone(r.survey_back)
        self.assertIsNone(r.field_back)

    def test_a_wedge(self):
        r = vkh.distance(*WEDGE, *FLOOR, statistics=True, bands=(0.25, "0.5abs"))
        self.encloses(r.mean, 0.5, 0.01)
        self.encloses(r.rms, math.sqrt(1 / 3), 0.01)
        self.encloses(r.percentiles[0.95], 0.95, 0.02)
        self.encloses(r.area_within(0.25), 0.25, 0.002)
        self.encloses(r.area_within("0.5abs"), 0.5, 0.002)
        # No band, but between two points of the curve.
        for t in (0.111, 0.777, np.float32(0.6)):
            self.encloses(r.area_within(t), float(t), 0.05)
        self.assertEqual(tuple(r.area_within(float("inf"))), (1, 1))
        self.assertIsNone(r.field)

    def test_faces_are_in_their_order(self):
        roof = SQUARE + [[0, 0, 0.25], [0, 0, 0.25], [0, 0, 0.25], [0, 0, 0.5]], FACES
        field = vkh.distance(*roof, *FLOOR, field=True).field
        self.assertLess(field.upper[0], field.lower[1])

    def test_what_was_not_asked_is_none(self):
        r = vkh.distance(*LIFTED, *FLOOR)
        self.assertEqual((r.field, r.mean, r.rms, r.percentiles, r.survey_met, r.survey), 6 * (None,))
        with self.assertRaisesRegex(ValueError, r"^area_within\(\): ask for it with statistics=True"):
            r.area_within(0.1)
        r = vkh.distance(*LIFTED, *FLOOR, field="0.01abs")
        self.assertLessEqual((r.field.upper - r.field.lower).max(), 0.01)
        self.assertIsNone(r.mean)
        with self.assertRaisesRegex(ValueError, r"^area_within\(\): ask for it"):
            r.area_within(0.1)

    def test_symmetric(self):
        r = vkh.distance(*LIFTED, *FLOOR, symmetric=True, field=1e-3, statistics=True)
        self.encloses((r.field.lower.max(), r.field.upper.max()), 0.25, 2e-3)
        self.assertEqual(len(r.field_back), 2)
        self.assertGreater(r.field_back.lower.max(), 1.5)  # the floor reaches farther
        self.assertGreater(r.survey_back.mean.lower, r.survey.mean.upper)

    def test_of_a_solver(self):
        with vkh.Solver(*FLOOR) as solver:
            r = solver.distance(*WEDGE, **ALL)
        self.encloses(r.mean, 0.5, 0.01)
        self.encloses(r.area_within(0.25), 0.25, 0.002)

    def test_time_ends_what_is_not_met(self):
        pair = (*grid(8, 0.1), *grid(6, 0))
        r = vkh.distance(*pair, field=1e-9, statistics=True, survey_time=0)
        self.assertEqual((r.survey_met, r.survey.ended), (False, "time"))
        self.assertIn("not met", repr(r.survey))
        self.assertTrue(r.field.lower.max() <= r.upper <= r.field.upper.max())
        for keywords in (dict(time=0), dict(waves=0), dict(progress=lambda *_: False)):  # a search that hardly began
            r = vkh.distance(*pair, field=True, **keywords)
            self.assertEqual(len(r.field), len(pair[1]))
            self.assertTrue((r.field.upper <= r.survey.upper).all() or r.survey.upper <= r.field.upper.max())

    def test_an_effort_ends_what_is_not_met(self):
        pair = (*grid(8, 0.1), *grid(6, 0))
        runs = [vkh.distance(*pair, field=1e-9, statistics=True, effort=1001).survey for _ in range(2)]
        for survey in runs:
            self.assertEqual((survey.ended, survey.met, survey.stats["effort"], survey.stats["bounded"]), ("effort", False, 1001, 128 + 1000))
        plain = [survey.to_dict() for survey in runs]
        for one in plain:
            del one["stats"]
        self.assertEqual(*plain)
        self.assertEqual(vkh.distance(*LIFTED, *FLOOR, field=True).survey.ended, "met")

    def test_keyboard_interrupt(self):
        pair = (*grid(20, 0.1), *grid(15, 0))
        vkh.distance(*pair, field=True, survey_time=0)  # pipelines
        timer = threading.Timer(1, lambda: os.kill(os.getpid(), signal.SIGINT))
        started = time.monotonic()
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(1000):
                vkh.distance(*pair, field=1e-12, survey_time=60)
        self.assertLess(time.monotonic() - started, 30)
        self.assertTrue(vkh.distance(*WEDGE, *FLOOR, **ALL).survey_met)  # as good as new


class Gates(unittest.TestCase):
    def test_a_share_of_area(self):
        for area, verdict in ((0.49, "pass"), ("51%", "fail"), (0.5, "undecided")):
            r = vkh.gate(WEDGE, FLOOR, max=0.5, area=area, effort=2000)
            self.assertEqual(r.verdict, verdict)
            self.assertIn(0.5, r.area_within(0.5))
            self.assertEqual(r.stats["max"], 0.5)
        vkh.assert_within(WEDGE, FLOOR, "0.5abs", area=0.49)
        with self.assertRaisesRegex(AssertionError, r"^FAIL: at most 0\.5\d* of A's area is within 0\.5 of B; 0\.9 was asked$"):
            vkh.assert_within(WEDGE, FLOOR, 0.5, area=0.9)
        with self.assertRaisesRegex(AssertionError, "^UNDECIDED: from 0.4"):
            vkh.assert_within(WEDGE, FLOOR, 0.5, area=0.5, survey_time=0.5)

    def test_both_directions(self):
        self.assertEqual(vkh.gate(LIFTED, FLOOR, 0.3, area=0.9).verdict, "pass")
        self.assertEqual(vkh.gate(LIFTED, FLOOR, 0.3, area=0.9, symmetric=True).verdict, "fail")
        self.assertEqual(vkh.gate(LIFTED, FLOOR, 3, area=0.9, symmetric=True).verdict, "pass")
        with self.assertRaisesRegex(AssertionError, "^FAIL: at most .* of B's area is within 0.3 of A"):
            vkh.assert_within(LIFTED, FLOOR, 0.3, area=0.9, symmetric=True)

    def test_beside_a_limit(self):
        r = vkh.gate(WEDGE, FLOOR, 0.6, field=True, statistics=True, symmetric=True)
        self.assertEqual(r.verdict, "fail")
        self.assertTrue((r.field.lower > 0.6).all())
        self.assertAlmostEqual(r.area_within(0.6).upper, 0.6, delta=0.01)
        self.assertEqual(len(r.field_back), 2)
        r = vkh.gate(WEDGE, FLOOR, [1.1, 1.2], field=True)
        self.assertEqual((r.verdict, len(r.field)), ("pass", 2))
        for wrong in (dict(area=0.5), dict(area="50%", statistics=True)):
            with self.assertRaisesRegex(ValueError, "^area: faces with limits of their own"):
                vkh.gate(WEDGE, FLOOR, [1.1, 1.2], **wrong)


class Values(unittest.TestCase):
    def test_round_trips(self):
        for keywords in ({}, ALL, dict(symmetric=True, **ALL), dict(bands=["10%"])):
            r = vkh.distance(*WEDGE, *FLOOR, **keywords)
            for other in (pickle.loads(pickle.dumps(r)), copy.deepcopy(r), copy.copy(r)):
                self.assertEqual(other, r)
                self.assertEqual(hash(other), hash(r))
                self.assertEqual((other.stats, repr(other), other.witness_a), (r.stats, repr(r), r.witness_a))
                self.assertEqual((other.field, other.survey_back), (r.field, r.survey_back))
            self.assertEqual(json.loads(json.dumps(r.to_dict()))["lower"], r.lower)
        gate = vkh.gate(WEDGE, FLOOR, 0.1)
        self.assertEqual(pickle.loads(pickle.dumps(gate)).verdict, "fail")
        self.assertNotEqual(gate, vkh.distance(*WEDGE, *FLOOR))
        self.assertNotEqual(gate, 1)
        for wrong in ((), (1, 2), tuple("abcdefghi"), (0, 1, "nonesuch", None, *5 * (None,))):
            with self.assertRaises(ValueError):
                vkh.Result.__new__(vkh.Result).__setstate__(wrong)

    def test_pickles_of_older_versions(self):
        """What a Result has pickled since 0.3.0: its parts in this order."""
        places = (3, (0.5, 0.5, 0.0), (1.0, 2.0, 3.0)), (4, (1.0, 0.0, 0.0), (1.0, 2.0, 2.5))
        old = vkh.Result.__new__(vkh.Result)
        old.__setstate__((0.25, 0.5, "time", "undecided", *places, None, None, {"gap": 0.1, "direction": "b_to_a"}, 7, "one", None, []))
        self.assertEqual((old.lower, old.upper, old.status, old.verdict, old.gap), (0.25, 0.5, "time", "undecided", 0.1))
        self.assertEqual((old.face_a, old.witness_a, old.face_b, old.witness_b), (3, places[0][2], 4, places[1][2]))
        self.assertEqual(old.witness, ("b", *places[1], 3, places[0][2]))
        self.assertEqual((old.index, old.id, old.error, old.survey, old.figures), (7, "one", None, None, None))
        self.assertEqual(old.__reduce_ex__(2)[2], old.__getstate__())

    def test_fields_are_read_only(self):
        field = vkh.distance(*WEDGE, *FLOOR, field=True).field
        for one in (field, pickle.loads(pickle.dumps(field)), copy.deepcopy(field)):
            with self.assertRaises(ValueError):
                one.lower[0] = 0
            with self.assertRaises(AttributeError):
                one.lower = 0
            self.assertEqual(one, field)
        self.assertNotEqual(field, vkh.Field(field.lower, field.upper + 1))
        self.assertEqual(repr(field), "<vkhausdorff.Field of 2 faces>")

    def test_dicts(self):
        d = vkh.distance(*WEDGE, *FLOOR, **ALL).to_dict()
        self.assertEqual(len(d["survey"]["field"]["lower"]), 2)
        statistics = d["survey"]["statistics"]
        self.assertEqual([band["distance"] for band in statistics["bands"]], [0.25, 0.5])
        self.assertLess(*statistics["mean"])

    def test_intervals(self):
        interval = vkh.distance(*WEDGE, *FLOOR, statistics=True).mean
        lower, upper = interval
        self.assertEqual((lower, upper), (interval.lower, interval.upper))
        self.assertEqual(repr(interval), f"Interval(lower={lower!r}, upper={upper!r})")
        self.assertEqual(interval, vkh.Interval(lower, upper))

    def test_saved(self):
        """The file has the mesh, and its bounds hold those of the field, rounded outward to float32."""
        r = vkh.distance(*WEDGE, *FLOOR, field=True, signed=True, symmetric=True)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "field.ply"
            for field, (vertices, faces) in ((r.field, WEDGE), (r.field_back, FLOOR), (r.signed.over_field, WEDGE)):
                field.save(file)
                mesh = vkh.read(file)
                np.testing.assert_array_equal(mesh.vertices, vertices)
                np.testing.assert_array_equal(mesh.faces, faces)
                lower, upper = self.bounds_in(file, len(vertices), len(faces))
                np.testing.assert_array_equal(lower <= field.lower, True)
                np.testing.assert_array_equal(field.upper <= upper, True)
                np.testing.assert_allclose(np.stack([lower, upper]), [field.lower, field.upper], rtol=1e-6, atol=1e-30)
            scene = pathlib.Path(folder) / "field.glb"
            r.field.save(str(scene), map="cividis")
            self.assertEqual(scene.read_bytes()[:4], b"glTF")
            self.assertEqual(len(vkh.read(scene).faces), 2)

    def bounds_in(self, file, vertices, faces):
        row = np.dtype([("count", "u1"), ("corners", "<i4", 3), ("bounds", "<f4", 3), ("colour", "u1", 3)])
        at = file.read_bytes().split(b"end_header\n", 1)[1][vertices * (3 * 8 + 4 + 3):]
        bounds = np.frombuffer(at, row, faces)["bounds"].astype(np.float64)
        return bounds[:, 0], bounds[:, 1]

    def test_what_is_saved_is_what_was_measured(self):
        """A placed mesh as it was placed; without its mesh a Field needs one."""
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "field.ply"
            move = np.eye(4)
            move[2, 3] = 0.5
            vkh.distance(*LIFTED, *FLOOR, field=True, transform=move).field.save(file)
            np.testing.assert_array_equal(vkh.read(file).vertices, LIFTED[0] + [0, 0, 0.5])
            for r in vkh.distances([(LIFTED, FLOOR)], field=True):
                r.field.save(file)
                np.testing.assert_array_equal(vkh.read(file).vertices, LIFTED[0])
            alone = pickle.loads(pickle.dumps(r.field))
            self.assertEqual(alone, r.field)
            for field in (alone, vkh.Field([0, 0], [1, 1])):
                with self.assertRaisesRegex(ValueError, "^mesh: give the one that was measured"):
                    field.save(file)
                field.save(file, LIFTED)
            for wrong, kind, why in (("a.obj", ValueError, "path: expected the path of a file that ends in .ply or .glb, not 'a.obj'"),
                                     (5, TypeError, "path: expected the path of a file that ends in .ply or .glb, not 5")):
                with self.assertRaisesRegex(kind, f"^{why}"):
                    r.field.save(wrong)
            with self.assertRaisesRegex(ValueError, "^map"):
                r.field.save(file, map="red")
            with self.assertRaisesRegex(ValueError, "^mesh: expected 2 faces, as the field has, not 1"):
                r.field.save(file, (LIFTED[0], FACES[:1]))
            mesh = vkh.read(file)
            with self.assertRaises(ValueError):  # the file that was measured is not overwritten
                vkh.distance(mesh, FLOOR, field=True).field.save(file)

    @unittest.skipIf(PROGRAM is None, "no program was named")
    def test_the_program_says_the_same(self):
        """The results if no clock ends anything, to the last bit."""
        meshes = grid(6, 0.1), grid(5, 0)
        with tempfile.TemporaryDirectory() as folder:
            files = [pathlib.Path(folder) / name for name in ("a.obj", "b.obj")]
            for file, (vertices, faces) in zip(files, meshes):
                file.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist()) +
                                "".join(f"f {a} {b} {c}\n" for a, b, c in (faces + 1).tolist()))
            done = subprocess.run([PROGRAM, "distance", *files, "--json", "--stats", "--bands", "0.05abs,0.1abs", "--field-tol",
                                   "1%", "--symmetric"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        directions = json.loads(done.stdout)["directions"]
        r = vkh.distance(*meshes[0], *meshes[1], symmetric=True, field="1%", statistics=True, bands=("0.05abs", "0.1abs"))
        self.assertTrue(r.survey_met)
        for said, survey in zip(directions, (r.survey, r.survey_back)):
            self.check_statistics(said["statistics"], survey)
            self.assertEqual(said["field"]["faces"], len(survey.field))
            self.assertEqual(said["field"]["width"], (survey.field.upper - survey.field.lower).max())

    def check_statistics(self, said, survey):
        def interval(json_object):
            return tuple(float.fromhex(json_object[name]) for name in ("lower_hex", "upper_hex"))

        self.assertEqual(said["area"], survey.area)
        self.assertEqual(interval(said["mean"]), tuple(survey.mean))
        self.assertEqual(interval(said["rms"]), tuple(survey.rms))
        self.assertEqual([(p["share"], interval(p["distance"])) for p in said["percentiles"]], list(survey.percentiles.items()))
        self.assertEqual([(b["distance"], interval(b["share"])) for b in said["curve"]], survey.curve)
        for band, mine in zip(said["bands"], survey.bands.values()):
            self.assertEqual(interval(band["share"]), tuple(mine))

    def test_the_example(self):
        done = subprocess.run([sys.executable, pathlib.Path(__file__).resolve().parents[1] / "package/field_example.py"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(done.stdout.endswith("Interval(lower=1.0, upper=1.0)\npass\n"), done.stdout)


class Refusals(unittest.TestCase):
    def test_arguments(self):
        values = {"field": [0, -1.0, float("nan"), float("inf"), "0.1mm", "x", ""],
                  "bands": [[0], [-1], [float("nan")], ["0.1"], ["0.1mm"], [10**400], (0.1, "x")],
                  "survey_time": [-1, float("nan")], "effort": [-1]}
        types = {"field": [None, [1], 1j, b"1"], "statistics": [1, None, "yes"], "survey_time": ["5", True, [1]], "effort": ["5", 0.5, [1]],
                 "bands": [None, 0.1, "0.1abs", {0.1}, [None], [True], [[0.1]], np.zeros((2, 2)), object()]}
        with vkh.Solver(*FLOOR) as solver:
            for kind, cases in ((ValueError, values), (TypeError, types)):
                for name, value in ((name, value) for name, wrong in cases.items() for value in wrong):
                    with self.subTest(name=name, value=value):
                        for call in (lambda **k: vkh.distance(*LIFTED, *FLOOR, **k), lambda **k: vkh.gate(LIFTED, FLOOR, 1, **k),
                                     lambda **k: solver.distance(*LIFTED, **k)):
                            with self.assertRaisesRegex(kind, f"^{name}: expected "):
                                call(**{name: value})
        for wrong, kind in ((0, ValueError), (1.1, ValueError), ("0.9", ValueError), ("101%", ValueError), (True, TypeError),
                            ([0.5], TypeError)):
            with self.assertRaisesRegex(kind, "^area: expected a share of the area"):
                vkh.gate(LIFTED, FLOOR, 0.3, area=wrong)
        with self.assertRaisesRegex(TypeError, "no argument 'area'"):
            vkh.distance(*LIFTED, *FLOOR, area=0.5)
        right = vkh.distance(*LIFTED, *FLOOR, field=np.bool_(True), bands=np.array([0.1, 0.3], np.float32), survey_time=None)
        self.assertEqual(tuple(right.area_within(np.float32(0.3))), (1, 1))

    def test_distances(self):
        r = vkh.distance(*LIFTED, *FLOOR, bands=("0.1abs", 0.3))
        for wrong, kind in ((-1, ValueError), (float("nan"), ValueError), (None, TypeError), ([1], TypeError), (True, TypeError)):
            with self.assertRaisesRegex(kind, "^distance: expected a number, 0 or more"):
                r.area_within(wrong)
        with self.assertRaisesRegex(ValueError, "^distance: '20%' is not one of bands, which are '0.1abs', 0.3$"):
            r.area_within("20%")


if __name__ == "__main__":
    unittest.main()
