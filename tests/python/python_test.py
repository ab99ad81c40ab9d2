#!/usr/bin/env python3
"""The Python module: its accepted and refused inputs, its answers, and the ways to end a run. Run
through ctest."""
import importlib.util
import inspect
import itertools
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
import unittest

import numpy as np
import vkhausdorff as vkh
from python_shapes import SQUARE, SQUARE_FACES, grid


class Answers(unittest.TestCase):
    def test_closed_form(self):
        r = vkh.distance(SQUARE + [0, 0, 0.25], SQUARE_FACES, SQUARE, SQUARE_FACES)
        self.assertLessEqual(r.lower, 0.25)
        self.assertGreaterEqual(r.upper, 0.25)
        self.assertLess(r.upper - r.lower, 1e-6 * np.sqrt(2))
        self.assertIs(r.closed, True)
        self.assertEqual(r.status, "closed")
        self.assertAlmostEqual(r.witness_a[2], 0.25)
        self.assertAlmostEqual(r.witness_b[2], 0.0)
        self.assertIn(r.face_a, (0, 1))
        self.assertIn(r.face_b, (0, 1))
        self.assertIn("closed", repr(r))

    def test_float64_is_not_rounded_to_float32(self):
        # 1 + 2^-28 is no float32: rounded, the distance would be 0 or 1.2e-7.
        height = 2.0**-28
        lifted = SQUARE + [0, 0, 1 + height]
        r = vkh.distance(lifted, SQUARE_FACES, SQUARE + [0, 0, 1], SQUARE_FACES, tol="1e-12abs")
        self.assertLessEqual(r.lower, height)
        self.assertGreaterEqual(r.upper, height)
        self.assertGreater(r.lower, 0.99 * height)
        self.assertLess(r.upper, 1.01 * height)

    def test_every_accepted_type_gives_the_same_answer(self):
        va, fa = grid(6)
        vb, fb = grid(3)
        va, vb = va.astype(np.float32), vb.astype(np.float32)
        expected = vkh.distance(va, fa, vb, fb)
        index_types = (np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64, ">i4")
        for float_type, index_type in zip(itertools.cycle((np.float32, np.float64, ">f4", ">f8")), index_types):
            r = vkh.distance(va.astype(float_type), fa.astype(index_type), vb, fb)
            self.assertEqual((r.lower, r.upper), (expected.lower, expected.upper))
        for other in (np.asfortranarray(va), np.repeat(va, 2, axis=0)[::2], np.hstack([va, va])[:, :3], va.tolist()):
            r = vkh.distance(other, fa.tolist(), vb, np.asfortranarray(fb))
            self.assertEqual((r.lower, r.upper), (expected.lower, expected.upper))

    def test_arrays_are_left_alone(self):
        va, fa = grid(4)
        va.setflags(write=False)
        before = va.copy()
        vkh.distance(va, fa, SQUARE, SQUARE_FACES)
        self.assertTrue((va == before).all())

    def test_symmetric(self):
        small, large = SQUARE, 2 * SQUARE
        for first, second, way in ((small, large, "b_to_a"), (large, small, "a_to_b")):
            r = vkh.distance(first, SQUARE_FACES, second, SQUARE_FACES, tol=1e-5, symmetric=True)
            self.assertTrue(r.closed)
            self.assertLessEqual(r.lower, np.sqrt(2))
            self.assertGreaterEqual(r.upper, np.sqrt(2))
            self.assertEqual(r.stats["direction"], way)
            on_large = r.witness_b if way == "b_to_a" else r.witness_a
            self.assertEqual(on_large, (2.0, 2.0, 0.0))

    def test_tolerances(self):
        va, fa = grid(8)
        vb, fb = grid(3)
        diagonal = vkh.distance(va, fa, vb, fb).stats["diagonal_a"]
        for tol, absolute in ((1e-3, 1e-3 * diagonal), ("0.1%", 1e-3 * diagonal), ("0.01abs", 0.01)):
            r = vkh.distance(va, fa, vb, fb, tol=tol)
            self.assertAlmostEqual(r.stats["tolerance"], absolute, places=12)
            self.assertLessEqual(r.upper - r.lower, absolute)

    def test_stats(self):
        va, fa = grid(8)
        va = np.vstack([va, [[9, 9, np.nan]]])  # no face uses it, so it is not part of the mesh
        stats = vkh.distance(va, fa, *grid(3), disable=["thin"]).stats
        self.assertEqual(stats["mesh_a"]["faces"], 128)
        self.assertEqual(stats["mesh_a"]["unreferenced"], 1)
        self.assertIn("thin", stats["switched_off"])
        self.assertEqual(stats["preset"], "default")
        stats = vkh.distance(va, fa, *grid(3), preset="baseline-gpu", enable=["thin"]).stats
        self.assertEqual(stats["preset"], "baseline-gpu")
        self.assertEqual(stats["switched_on"], ["thin", "u4", "u3_paper"])
        self.assertTrue(stats["device"]["name"])
        self.assertGreater(stats["waves"], 0)
        self.assertGreater(stats["hierarchy_ms"], 0)


class Values(unittest.TestCase):
    """What is made of a result's other values."""

    def test_gap_interval_and_witness(self):
        va, fa = grid(12)
        vb, fb = grid(5)
        for r in (vkh.distance(va, fa, vb, fb), vkh.distance(va, fa, vb, fb, symmetric=True),
                  vkh.distance(vb, fb, va, fa, symmetric=True)):
            self.assertEqual(r.interval, (r.lower, r.upper))
            self.assertGreaterEqual(r.gap * np.linalg.norm(np.ptp(va, axis=0)), (r.upper - r.lower) * (1 - 1e-12))
            mesh = {"a": (va, fa), "b": (vb, fb)} if len(fa) == r.stats["mesh_a"]["faces"] else {"a": (vb, fb), "b": (va, fa)}
            w = r.witness
            self.assertAlmostEqual(sum(w.barycentric), 1.0, places=12)
            vertices, faces = mesh[w.mesh]
            at = np.array(w.barycentric) @ vertices[faces[w.face]]
            np.testing.assert_allclose(at, w.point, atol=1e-12)
            self.assertEqual((w.point, w.nearest), (r.witness_a, r.witness_b) if w.mesh == "a" else (r.witness_b, r.witness_a))

    def test_a_row_and_a_table(self):
        r = vkh.gate((SQUARE, SQUARE_FACES), (SQUARE + [3, 0, 0], SQUARE_FACES), max=0.5, statistics=True)
        html = r._repr_html_()
        self.assertIn("<th>verdict</th><td>fail</td>", html)
        self.assertIn("p95_upper", html)
        self.assertEqual([note["code"] for note in r.notes], ["apart"])
        self.assertEqual(r.notes[0]["value"], 3.0)

    def test_a_frame_is_one_row(self):
        r = vkh.distance(SQUARE, SQUARE_FACES, SQUARE + [3, 0, 0], SQUARE_FACES, statistics=True)
        if importlib.util.find_spec("pandas") is None:
            self.skipTest("no pandas here")
        frame = r.to_frame()
        self.assertEqual(len(frame), 1)
        self.assertEqual((frame["lower"][0], frame["mean_upper"][0]), (r.lower, r.mean.upper))

    def test_stats_have_one_schema(self):
        def schema(value):
            return {key: schema(v) for key, v in value.items()} if isinstance(value, dict) else type(value)

        va, fa = grid(12)
        vb, fb = grid(5, 0.2)
        one = vkh.distance(va, fa, vb, fb).stats
        both = vkh.distance(va, fa, vb, fb, symmetric=True).stats
        self.assertEqual(schema({**one, "b_to_a": None}), schema({**both, "b_to_a": None}))
        self.assertEqual(schema(both["a_to_b"]), schema(both["b_to_a"]))
        self.assertEqual(set(both) - set(both["a_to_b"]), {"direction", "a_to_b", "b_to_a"})
        self.assertIsNone(one["b_to_a"])
        self.assertEqual({key: one[key] for key in one["a_to_b"]}, one["a_to_b"])
        for name in ("waves", "candidates", "queries", "wall_ms"):
            self.assertEqual(both[name], both["a_to_b"][name] + both["b_to_a"][name])
        for name in ("lower", "upper"):
            self.assertEqual(both[name], max(both["a_to_b"][name], both["b_to_a"][name]))
        self.assertEqual(both["mesh_a"]["faces"], len(fa))
        self.assertEqual(both["b_to_a"]["mesh_a"]["faces"], len(fb))

    def test_notes_say_what_a_pass_does_not_ask(self):
        half = (SQUARE * [0.5, 1, 1], SQUARE_FACES)
        whole = (SQUARE, SQUARE_FACES)
        r = vkh.gate(half, whole, max=0.1)
        self.assertEqual(r.verdict, "pass")
        self.assertEqual([note["code"] for note in r.notes], ["size", "apart", "one-way"])
        self.assertEqual(vkh.gate(half, whole, max=0.1, symmetric=True).verdict, "fail")
        self.assertEqual(vkh.gate(whole, whole, max=0.1, symmetric=True).notes, [])

    def test_devices(self):
        found = vkh.devices()
        self.assertTrue(found)
        usable = next(d for d in found if d["usable"])
        r = vkh.distance(SQUARE, SQUARE_FACES, SQUARE, SQUARE_FACES, device=usable["index"])
        self.assertEqual(r.stats["device"]["name"], usable["name"])
        with self.assertRaisesRegex(TypeError, "device: expected"):
            vkh.distance(SQUARE, SQUARE_FACES, SQUARE, SQUARE_FACES, device=1.5)


class Solvers(unittest.TestCase):
    def test_b_is_kept(self):
        vb, fb = grid(6)
        with vkh.Solver(vb, fb) as solver:
            vb[:] = 0  # copied, not kept
            for cells in (3, 5, 12):
                va, fa = grid(cells, height=0.125)
                r = solver.distance(va, fa)
                plain = vkh.distance(va, fa, *grid(6))
                self.assertTrue(r.closed)
                self.assertLessEqual(r.lower, plain.upper)
                self.assertGreaterEqual(r.upper, plain.lower)
                self.assertEqual(r.stats["hierarchy_ms"], 0)
            far = solver.distance(SQUARE + [1e3, 0, 0], SQUARE_FACES)
            plain = vkh.distance(SQUARE + [1e3, 0, 0], SQUARE_FACES, *grid(6))
            self.assertEqual((far.lower, far.upper), (plain.lower, plain.upper))
        with self.assertRaisesRegex(ValueError, "closed"):
            solver.distance(SQUARE, SQUARE_FACES)
        solver.close()  # twice is fine

    def test_solvers_share_a_device(self):
        meshes = [grid(n, height=0.01 * n) for n in (5, 6, 7)]
        va, fa = grid(12, height=0.125)
        with vkh.Device() as device:
            self.assertIn(device.info["name"], repr(device))
            solvers = [vkh.Solver(b, device=device) for b in meshes]
            found = [s.distance(va, fa) for s in solvers]
            self.assertEqual(found, [vkh.Solver(b).distance(va, fa) for b in meshes])
            self.assertEqual(device.info, found[0].stats["device"])
            solvers[1].close()
            with self.assertRaisesRegex(ValueError, "this Solver is closed"):
                solvers[1].distance(va, fa)
            self.assertEqual([solvers[i].distance(va, fa) for i in (0, 2)], [found[0], found[2]])
            self.assertEqual(vkh.distance(va, fa, *meshes[0], device=device), vkh.distance(va, fa, *meshes[0]))
            self.assertEqual(vkh.gate((va, fa), meshes[0], 1, device=device).verdict, "pass")
            self.assertEqual(vkh.closest(meshes[0], va, device=device).upper.tolist(), solvers[0].closest(va).upper.tolist())
        for late in (lambda: solvers[0].distance(va, fa), lambda: vkh.distance(va, fa, va, fa, device=device),
                     lambda: vkh.Solver(va, fa, device=device), lambda: solvers[2].closest(va)):
            with self.assertRaisesRegex(ValueError, "this Device is closed"):
                late()
        device.close()  # twice is fine
        solvers[0].close()

    def test_devices_are_chosen_as_everywhere(self):
        usable = next(d for d in vkh.devices() if d["usable"])
        for chosen in ("", usable["index"], usable["name"][:6]):
            with vkh.Device(chosen) as device:
                self.assertEqual(device.info["name"], usable["name"])
        with self.assertRaisesRegex(TypeError, "^device: expected"):
            vkh.Device(1.5)
        with self.assertRaisesRegex(TypeError, "no argument 'gpu'"):
            vkh.Device(gpu=0)
        with self.assertRaises(vkh.DeviceError):
            vkh.Device("no such device")

    def test_threads_share_one(self):
        vb, fb = grid(6)
        va, fa = grid(12, height=0.125)
        answers = []
        with vkh.Solver(vb, fb) as solver:
            expected = solver.distance(va, fa)
            threads = [threading.Thread(target=lambda: answers.append(solver.distance(va, fa))) for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        self.assertEqual([(r.lower, r.upper) for r in answers], 4 * [(expected.lower, expected.upper)])


class Refusals(unittest.TestCase):
    def refused(self, expected, va=SQUARE, fa=SQUARE_FACES, vb=SQUARE, fb=SQUARE_FACES, **keywords):
        with self.assertRaisesRegex(ValueError, expected):
            vkh.distance(va, fa, vb, fb, **keywords)

    def test_vertices(self):
        shape = r"A's vertices: an array of shape .*; expected an array of shape \(n, 3\) of float32, float64 or integers"
        hint = r" \(points of a plane: add a column of zeros\)$"
        self.refused(shape + hint, va=SQUARE[:, :2])
        shape += "$"
        self.refused(shape, va=SQUARE.ravel())
        self.refused(shape, va=SQUARE[None])
        self.refused(shape, va="abc")
        self.refused(r"A's vertices: None; expected an array of shape \(n, 3\)", va=None)
        kind = r"an array of {}; expected an array of shape \(n, 3\) of float32, float64 or integers"
        self.refused("A's vertices: " + kind.format("float16"), va=SQUARE.astype(np.float16))
        self.refused("B's vertices: " + kind.format("bool"), vb=SQUARE.astype(bool))
        self.refused("A's vertices: " + kind.format("complex128"), va=SQUARE.astype(complex))
        self.refused("A's vertices: " + kind.format("object"), va=SQUARE.astype(object))
        if np.dtype(np.longdouble).itemsize > 8:
            self.refused("A's vertices: " + kind.format("float128"), va=SQUARE.astype(np.longdouble))

    def test_integer_vertices_are_exact_or_refused(self):
        expected = vkh.distance(4 * SQUARE, SQUARE_FACES, SQUARE, SQUARE_FACES)
        for kind in (np.int8, np.uint8, np.int32, np.uint64, ">i8"):
            r = vkh.distance((4 * SQUARE).astype(kind), SQUARE_FACES, SQUARE.astype(kind).tolist(), SQUARE_FACES)
            self.assertEqual((r.lower, r.upper), (expected.lower, expected.upper))
        large = np.array([[0, 0, 0], [2**53, 0, 0], [0, -(2**53), 0]])
        faces = np.array([[0, 1, 2]])
        exact = vkh.distance(large, faces, large.astype(float), faces)
        self.assertEqual(exact.lower, 0)
        rule = "expected integers of at most 2\\^53, which float64 has exactly"
        for value in (2**53 + 1, -(2**53) - 1, 2**63 - 1, -(2**63)):
            vertices = large.copy()
            vertices[2, 1] = value
            self.refused(f"A's vertices: vertex 2 has {value}; {rule}", va=vertices, fa=faces)
        huge = large[:2].astype(np.uint64)
        huge[1, 2] = 2**64 - 1
        self.refused(f"B's vertices: vertex 1 has {2**64 - 1}; {rule}", vb=huge, fb=faces)

    def test_coordinates(self):
        for bad in (np.nan, np.inf, -np.inf):
            vertices = SQUARE.copy()
            vertices[2, 1] = bad
            self.refused(r"B: vertex 2: .* is not finite; expected finite coordinates", vb=vertices)

    def test_faces(self):
        expected = r"expected an array of shape \(m, 3\) of integers"
        self.refused(r"A's faces: an array of shape \(2, 2\); " + expected, fa=SQUARE_FACES[:, :2])
        self.refused("A's faces: an array of float64; " + expected, fa=SQUARE_FACES.astype(float))
        self.refused("A's faces: an array of bool; " + expected, fa=SQUARE_FACES.astype(bool))
        self.refused("B: face 0: there is no face; expected at least one", fb=SQUARE_FACES[:0])
        for index in (4, -1, 2**32, 2**40):
            faces = SQUARE_FACES.copy()
            faces[1, 2] = index
            self.refused(f"A's faces: face 1 has index {index}; expected indices below 4", fa=faces)
        huge = SQUARE_FACES.astype(np.uint64)
        huge[0, 0] = 2**63 + 1
        self.refused("face 0 has index 9223372036854775809; expected indices below 4", fa=huge)

    def wrong(self, kind, expected, call):
        """One line in the caller's words: no options of the program, nothing of pybind11's, no arrays."""
        with self.assertRaises(kind) as caught:
            call()
        message = str(caught.exception)
        self.assertIs(type(caught.exception), kind, message)
        self.assertRegex(message, expected)
        for stranger in ("--", "pybind11", "PYBIND11", "\n", "array(", "instance"):
            self.assertNotIn(stranger, message)
        self.assertLess(len(message), 320)

    def test_scalars(self):
        array = np.zeros((50, 3))
        values = {
            "tol": [0.0, -1.0, float("nan"), float("inf"), 10**400, "2 furlongs", "", "x", "1e-400", "\ud800"],
            "time": [-1.0, float("nan"), -1],
            "waves": [-1, 2**32, 2**70],
            "memory": [0, -1, 2**64, "lots", "2 furlongs", ""],
            "device": ["\ud800"],
        }
        types = {
            "tol": [None, True, np.bool_(True), [1e-6], array, 1j, b"1"],
            "symmetric": ["no", None, 1, array],
            "time": ["5", True, [1], array, object()],
            "waves": [1.5, "3", True, array, float("nan")],
            "memory": [1.5, True, [1], array],
            "device": [1.5, None, True, array, b"cpu"],
            "preset": [None, 1, array],
            "disable": ["u3", 3, None, [3], {"u3": 1}, array],
            "enable": ["u3", 3, None, [None]],
            "progress": [3, "print", array],
        }
        solver = vkh.Solver(SQUARE, SQUARE_FACES)
        for kind, cases in ((ValueError, values), (TypeError, types)):
            for name, wrong in cases.items():
                for value in wrong:
                    with self.subTest(name=name, value=value):
                        keywords = {name: value}
                        self.wrong(kind, f"^{name}[: ].*expected ",
                                   lambda: vkh.distance(SQUARE, SQUARE_FACES, SQUARE, SQUARE_FACES, **keywords))
                        if name == "device":
                            self.wrong(kind, "^device: expected", lambda: vkh.Solver(SQUARE, SQUARE_FACES, **keywords))
                        elif name != "symmetric":
                            self.wrong(kind, f"^{name}[: ].*expected ",
                                       lambda: solver.distance(SQUARE, SQUARE_FACES, **keywords))
        right = dict(tol=np.float32(1e-3), time=np.int64(5), waves=np.uint8(200), memory=np.int32(1 << 20),
                     symmetric=np.bool_(True), progress=None, disable={"u3"}, enable=(), preset="")
        self.assertTrue(vkh.distance(SQUARE, SQUARE_FACES, SQUARE, SQUARE_FACES, **right).closed)
        self.assertTrue(vkh.distance(SQUARE, SQUARE_FACES, SQUARE, SQUARE_FACES, 1, time=None, waves=None, memory=None).closed)
        self.assertTrue(vkh.distance(va=SQUARE, fa=SQUARE_FACES, vb=SQUARE, fb=SQUARE_FACES, time=float("inf")).closed)

    def test_calls(self):
        four = (SQUARE, SQUARE_FACES, SQUARE, SQUARE_FACES)
        self.wrong(TypeError, "needs va, fa, vb, fb; 'vb' is missing", lambda: vkh.distance(*four[:2]))
        self.wrong(TypeError, "needs vb, fb; 'vb' is missing", lambda: vkh.Solver())
        self.wrong(TypeError, "has no argument 'tolerance'; did you mean tol. it takes va,", lambda: vkh.distance(*four, tolerance=1))
        self.wrong(TypeError, "'va' was given twice", lambda: vkh.distance(*four, va=SQUARE))
        self.wrong(TypeError, "by position and the rest by name; 7 were", lambda: vkh.distance(*four, 1e-6, False, "cpu"))
        solver = vkh.Solver(*four[:2])
        self.wrong(TypeError, "has no argument 'symmetric'", lambda: solver.distance(*four[:2], symmetric=True))
        self.wrong(TypeError, "cannot create|No constructor", lambda: vkh.Result())
        self.assertTrue(str(inspect.signature(vkh.distance)).startswith("(va, fa, vb, fb, tol=1e-06"))

    def test_names(self):
        self.refused("'u9'", disable=["u9"])
        self.refused("'u9'", enable=["u9"])
        self.refused("preset: expected 'default', 'paper' or 'baseline-gpu', not 'pape'", preset="pape")
        with self.assertRaisesRegex(vkh.DeviceError, "no usable Vulkan device matches 'nonesuch'"):
            vkh.distance(SQUARE, SQUARE_FACES, SQUARE, SQUARE_FACES, device="nonesuch")
        self.assertTrue(issubclass(vkh.DeviceError, RuntimeError))


# Dense against coarse with little memory: many submissions, seconds on a CPU.
LONG = dict(tol=1e-7, memory=1 << 18, disable=["centroid", "parent_samples", "u3"])


class Endings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pair = (*grid(80), *grid(7))
        vkh.distance(SQUARE, SQUARE_FACES, SQUARE, SQUARE_FACES, waves=1, disable=LONG["disable"])  # pipelines

    def test_keyboard_interrupt(self):
        timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
        started = time.monotonic()
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(1000):
                vkh.distance(*self.pair, **LONG)
        self.assertLess(time.monotonic() - started, 30)
        self.assertTrue(vkh.distance(SQUARE, SQUARE_FACES, SQUARE, SQUARE_FACES).closed)  # as good as new

    def test_progress_cancels(self):
        seen = []

        def progress(wave, lower, upper):
            seen.append((wave, lower, upper))
            return len(seen) < 3

        r = vkh.distance(*self.pair, progress=progress, **LONG)
        self.assertEqual(r.status, "cancelled")
        self.assertFalse(r.closed)
        self.assertEqual(len(seen), 3)
        for _, lower, upper in seen:  # that both are true: workspace_test.cpp
            self.assertTrue(lower <= r.upper and r.lower <= upper)

    def test_progress_may_return_nothing_or_raise(self):
        calls = []
        self.assertNotEqual(vkh.distance(*self.pair, waves=4, progress=lambda *p: calls.append(p), **LONG).status, "cancelled")
        self.assertTrue(calls)

        def failing(wave, lower, upper):
            raise LookupError("enough")

        with self.assertRaisesRegex(LookupError, "enough"):
            vkh.distance(*self.pair, progress=failing, **LONG)

        def again(wave, lower, upper):
            vkh.distance(SQUARE, SQUARE_FACES, SQUARE, SQUARE_FACES)

        with self.assertRaisesRegex(RuntimeError, "progress callback"):
            vkh.distance(*self.pair, progress=again, **LONG)

    def test_budgets(self):
        for keywords, status in ((dict(waves=1), "waves"), (dict(time=0), "time")):
            r = vkh.distance(*self.pair, **keywords, **LONG)
            self.assertEqual((r.status, r.closed), (status, False))

    def test_other_threads_run_meanwhile(self):
        ticks = []
        stop = threading.Event()

        def tick():
            while not stop.is_set():
                ticks.append(time.monotonic())
                time.sleep(0.001)

        thread = threading.Thread(target=tick)
        thread.start()
        # The solver never returns to Python here: with the GIL held there would be no tick.
        started = time.monotonic()
        vkh.distance(*self.pair, waves=2, tol=1e-7)
        ended = time.monotonic()
        stop.set()
        thread.join()
        inside = [t for t in ticks if started < t < ended]
        self.assertGreater(len(inside), (ended - started) / 0.05)


class Ending(unittest.TestCase):
    def test_a_program_that_just_ends_ends_well(self):
        tests = pathlib.Path(__file__).resolve().parents[1]
        example = subprocess.run([sys.executable, tests / "package" / "example.py"], capture_output=True, text=True)
        self.assertEqual(example.returncode, 0, example.stderr)
        self.assertEqual(example.stderr, "")
        self.assertEqual(example.stdout.count("closed"), 3)


if __name__ == "__main__":
    unittest.main()
