#!/usr/bin/env python3
"""Certificates from Python, given to vkh_check. usage: python_certificate_test.py VKH_CHECK"""
import contextlib
import io
import os
import pathlib
import runpy
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np
import vkhausdorff as vkh
from python_shapes import grid

CHECK = os.path.abspath(sys.argv.pop(1))
FIRST_FILES_HASH, HASHES = 48, 32
A, B = grid(6), grid(5, 0.05)


class Certificates(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)
        self.path = self.folder / "out.vhc"

    def write(self, name, mesh):
        vertices, faces = mesh
        with open(self.folder / name, "w") as out:
            out.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist())
            out.writelines(f"f {i} {j} {k}\n" for i, j, k in (faces + 1).tolist())
        return self.folder / name

    def check(self, a, b):
        return subprocess.run([CHECK, self.path, self.write("a.obj", a), self.write("b.obj", b)], capture_output=True, text=True, timeout=120)

    def accepted(self, a, b, ways=1):
        done = self.check(a, b)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        self.assertEqual(done.stdout.count("proven: "), ways)

    def certify(self, call, a=A, b=B, ways=1):
        """The answer, once its certificate is accepted, and proves all that it claims."""
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            r = call()
        certificate = r.stats["certificate"]
        self.accepted(a, b, ways)
        self.assertEqual(certificate["upper"], r.upper)
        self.assertEqual(certificate["bytes"], self.path.stat().st_size)
        self.path.unlink()
        return certificate

    def test_every_call(self):
        found = self.certify(lambda: vkh.distance(*A, *B, certificate=str(self.path)))
        self.assertGreaterEqual(found["leaves"], len(A[1]))
        self.assertEqual(found["unproven"], 0)
        both = self.certify(lambda: vkh.distance(*A, *B, symmetric=True, certificate=self.path), ways=2)
        self.assertGreaterEqual(both["b_to_a"]["leaves"], len(B[1]))
        self.assertEqual(set(both), set(found))
        self.assertEqual(both["leaves"], both["a_to_b"]["leaves"] + both["b_to_a"]["leaves"])
        self.assertIsNone(found["b_to_a"])
        self.certify(lambda: vkh.distance(*A, *B, field=True, statistics=True, certificate=self.path))
        self.certify(lambda: vkh.gate(A, B, 0.5, certificate=self.path))
        self.certify(lambda: vkh.gate(A, B, 0.01, symmetric=True, certificate=self.path), ways=2)
        with vkh.Solver(*B) as solver:
            self.certify(lambda: solver.distance(*A, certificate=self.path))
            self.assertNotIn("certificate", solver.distance(*A).stats)

    def test_arrays_of_any_type_are_as_given(self):
        for a in ((A[0].astype(np.float32), A[1]), ((A[0] * 1000).astype(np.int64), A[1])):
            self.certify(lambda: vkh.distance(*a, *B, certificate=self.path), a=a)

    def test_it_is_of_corners_and_of_no_file(self):
        vkh.distance(*A, *B, certificate=self.path)
        data = self.path.read_bytes()
        self.assertEqual(data[FIRST_FILES_HASH:FIRST_FILES_HASH + 2 * HASHES], bytes(2 * HASHES))
        other_order = (A[0], A[1][::-1])
        moved = (np.nextafter(A[0], 9), A[1])
        for a in (other_order, moved, B):
            self.assertEqual(self.check(a, B).returncode, 1)
        renumbered = (A[0][::-1], len(A[0]) - 1 - A[1])
        self.accepted(renumbered, B)

    def test_what_ends_early_has_one_all_the_same(self):
        fine = grid(30)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            r = vkh.distance(*fine, *B, tol=1e-9, progress=lambda *at: False, certificate=self.path)
            least = vkh.distance(*fine, *B, tol=1e-9).lower
        self.assertEqual(r.status, "cancelled")
        self.assertGreaterEqual(r.stats["certificate"]["upper"], least)
        self.assertEqual([str(one.message)[:30] for one in said], ["the certificate proves less th"] * (r.stats["certificate"]["upper"] > r.upper))
        self.accepted(fine, B)
        r = vkh.distance(*A, *B, waves=1, certificate=self.path)
        self.assertEqual(r.status, "waves")
        self.accepted(A, B)

    def test_refusals(self):
        for path, kind, why in ((5, TypeError, "certificate: expected the path of a file that ends in .vhc, or None, not 5"),
                                ("out.txt", ValueError, "certificate: expected the path"),
                                (self.folder / "no" / "out.vhc", ValueError, "certificate '.*no/out.vhc': the folder")):
            with self.assertRaisesRegex(kind, why) as raised:
                vkh.distance(*A, *B, certificate=path)
            self.assertEqual(getattr(raised.exception, "file", None), str(path) if "the folder" in why else None)
        for more in ({"max": 0.5, "area": "50%"}, {"max": np.full(len(A[1]), 0.5)}):
            with self.assertRaisesRegex(ValueError, "certificate: is of the interval"):
                vkh.gate(A, B, certificate=self.path, **more)
        self.assertFalse(self.path.exists())
        self.assertNotIn("certificate", vkh.distance(*A, *B, certificate=None).stats)

    @unittest.skipUnless(os.path.exists("/dev/full"), "no /dev/full")
    def test_a_full_disk(self):
        self.path.symlink_to("/dev/full")
        with self.assertRaisesRegex(OSError, "certificate .*cannot be written") as raised:
            vkh.distance(*A, *B, certificate=self.path)
        self.assertEqual(raised.exception.file, str(self.path))

    def test_the_example(self):
        example = pathlib.Path(__file__).resolve().parents[1] / "package/certificate_example.py"
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        with contextlib.redirect_stdout(io.StringIO()) as said:
            runpy.run_path(str(example))
        asked, proven = said.getvalue().split()
        self.assertEqual(asked, proven)
        done = subprocess.run([CHECK, "part.vhc", "a.obj", "b.obj"], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
