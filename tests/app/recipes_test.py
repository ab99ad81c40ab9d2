#!/usr/bin/env python3
"""The recipes for build servers (docs/recipes): their gates are run here, on a part and its reference.

usage: recipes_test.py PROGRAM RECIPES. What a server brings itself (its images, its annotations' page) is not run.
"""

import fnmatch
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


def lines_of(recipe, command):
    """The command lines of a recipe with the command, as words; a line that begins with an option goes on the one before."""
    lines = re.findall(rf"(vkhausdorff {command} .*)$", re.sub(r"\n +(?=--)", " ", recipe.read_text()), re.MULTILINE)
    return [shlex.split(line) for line in lines]


def write(path, z):
    path.parent.mkdir(exist_ok=True)
    path.write_text(STL.format(z=z))


class Recipes(unittest.TestCase):
    def test_each_gates_and_each_gate_runs(self):
        recipes = sorted(recipe for recipe in RECIPES.glob("*.y*ml") if lines_of(recipe, "gate"))
        self.assertEqual(len(recipes), 3)
        self.assertEqual(len(list(RECIPES.glob("*.y*ml"))), 4)
        for recipe in recipes:
            with self.subTest(recipe.name), tempfile.TemporaryDirectory() as folder:
                here = pathlib.Path(folder)
                self.assertEqual(len(lines_of(recipe, "gate")), 1)
                words = lines_of(recipe, "gate")[0]
                summary = here / "summary.md"
                environment = {**os.environ, "GITHUB_STEP_SUMMARY": str(summary)}
                for height, code in ((0.05, 0), (0.2, 1)):
                    write(here / "part.stl", height)
                    write(here / "reference.stl", 0)
                    done = subprocess.run([PROGRAM, *words[1:]], cwd=here, env=environment, capture_output=True, text=True, timeout=120)
                    self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                if "--github" in words:
                    self.assertIn("::error file=part.stl", done.stdout)
                    self.assertEqual(summary.read_text().count("### "), 2)
                for word in words:
                    if word.startswith("--junit="):
                        self.assertIn(word.removeprefix("--junit="), recipe.read_text().split("junit:")[1])
                        self.assertIn('failures="1"', (here / word.removeprefix("--junit=")).read_text())

    def test_the_one_of_folders(self):
        recipe = RECIPES / "github-folders.yml"
        [words] = lines_of(recipe, "batch")
        for heights, code, annotations in (((0.05, 0.02), 0, 0), ((0.05, 0.2), 1, 1), ((0.05, None), 4, 1)):
            with self.subTest(code), tempfile.TemporaryDirectory() as folder:
                here = pathlib.Path(folder)
                for name, height in zip(("near", "far"), heights):
                    write(here / "models" / f"{name}.stl", 0)
                    if height is not None:
                        write(here / "references" / f"{name}.stl", height)
                environment = {**os.environ, "GITHUB_STEP_SUMMARY": str(here / "summary.md")}
                done = subprocess.run([PROGRAM, *words[1:]], cwd=here, env=environment, capture_output=True, text=True, timeout=120)
                self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                self.assertEqual(done.stdout.count("::error file=models/far.stl,"), annotations, done.stdout)
                self.assertIn("near", (here / "summary.md").read_text())
                for path in recipe.read_text().split("path: |\n")[1].split():
                    self.assertTrue((here / path).exists(), path)

    def test_each_takes_the_package_that_a_release_writes_for_its_system(self):
        release = (RECIPES.parents[1] / "tools/release").read_text()
        pattern = re.search(r'files/(\$\S+\.deb)"', release)[1]
        packages = {system: pattern.replace("${name%_*}", "vkhausdorff_0.3.0").replace("${system}", system).replace("${name##*_}", "amd64")
                    for system in ("debian12", "ubuntu24.04")}
        for recipe, system in (("Dockerfile", "debian12"), ("gitlab.yml", "debian12"), ("github.yml", "ubuntu24.04"), ("github-folders.yml", "ubuntu24.04")):
            taken = re.search(r"(?:COPY |\./)(vkhausdorff_\S+\.deb)", (RECIPES / recipe).read_text())[1]
            self.assertEqual([name for name in packages if fnmatch.fnmatch(packages[name], taken)], [system], recipe)

    def test_workflows_say_when_they_run(self):
        for name in ("github.yml", "github-folders.yml"):
            self.assertTrue((RECIPES / name).read_text().startswith("on: [push]\njobs:\n"), name)

    def test_the_image_has_a_driver(self):
        lines = (RECIPES / "Dockerfile").read_text().replace("\\\n", "").splitlines()
        self.assertTrue(any(line.startswith("RUN ") and "mesa-vulkan-drivers" in line and "/tmp/vkhausdorff_*.deb" in line for line in lines))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
