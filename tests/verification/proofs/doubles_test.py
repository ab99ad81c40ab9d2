#!/usr/bin/env python3
"""The error constants of host/native, proven by Gappa from its headers and from those of shaders/math that it compiles.

As proofs_test.py: each theorem holds with the constants that are there and with the weakest of its own, and not with a
weaker one. 77 where there is no gappa.
"""

import shutil
import sys
import unittest
from pathlib import Path

from headers import ROOT, Headers, all_texts
from proof import contradictions, failed, holds_with, template

TEMPLATES = sorted((Path(__file__).parent / "doubles").glob("*.g"))
PROOFS = [template(path) for path in TEMPLATES]
OWN = ("certified.h", "place.h", "two_double.h")


def headers(instead=None):
    own = {name: (ROOT / "host" / "native" / name).read_text() for name in OWN}
    return Headers(instead, {**all_texts(), **own})


class Doubles(unittest.TestCase):
    def test_the_constants(self):
        for proof in PROOFS:
            self.assertEqual(failed(proof, headers()), [], proof.name)
            self.assertEqual(list(contradictions(proof, headers())), [], proof.name)

    def test_weaker_constants(self):
        for proof in PROOFS:
            known = proof.constants(headers())
            for w in proof.weakened:
                self.assertTrue(holds_with(proof, w.name, w.holds, headers), f"{proof.name} with {w.name} = {w.holds}")
                self.assertFalse(holds_with(proof, w.name, w.fails, headers), f"{proof.name} with {w.name} = {w.fails}")
                self.assertGreaterEqual(known[w.name], w.holds, f"{proof.name}: {w.name}")


if __name__ == "__main__":
    if not shutil.which("gappa"):
        print("no gappa here (Debian and Ubuntu: apt-get install gappa): the constants in doubles are not checked")
        sys.exit(77)
    unittest.main()
