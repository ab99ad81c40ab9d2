#!/usr/bin/env python3
"""The guide's recipes for build servers (docs/recipes): their gates are run here, on a part and its reference.

usage: recipes_test.py PROGRAM RECIPES. What a server brings itself (its images, its annotations' page) is not run.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

PROGRAM, RECIPES = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
STL = """solid square
facet normal 0 0 1
outer loop
vertex 0 0 {z}
vertex 1 0 {z}
vertex 0 1 {z}
endloop
endfacet
endsolid square
"""


def gates(recipe):
    """The command lines of a recipe that gate, as words."""
    lines = re.findall(r"(vkhausdorff gate .*)$", recipe.read_text(), re.MULTILINE)
    return [shlex.split(line) for line in lines]


class Recipes(unittest.TestCase):
    def test_each_gates_and_each_gate_runs(self):
        recipes = sorted(RECIPES.glob("*.y*ml"))
        self.assertEqual(len(recipes), 3)
        for recipe in recipes:
            with self.subTest(recipe.name), tempfile.TemporaryDirectory() as folder:
                here = pathlib.Path(folder)
                self.assertEqual(len(gates(recipe)), 1)
                words = gates(recipe)[0]
                summary = here / "summary.md"
                environment = {**os.environ, "GITHUB_STEP_SUMMARY": str(summary)}
                for height, code in ((0.05, 0), (0.2, 1)):
                    (here / "part.stl").write_text(STL.format(z=height))
                    (here / "reference.stl").write_text(STL.format(z=0))
                    done = subprocess.run([PROGRAM, *words[1:]], cwd=here, env=environment, capture_output=True, text=True, timeout=120)
                    self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                if "--github" in words:
                    self.assertIn("::error file=part.stl", done.stdout)
                    self.assertEqual(summary.read_text().count("### "), 2)
                for word in words:
                    if word.startswith("--junit="):
                        self.assertIn(word.removeprefix("--junit="), recipe.read_text().split("junit:")[1])
                        self.assertIn('failures="1"', (here / word.removeprefix("--junit=")).read_text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
