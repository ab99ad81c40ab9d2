#!/usr/bin/env python3
"""Fits in the Python module: align(), and align=True of distance, gate, distances and a Solver."""
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import vkhausdorff as vkh


def posed(points, seed):
    rng = np.random.default_rng(seed)
    q = rng.normal(size=4)
    x, y, z, w = q / np.linalg.norm(q)
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    return points @ turn.T + rng.uniform(-50, 50, 3)


# No symmetry, and three faces that a fit cannot slide along. Other shapes: tests/solve/align_test.cpp.
POINTS = np.array([[0, 0, 0], [3, 0, 0], [0, 2, 0], [0.5, 0.25, 1]])
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])


class Fits(unittest.TestCase):
    def test_a_mesh_comes_back(self):
        moved = posed(POINTS, 1)
        fit = vkh.align((moved, FACES), (POINTS, FACES))
        back = moved @ fit.matrix[:3, :3].T + fit.matrix[:3, 3]
        self.assertLess(np.abs(back - POINTS).max(), 1e-9)
        self.assertEqual(fit.matrix[3].tolist(), [0, 0, 0, 1])
        self.assertLess(np.abs(fit.matrix[:3, :3].T @ fit.matrix[:3, :3] - np.eye(3)).max(), 1e-15)
        self.assertLess(fit.rms, 1e-9)
        self.assertGreater(fit.share, 0.9)
        self.assertEqual((fit.poor, fit.rival, fit.samples), (False, None, 40000))
        with self.assertRaises(ValueError):
            fit.matrix[0, 0] = 2
        self.assertIn("Alignment", repr(fit))
        again = pickle.loads(pickle.dumps(fit))
        self.assertTrue((again.matrix == fit.matrix).all())
        self.assertEqual((again.rms, again.share), (fit.rms, fit.share))
        self.assertEqual(again, fit)
        for other in (vkh.Alignment(np.eye(4), fit.rms, fit.share, fit.samples, fit.poor, None),
                      vkh.Alignment(fit.matrix, fit.rms, fit.share, fit.samples, fit.poor, 0.5), None):
            self.assertFalse(again == other)
        html = fit._repr_html_()
        self.assertIn(f"<th>samples</th><td>{fit.samples}</td>", html)
        self.assertIn(" ".join(map(repr, fit.matrix[0].tolist())), html)

    def test_align_of_distance_and_gate_is_transform_by_that_matrix(self):
        a, b = (posed(POINTS, 2), FACES), (POINTS, FACES)
        matrix = vkh.align(a, b).matrix
        apart = vkh.distance(a, b, transform=matrix)
        r = vkh.distance(*a, *b, align=True)
        self.assertEqual((r.lower, r.upper), (apart.lower, apart.upper))
        self.assertEqual(r.stats["transform"]["matrix"], matrix.tolist())
        self.assertIs(r.stats["transform"]["found"], True)
        self.assertIn("fit", [note["code"] for note in r.notes])
        self.assertIs(apart.stats["transform"]["found"], False)
        self.assertEqual(vkh.gate(a, b, 1e-3).verdict, "fail")
        vkh.assert_within(a, b, 1e-3, align=True)
        self.assertNotIn("transform", vkh.distance(b, b).stats)

    def test_a_solver_uses_the_mesh_that_it_has(self):
        a = (posed(POINTS, 3), FACES)
        with vkh.Solver(POINTS, FACES) as solver:
            r = solver.distance(a, align=True)
        self.assertLess(r.upper, 1e-4)
        self.assertEqual(r.stats["transform"]["matrix"], vkh.align(a, (POINTS, FACES)).matrix.tolist())

    def test_many(self):
        meshes = [(posed(POINTS, seed), FACES) for seed in range(4, 6)]
        for r in vkh.distances(meshes[:1], against=(POINTS, FACES), align=True, max=1e-3):
            self.assertEqual(r.verdict, "pass")
            self.assertIs(r.stats["transform"]["found"], True)
        pairs = [(mesh, (POINTS, FACES)) for mesh in meshes]
        results = list(vkh.distances(pairs, align=True, statistics=True))
        self.assertTrue(all(r.upper < 1e-4 and r.mean.upper < 1e-4 for r in results))

    def test_wrong_arguments(self):
        for call in (lambda: vkh.align((POINTS, FACES)), lambda: vkh.align((POINTS, FACES), 3),
                     lambda: vkh.distance((POINTS, FACES), (POINTS, FACES), align="yes")):
            with self.assertRaises(TypeError):
                call()

    def test_the_example(self):
        example = pathlib.Path(__file__).parent.parent / "package" / "align_example.py"
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "part.ply"), "w", encoding="ascii") as out:
                out.write(f"ply\nformat ascii 1.0\nelement vertex {len(POINTS)}\nproperty double x\nproperty double y\n"
                          f"property double z\nelement face {len(FACES)}\nproperty list uchar int vertex_indices\nend_header\n")
                out.write("".join("%r %r %r\n" % tuple(map(float, p)) for p in POINTS))
                out.write("".join("3 %d %d %d\n" % tuple(f) for f in FACES))
            done = subprocess.run([sys.executable, "-B", str(example)], capture_output=True, text=True, cwd=folder, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("pass [[", done.stdout)


if __name__ == "__main__":
    unittest.main()
