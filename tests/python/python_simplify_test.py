#!/usr/bin/env python3
"""simplify() in the Python module: what it returns passes gate(), and says what it could not do. How far it gets: tests/solve/simplify_test.cpp."""
import pathlib
import pickle
import subprocess
import sys
import unittest

import numpy as np
import vkhausdorff as vkh

STEPS = 16
GRID = np.linspace(0, 1, STEPS + 1)
X, Y = np.meshgrid(GRID, GRID, indexing="ij")
VERTICES = np.stack([X, Y, 0.1 * np.sin(5 * X) * np.cos(4 * Y)], axis=-1).reshape(-1, 3)
CORNER = (np.arange(STEPS)[:, None] * (STEPS + 1) + np.arange(STEPS)).ravel()
FACES = np.concatenate([np.stack([CORNER, CORNER + STEPS + 1, CORNER + 1], axis=-1),
                        np.stack([CORNER + 1, CORNER + STEPS + 1, CORNER + STEPS + 2], axis=-1)])


class Simplify(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.found = vkh.simplify((VERTICES, FACES), max=0.01)

    def test_it_is_smaller_and_within_the_limit_both_ways(self):
        r = self.found
        self.assertLess(len(r.faces), 0.8 * len(FACES))
        self.assertEqual((r.vertices.dtype, r.faces.dtype, r.complete), (np.float64, np.uint32, True))
        self.assertLessEqual(r.interval.upper, 0.01)
        self.assertEqual(r.interval.upper, max(r.a_to_b.upper, r.b_to_a.upper))
        self.assertEqual(vkh.gate((VERTICES, FACES), r, 0.01, symmetric=True).verdict, "pass")

    def test_it_unpacks_pickles_and_is_read_only(self):
        vertices, faces, interval = self.found
        self.assertIs(vertices, self.found.vertices)
        again = pickle.loads(pickle.dumps(self.found))
        np.testing.assert_array_equal(again.faces, faces)
        self.assertEqual((again.interval, again.b_to_a, again.tried), (interval, self.found.b_to_a, self.found.tried))
        for array in (vertices, again.vertices):
            with self.assertRaises(ValueError):
                array[0, 0] = 1
        self.assertIn(f"of {len(faces)} faces", repr(self.found))
        self.assertEqual(again, self.found)
        other = vkh.Simplified(vertices[::-1], faces, interval, again.a_to_b, again.b_to_a, again.complete, again.tried)
        self.assertFalse(again == other or again == interval)
        html = self.found._repr_html_()
        self.assertIn(f"<th>faces</th><td>{len(faces)}</td>", html)
        self.assertIn(f"<th>interval</th><td>{interval.lower!r} to {interval.upper!r}</td>", html)

    def test_one_way_borders_and_shares_of_the_diagonal(self):
        r = vkh.simplify((VERTICES, FACES), "1%", one_way=True, lock_borders=True)
        self.assertIsNone(r.b_to_a)
        self.assertEqual(r.interval, r.a_to_b)
        kept = {tuple(v) for v in r.vertices.tolist()}
        border = VERTICES[(VERTICES[:, :2] == 0).any(axis=1) | (VERTICES[:, :2] == 1).any(axis=1)]
        self.assertLessEqual({tuple(v) for v in border.tolist()}, kept)

    def test_float32(self):
        far = VERTICES + [1000.1, 0, 0]
        r = vkh.simplify((far, FACES), 0.01, float32=True)
        np.testing.assert_array_equal(r.vertices.astype(np.float32), r.vertices)
        with self.assertRaisesRegex(ValueError, "float32"):
            vkh.simplify((far, FACES), 1e-6, float32=True)

    def test_a_chain_of_levels(self):
        chain = vkh.simplify_levels((VERTICES, FACES), 0.05, levels=2, ratio=0.4)
        self.assertEqual([type(level) for level in chain], [vkh.Simplified] * 2)
        faces = [len(FACES), *(len(level.faces) for level in chain)]
        for finer, coarser in zip(faces, faces[1:]):
            self.assertLessEqual(coarser, 0.4 * finer + 1)
        for level in chain:  # of A itself, not of the level before
            self.assertLessEqual(level.interval.upper, 0.05)
            self.assertEqual(vkh.gate((VERTICES, FACES), level, level.interval.upper * (1 + 1e-3), symmetric=True).verdict, "pass")
        self.assertTrue(chain[-1].complete)

    def test_a_chain_ends_at_the_limit(self):
        self.assertEqual(vkh.simplify_levels((VERTICES, FACES), 1e-9), [])
        chain = vkh.simplify_levels((VERTICES, FACES), 0.01, levels=30, ratio=0.5, one_way=True, float32=True)
        self.assertTrue(0 < len(chain) < 30)
        self.assertEqual({level.b_to_a for level in chain}, {None})
        with self.assertRaisesRegex(TimeoutError, "in the time"):
            vkh.simplify_levels((VERTICES, FACES), 0.05, time=1e-9)
        for wrong in ({"levels": 0}, {"levels": None}, {"ratio": 0}, {"ratio": 1}, {"ratio": float("nan")}):
            with self.subTest(wrong), self.assertRaisesRegex(ValueError, f"^{next(iter(wrong))}: expected a"):
                vkh.simplify_levels((VERTICES, FACES), 0.05, **wrong)

    def test_the_examples(self):
        for name, said in (("simplify", "<vkhausdorff.Simplified of "), ("levels", "level 0")):
            example = pathlib.Path(__file__).parent.parent / "package" / f"{name}_example.py"
            done = subprocess.run([sys.executable, "-B", example], capture_output=True, text=True, timeout=120)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn(said, done.stdout)

    def test_wrong_limits_and_no_time(self):
        for wrong in (0, -1, float("inf"), "1mm", "+1abs,-1abs"):
            with self.subTest(wrong), self.assertRaises(ValueError):
                vkh.simplify((VERTICES, FACES), wrong)
        with self.assertRaises(TypeError):
            vkh.simplify((VERTICES, FACES), None)
        with self.assertRaisesRegex(TimeoutError, "in the time"):
            vkh.simplify((VERTICES, FACES), 0.01, time=1e-9)


if __name__ == "__main__":
    try:
        vkh.distance(VERTICES, FACES, VERTICES, FACES)
    except vkh.DeviceError as error:
        print(error)
        sys.exit(77)
    unittest.main()
