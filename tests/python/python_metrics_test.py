#!/usr/bin/env python3
"""Metrics by name in Python: attributes, masks as surfaces, and what is refused. Figures of meshes: tests/solve/metrics_test.cpp.

nibabel, where it is here, writes and reads the files of masks (tools/setup --full installs it).
"""
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import vkhausdorff as vkh
from python_shapes import SQUARE, SQUARE_FACES as FACES

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LENGTHS = ("hausdorff", "hd_p", "hd_p_pooled", "masd", "assd", "rms", "chamfer_l1", "chamfer_l2")
SHARES = ("nsd", "precision", "recall", "f1")


def block(shape, low, high):
    mask = np.zeros(shape, dtype=bool)
    mask[tuple(slice(a, b) for a, b in zip(low, high))] = True
    return mask


class Meshes(unittest.TestCase):
    def encloses(self, interval, truth, width=None):
        self.assertLessEqual(interval.lower, truth * (1 + 1e-12))
        self.assertGreaterEqual(interval.upper, truth * (1 - 1e-12))
        self.assertIn(interval.estimate, interval)
        if width is not None:
            self.assertLessEqual(interval.upper - interval.lower, width)

    def test_parallel_squares(self):
        m = vkh.metrics((SQUARE, FACES), (SQUARE + [0, 0, 0.25], FACES), percentile=90, bands=[0.2, "30%"])
        for name in LENGTHS[:6]:
            self.encloses(getattr(m, name), 0.25, 0.006)
        self.encloses(m.chamfer_l1, 0.5, 0.02)
        self.encloses(m.chamfer_l2, 0.125, 0.01)
        for name in SHARES:
            self.assertEqual([tuple(share) for share in getattr(m, name).values()], [(0, 0), (1, 1)])
            self.assertEqual(list(getattr(m, name)), [0.2, "30%"])
        self.assertTrue(m.met)
        self.assertEqual(m.unmet, ())
        self.assertEqual((m.hd90, m.hd90_pooled), (m.hd_p, m.hd_p_pooled))
        self.assertRaises(AttributeError, lambda: m.hd95)
        self.assertEqual(m.result.interval, m.hausdorff)
        self.assertNotIn("metrics", m.result.stats)

    def test_shares_without_a_survey_are_unknown(self):
        m = vkh.metrics((SQUARE, FACES), (SQUARE + [0, 0, 0.25], FACES), bands=[0.01, "30%"], on_progress=lambda *_: False)
        for name in SHARES:
            self.assertEqual([(key, tuple(share)) for key, share in getattr(m, name).items()], [(0.01, (0, 1)), ("30%", (0, 1))])
        self.assertFalse(m.met)
        self.assertIn("f1@0.01", m.unmet)
        self.assertIn("<th>f1@0.01</th><td>0.0 to 1.0</td>", m._repr_html_())

    def test_figures_and_normals(self):
        m = vkh.metrics((SQUARE, FACES), (SQUARE + [0, 0, 0.25], FACES), bands=[0.25, 0.3], figures=["hd95", "normal_consistency"], normals=20)
        self.assertEqual((m.met, m.unmet), (True, ()), "shares at a jump are not asked for")
        self.encloses(m.normal_consistency, 1, 0.01)
        self.assertEqual(tuple(m.f1_normals[0.3]), (1, 1))
        self.assertIn("f1_normals@0.3", m.to_dict())
        plain = vkh.metrics((SQUARE, FACES), (SQUARE, FACES))
        self.assertEqual((plain.normal_consistency, plain.f1_normals), (None, {}))
        for wrong, error in (({"figures": ["hd90"]}, ValueError), ({"figures": ["f1"]}, ValueError), ({"normals": 0}, ValueError), ({"normals": "20"}, TypeError)):
            with self.subTest(wrong):
                self.assertRaises(error, vkh.metrics, (SQUARE, FACES), (SQUARE, FACES), **wrong)

    def test_a_jump_does_not_meet_its_goal(self):
        m = vkh.metrics((SQUARE, FACES), (SQUARE + [0, 0, 0.25], FACES), bands=[0.25], effort=2000)
        self.assertTrue(m.nsd[0.25].jump)
        self.assertEqual((m.met, "nsd@0.25" in m.unmet), (False, True))

    def test_pickles_and_plain_values(self):
        m = vkh.metrics((SQUARE, FACES), (SQUARE + [0, 0, 0.25], FACES), bands=[0.5])
        self.assertEqual(pickle.loads(pickle.dumps(m)), m)
        row = m.to_dict()
        self.assertEqual(row["hd95"]["lower"], m.hd95.lower)
        self.assertEqual(row["f1@0.5"]["upper"], 1)
        self.assertEqual(m._row()["assd_upper"], m.assd.upper)
        self.assertIn("hd95_pooled=", repr(m))

    def test_refusals(self):
        a = (SQUARE, FACES)
        line = (np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), [[0, 1, 2]])
        for wrong, options, said in ((ValueError, {"percentile": 0}, "percentile"), (ValueError, {"percentile": 101}, "percentile"),
                                     (ValueError, {"percentile": 0.95}, "could be 95 or 0.95%"),
                                     (TypeError, {"percentile": "many"}, "percentile"), (TypeError, {"bands": 0.5}, "bands"),
                                     (TypeError, {"spacing": (1, 1, 1)}, "spacing"), (TypeError, {"affine": np.eye(4)}, "affine")):
            with self.assertRaisesRegex(wrong, said):
                vkh.metrics(a, a, **options)
        self.assertEqual(vkh.metrics(a, a, percentile="0.5%").percentile, 0.5)
        for pair in ((a, line), (line, a)):
            with self.assertRaisesRegex(ValueError, "without area"):
                vkh.metrics(*pair)


class Masks(unittest.TestCase):
    encloses = Meshes.encloses

    def test_surface_of_a_box(self):
        """Areas and positions of a box of voxels, by NIfTI's middles of voxels."""
        from vkhausdorff import _masks
        affine = np.diag([1.0, 2.0, 0.5, 1.0])
        affine[:3, 3] = [10, 20, 30]
        mesh = _masks._surface("a", block((5, 6, 7), (1, 0, 2), (4, 6, 7)), affine)
        p = mesh.vertices[mesh.faces]
        normals = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        self.assertEqual(np.linalg.norm(normals, axis=1).sum() / 2, 2 * (3 * 12 + 3 * 2.5 + 12 * 2.5))
        self.assertEqual(mesh.vertices.min(axis=0).tolist(), [10.5, 19, 30.75])
        self.assertEqual(mesh.vertices.max(axis=0).tolist(), [13.5, 31, 33.25])
        self.assertEqual(mesh.delta, 0)
        self.assertEqual(np.abs(normals.sum(axis=0)).max(), 0)  # closed
        self.assertEqual((p[:, 0] * normals).sum() / 6, 3 * 12 * 2.5)  # and turned outward

    def test_mirrored_grids_are_turned_outward(self):
        from vkhausdorff import _masks
        mesh = _masks._surface("a", block((4, 4, 4), (1, 1, 1), (3, 3, 3)), np.diag([-1.0, 1, 1, 1]))
        p = mesh.vertices[mesh.faces]
        self.assertEqual((p[:, 0] * np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])).sum() / 6, 8)

    def test_rounding_is_in_delta(self):
        from vkhausdorff import _masks
        turn = np.array([[0.6, -0.8, 0, 0.1], [0.8, 0.6, 0, 0.2], [0, 0, 0.7, 0.3], [0, 0, 0, 1]])
        for affine in (np.diag([0.7, 0.7, 1.3, 1]), turn):
            mesh = _masks._surface("a", block((9, 9, 9), (2, 2, 2), (7, 7, 7)), affine)
            self.assertTrue(0 < mesh.delta < 1e-13)

    def test_a_box_longer_by_two_voxels(self):
        """A: 4 x 4 x 6 voxels, B: the first 4 of them. The far end of A is 2 away, and its sides rise to it evenly."""
        a, b = block((8, 8, 10), (2, 2, 2), (6, 6, 8)), block((8, 8, 10), (2, 2, 2), (6, 6, 6))
        m = vkh.metrics(a, b, bands=[0.5, 3.0])
        area_a, area_b = 2 * 16 + 4 * 24, 2 * 16 + 4 * 16
        self.encloses(m.hausdorff, 2, 1e-4)
        # The middle of B's far end is 2 from A's sides and from its far end: a pyramid over a square of 4.
        mean_a, mean_b = (16 * 2 + 4 * 4 * 2 * 1) / area_a, (16 * 2 / 3) / area_b
        self.encloses(m.masd, (mean_a + mean_b) / 2, 0.02)
        self.encloses(m.assd, (mean_a * area_a + mean_b * area_b) / (area_a + area_b), 0.02)
        self.encloses(m.chamfer_l1, mean_a + mean_b, 0.04)
        # Within 0.5: all of A but its far end and the last 1.5 of its sides; of B's far end all but a square of 3.
        precision, recall = 1 - (16 + 4 * 4 * 1.5) / area_a, 1 - 9 / area_b
        self.encloses(m.precision[0.5], precision, 0.001)
        self.encloses(m.recall[0.5], recall, 0.001)
        self.encloses(m.f1[0.5], 2 * precision * recall / (precision + recall), 0.001)
        self.assertEqual(tuple(m.nsd[3.0]), (1, 1))
        self.assertTrue(m.met)

    def test_spacing_and_affine_are_one(self):
        a, b = block((8, 8, 10), (2, 2, 2), (6, 6, 8)), block((8, 8, 10), (2, 2, 2), (6, 6, 6))
        by_spacing = vkh.metrics(a, b, spacing=(1, 0.5, 2))
        by_affine = vkh.metrics(a.astype(np.int16) * 3, b.astype(np.uint8), affine=np.diag([1, 0.5, 2, 1]))
        self.assertEqual(by_spacing, by_affine)
        self.encloses(by_spacing.hausdorff, 4)

    def test_refusals(self):
        a = block((6, 6, 6), (1, 1, 1), (5, 5, 5))
        for wrong, words, options, said in ((ValueError, (a, np.zeros_like(a)), {}, "b: no voxel"),
                                            (TypeError, (a, a.astype(float)), {}, "b: expected booleans"),
                                            (ValueError, (a, a[:5]), {}, "grid"), (TypeError, (a, (SQUARE, FACES)), {}, "b: expected a mask"),
                                            (ValueError, (a, a), {"spacing": (1, 1, 0)}, "spacing"), (ValueError, (a, a), {"spacing": 1}, "spacing"),
                                            (ValueError, (a, a), {"affine": np.zeros((4, 4))}, "affine"),
                                            (TypeError, (a, a), {"affine": np.eye(4), "spacing": (1, 1, 1)}, "spacing")):
            with self.subTest(said), self.assertRaisesRegex(wrong, said):
                vkh.metrics(*words, **options)

    def test_an_empty_mask_is_infinitely_far(self):
        a = block((6, 6, 6), (1, 1, 1), (5, 5, 5))
        none = np.zeros_like(a)
        with self.assertRaisesRegex(ValueError, "b: no voxel is set.*empty='inf'"):
            vkh.metrics(a, none)
        for pair, no_a, no_b in (((a, none), False, True), ((none, a), True, False), ((none, none), True, True)):
            m = vkh.metrics(*pair, empty="inf", bands=[0.5, "1%"], percentile=99.5, normals=20, spacing=(1, 1, 2))
            with self.subTest((no_a, no_b)):
                length = np.nan if no_a and no_b else np.inf
                for name in (*LENGTHS, "hd99.5"):
                    np.testing.assert_equal(tuple(getattr(m, name)), (length, length))
                share = np.nan if no_a and no_b else 0.0
                for name in SHARES + ("precision_normals", "recall_normals", "f1_normals"):
                    lacks = (no_a and name.startswith("precision")) or (no_b and name.startswith("recall"))
                    truth = np.nan if lacks else share
                    np.testing.assert_equal([*map(tuple, getattr(m, name).values())], [(truth, truth)] * 2)
                    self.assertEqual(list(getattr(m, name)), [0.5, "1%"])
                self.assertEqual((m.met, m.unmet, m.result), (True, (), None))
                self.assertIn("hausdorff=", repr(m))
        for wrong, options in ((ValueError, {"bands": ["much"]}), (ValueError, {"figures": ["dice"]}), (ValueError, {"percentile": 0}),
                               (ValueError, {"empty": "nan"}), (ValueError, {"spacing": (1, 1)})):
            with self.subTest(options):
                self.assertRaises(wrong, vkh.metrics, a, none, **{"empty": "inf", **options})
        self.assertRaises(TypeError, vkh.metrics, a, none.astype(float), empty="inf")
        self.assertEqual(vkh.metrics(a, a, empty="inf"), vkh.metrics(a, a))

    def test_contours_of_two_dimensions(self):
        """A: 4 x 6 pixels, B: the first 4 x 4. The far edge of A is 2 away, and two sides rise to it."""
        a, b = block((8, 10), (2, 2), (6, 8)), block((8, 10), (2, 2), (6, 6))
        m = vkh.metrics(a, b, bands=[0.5, 3.0], spacing=(0.5, 0.5), percentile=90)
        # In pixels: of A's 20 the far edge of 4 is at 2, and 2 + 2 rise from 0 to 2. B's far edge, 4 of 16, is under a roof of
        # height 2.
        mean_a, mean_b = (4 * 2 + 4 * 1) / 20 / 2, (4 * 1) / 16 / 2
        self.encloses(m.hausdorff, 1, 1e-4)
        self.encloses(m.hd90, 1, 0.03)
        self.encloses(m.masd, (mean_a + mean_b) / 2, 0.02)
        self.encloses(m.assd, (mean_a * 20 + mean_b * 16) / 36, 0.02)
        self.encloses(m.precision[0.5], 1 - (4 + 4 * 0.5) / 20, 0.001)
        self.encloses(m.recall[0.5], 1 - 2 / 16, 0.001)
        self.assertEqual(tuple(m.nsd[3.0]), (1, 1))
        for wrong, words, options, said in ((ValueError, (a, b), {"bands": ["1%"]}, "two dimensions they are lengths"),
                                            (ValueError, (a, b), {"spacing": (1, 1, 1)}, "two positive numbers"),
                                            (TypeError, (a, b), {"affine": np.eye(4)}, "three dimensions"),
                                            (TypeError, (a, b.astype(int)), {}, "two and booleans"),
                                            (ValueError, (a, np.zeros_like(a)), {}, "no voxel")):
            with self.subTest(said), self.assertRaisesRegex(wrong, said):
                vkh.metrics(*words, **options)

    def test_files_of_nifti(self):
        try:
            import nibabel
        except ImportError:
            self.skipTest("nibabel is not here: tools/setup --full installs python3-nibabel")
        a, b = block((8, 8, 10), (2, 2, 2), (6, 6, 8)), block((8, 8, 10), (2, 2, 2), (6, 6, 6))
        with tempfile.TemporaryDirectory() as folder:
            for name, mask in (("a", a), ("b", b)):
                nibabel.save(nibabel.Nifti1Image(mask.astype(np.uint8), np.diag([1, 0.5, 2, 1])), f"{folder}/{name}.nii.gz")
            images = [nibabel.load(f"{folder}/{name}.nii.gz") for name in "ab"]
            read = vkh.metrics(*(np.asarray(image.dataobj) for image in images), affine=images[0].affine)
        self.assertEqual(read, vkh.metrics(a, b, spacing=(1, 0.5, 2)))


class Example(unittest.TestCase):
    def test_example(self):
        done = subprocess.run([sys.executable, "-B", SOURCE / "tests/package/metrics_example.py"], capture_output=True, text=True, timeout=300)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lower, upper, assd = map(float, done.stdout.split()[:3])
        self.assertTrue(lower <= 5 <= upper < 5.1)  # two voxels of 2.5
        self.assertTrue(0 < assd < 1)
        self.assertEqual(done.stdout.split()[-1], "True")


if __name__ == "__main__":
    unittest.main()
