#!/usr/bin/env python3
"""on_progress(fraction, lower, upper): it never falls, never widens, and reaches 1 with the result, whatever is asked."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import vkhausdorff as vkh
from python_shapes import grid

A, B = grid(8, 0.05), grid(5)


class Heard(list):
    """A function for on_progress that keeps what it hears."""

    def __init__(self, most=None):
        self.most = most

    def __call__(self, fraction, lower, upper):
        self.append((fraction, lower, upper))
        return None if self.most is None else len(self) < self.most


class Progress(unittest.TestCase):
    def is_monotone(self, heard):
        fractions, lowers, uppers = zip(*heard)
        self.assertEqual(list(fractions), sorted(fractions))
        self.assertEqual(list(lowers), sorted(lowers))
        self.assertEqual(list(uppers), sorted(uppers, reverse=True))
        self.assertTrue(all(0 <= fraction <= 1 for fraction in fractions))

    def reaches_one(self, call):
        heard = Heard()
        r = call(heard)
        self.is_monotone(heard)
        self.assertEqual(heard[-1], (1.0, r.lower, r.upper))
        return heard, r

    def test_every_question(self):
        with tempfile.TemporaryDirectory() as folder:
            options = dict(plain={}, symmetric=dict(symmetric=True), field=dict(field=True), waves=dict(waves=2),
                           all=dict(symmetric=True, field="0.1%", statistics=True, signed=True, bands=(0.05,)), late=dict(time=0),
                           certificate=dict(certificate=pathlib.Path(folder) / "a.vhc", symmetric=True, statistics=True),
                           align=dict(align=True, statistics=True), placed=dict(transform=np.eye(4), max_distance=1, statistics=True))
            for name, asked in options.items():
                with self.subTest(name):
                    heard, r = self.reaches_one(lambda tell: vkh.distance(*A, *B, on_progress=tell, **asked))
                    alone = vkh.distance(*A, *B, **asked)
                    if name not in ("late", "waves"):
                        self.assertEqual(r, alone)

    def test_gates(self):
        faces = np.full(len(A[1]), 0.2)
        for limit, asked in ((0.2, {}), (0.01, {}), (0.01, dict(worst=True)), (0.01, dict(worst=True, symmetric=True)),
                             (faces, {}), (0.2, dict(area=0.5)), ("+0.2abs,-0.2abs", {})):
            with self.subTest(limit=np.ndim(limit), **asked):
                _, r = self.reaches_one(lambda tell: vkh.gate(A, B, limit, on_progress=tell, **asked))
                self.assertEqual(r.verdict, "fail" if np.ndim(limit) == 0 and limit == 0.01 else "pass")

    def test_a_solver(self):
        with vkh.Solver(B) as solver:
            self.reaches_one(lambda tell: solver.distance(A, statistics=True, on_progress=tell))

    def test_metrics(self):
        self.reaches_one(lambda tell: vkh.metrics(A, B, on_progress=tell).result)

    def test_the_survey_is_heard(self):
        heard, _ = self.reaches_one(lambda tell: vkh.distance(*A, *B, field=1e-6, effort=5000, on_progress=tell))
        self.assertTrue([fraction for fraction, *_ in heard if 0.5 < fraction < 1], heard)

    def test_beside_progress(self):
        waves, heard = [], Heard()
        vkh.distance(*A, *B, tol=1e-9, progress=lambda *p: waves.append(p), on_progress=heard)
        self.assertGreaterEqual(len(heard), len(waves) + 1)
        self.assertTrue(waves)

    def test_it_cancels_and_then_hears_no_more(self):
        heard = Heard(most=1)
        r = vkh.distance(*A, *B, tol=1e-9, memory=1 << 18, on_progress=heard)
        self.assertEqual((r.status, len(heard)), ("cancelled", 1))
        exact = vkh.distance(*A, *B, tol=1e-9)
        self.assertTrue(r.lower <= exact.upper and exact.lower <= r.upper)

    def test_it_may_end_a_survey(self):
        at = []

        def tell(fraction, lower, upper):
            at.append(fraction)
            return fraction <= 0.5

        r = vkh.distance(*A, *B, field=1e-9, effort=10**9, on_progress=tell)
        self.assertEqual(r.status, "closed")
        self.assertEqual((r.survey.ended, r.survey_met), ("cancelled", False))
        self.assertLess(at[-1], 1)

    def test_what_it_raises_comes_through(self):
        def tell(fraction, lower, upper):
            raise LookupError("enough")

        for asked in ({}, dict(field=True)):
            with self.assertRaisesRegex(LookupError, "enough"):
                vkh.distance(*A, *B, on_progress=tell, **asked)
        with self.assertRaisesRegex(LookupError, "enough"):
            list(vkh.distances([(A, B)], on_progress=tell))
        self.assertTrue(vkh.distance(*A, *B).closed)

    def test_refusals(self):
        for call in (lambda: vkh.distance(*A, *B, on_progress=1), lambda: vkh.gate(A, B, 1, on_progress=1),
                     lambda: vkh.distances([], on_progress=1), lambda: vkh.Solver(B).distance(A, on_progress=1)):
            with self.assertRaisesRegex(TypeError, "^on_progress: expected a function of fraction, lower and upper, or None"):
                call()


class Many(unittest.TestCase):
    def test_it_counts_pairs(self):
        pairs = [(grid(n, 0.01 * n), B) for n in range(2, 9)] + [("gone.stl", B)]
        for given, first in ((pairs, 1 / len(pairs)), (iter(pairs), None)):
            heard = Heard()
            found = list(vkh.distances(given, field=True, ahead=2, on_progress=heard))
            fractions = [fraction for fraction, *_ in heard]
            self.assertEqual(fractions, sorted(fractions))
            self.assertEqual(fractions[-1], 1)
            if first is not None:
                self.assertEqual(fractions, [(i + 1) * first for i in range(len(pairs))])
            good = [r for r in found if r.error is None]
            self.assertEqual(len(good), len(pairs) - 1)
            self.assertEqual(heard[-1][1:], (max(r.lower for r in good), max(r.upper for r in good)))

    def test_to_one_mesh_and_in_a_with_statement(self):
        heard = Heard()
        parts = ((f"part {n}", grid(n, 0.01 * n)) for n in range(2, 4))
        with vkh.distances(parts, against=B, max=0.2, symmetric=True, align=True, on_progress=heard) as results:
            found = list(results)
        self.assertEqual((len(found), len(heard), heard[-1][0]), (2, 2, 1))
        self.assertEqual(heard[-1][1:], (max(r.lower for r in found), max(r.upper for r in found)))

    def test_no_pairs(self):
        heard = Heard()
        self.assertEqual(list(vkh.distances([], on_progress=heard)), [])
        self.assertEqual(heard, [(1.0, 0.0, 0.0)])

    def test_it_ends_the_rest(self):
        heard = Heard(most=3)
        self.assertEqual(len(list(vkh.distances([(A, B)] * 200, on_progress=heard))), 3)
        self.assertEqual(len(heard), 3)

    def test_pairs_that_raise_never_reach_one(self):
        def some():
            yield A, B
            raise LookupError("no more")

        heard = Heard()
        with self.assertRaisesRegex(LookupError, "no more"):
            list(vkh.distances(some(), on_progress=heard))
        self.assertEqual([fraction for fraction, *_ in heard], [0.0])


class Example(unittest.TestCase):
    def test_the_example(self):
        example = pathlib.Path(__file__).resolve().parents[1] / "package/device_example.py"
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-B", example], capture_output=True, text=True, cwd=folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(done.stdout.count("100 %"), 2)
            self.assertEqual(sorted(p.name for p in pathlib.Path(folder).iterdir()), ["coarse.ply", "fine.ply"])


if __name__ == "__main__":
    unittest.main()
