#!/usr/bin/env python3
"""Float divisions and roots stand in math/certified.h alone, here and in a small house that breaks the rule."""

import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/kernels"))
import float_places  # noqa: E402

KERNEL = """#version 460
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Block {{ float x[]; }};
#include "shaders/math/certified.h"
#include "shaders/math/other.h"
void main() {{
  uint n = uint(x[0]) / uint(x[1]);
  x[n] = ratio(x[2], x[3]);
{}
}}
"""


class FloatPlaces(unittest.TestCase):
    def test_the_house(self):
        self.assertEqual(list(float_places.breaches(ROOT)), [])

    def said(self, line, other=""):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "shaders/math").mkdir(parents=True)
            (root / "shaders/traversal").mkdir()
            (root / "shaders/math/certified.h").write_text("float ratio(float a, float b) { return a / sqrt(b); }\n")
            (root / "shaders/math/other.h").write_text(other)
            (root / "shaders/traversal/a.comp").write_text(KERNEL.format(line))
            return list(float_places.breaches(root))

    def test_integers_and_excuses_pass(self):
        self.assertEqual(self.said(""), [])
        self.assertEqual(self.said("  x[4] = x[5] / x[6];  // uncertified: steers"), [])
        self.assertEqual(self.said("  // uncertified: steers\n  // only\n  x[4] = sqrt(x[6]);"), [])

    def test_breaches_are_named(self):
        at = "shaders/traversal/a.comp:10: "
        for line, what in [("  x[4] = x[5] / x[6];", "a division"), ("  x[4] /= 3.0;", "a division"),
                           ("  x[4] = sqrt(x[6]);", "a root (Sqrt)"), ("  x[4] = inversesqrt(x[6]);", "InverseSqrt"),
                           ("  x[4] = length(vec3(x[1]));", "Length"),
                           ("  x[4] = distance(vec3(x[1]), vec3(x[2]));", "Distance"),
                           ("  x[4] = normalize(vec3(x[1], 1, 2)).x;", "Normalize"),
                           ("  x[4] = sqrt(x[6]);  // uncertified:", "Sqrt"),
                           ("  x[4] = (vec3(x[5]) / vec3(x[6])).x;", "a division")]:
            with self.subTest(line):
                said = self.said(line)
                self.assertEqual(len(said), 1, said)
                self.assertTrue(said[0].startswith(at) and what in said[0], said)

    def test_so_is_a_line_of_a_header(self):
        said = self.said("  x[4] = half_of(x[5]);", "\nfloat half_of(float a) { return a / 2.0; }\n")
        self.assertEqual(said, ["shaders/math/other.h:2: a division outside shaders/math/certified.h"])


if __name__ == "__main__":
    unittest.main()
