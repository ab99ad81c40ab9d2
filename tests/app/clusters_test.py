#!/usr/bin/env python3
"""docs/clusters.md: its recipes (docs/recipes/clusters) are run here, and come out as a batch of one piece.

usage: clusters_test.py PROGRAM RECIPES PAGE. Slurm's and Dask's are other tests'. Of Kubernetes the container's command
is run, once for each index. Tools that are not here are named, and their recipes left out.
"""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from spheres import FAIL, PAIRS, begun, lines, write_pairs  # noqa: E402

PROGRAM, RECIPES, PAGE = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
ENDS = 240


def quoted(page: str) -> list[str]:
    return re.findall(r"^```\w*\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)


class Clusters(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="vkh-clusters-")))
        (cls.root / "bin").mkdir()
        (cls.root / "bin" / "vkhausdorff").symlink_to(PROGRAM)
        cls.environment = {**os.environ, "PATH": f"{cls.root}/bin:{os.environ['PATH']}", "HOME": str(cls.root)}
        cls.reference = cls.merged(cls.folder("plain"), "vkhausdorff batch list.jsonl --out results-0.jsonl")

    @classmethod
    def folder(cls, name: str) -> pathlib.Path:
        folder = cls.root / name
        folder.mkdir()
        write_pairs(folder)
        return folder

    @classmethod
    def shell(cls, folder: pathlib.Path, script: str, **variables) -> subprocess.CompletedProcess:
        return subprocess.run(["bash", "-c", script], cwd=folder, env={**cls.environment, **variables}, capture_output=True,
                              text=True, timeout=ENDS)

    @classmethod
    def merged(cls, folder: pathlib.Path, script: str = "true") -> bytes:
        """The part of a script's results that two runs share."""
        ran = cls.shell(folder, script)
        done = cls.shell(folder, "vkhausdorff merge results-*.jsonl --list list.jsonl --out reproducible.jsonl --reproducible")
        assert done.returncode == FAIL, (ran, done)
        return (folder / "reproducible.jsonl").read_bytes()

    def needs(self, tool: str):
        if not shutil.which(tool):
            print(f"no {tool} here; its recipe is left out")
            self.skipTest(f"no {tool}")

    def test_the_page_quotes_each_recipe_and_nothing_else(self):
        recipes = {path.name: path.read_text() for path in RECIPES.iterdir()}
        self.assertEqual(sorted(recipes), ["Snakefile", "dask_example.py", "kubernetes.yml", "parallel.sh", "slurm.sh"])
        self.assertEqual(sorted(quoted(PAGE.read_text())), sorted(recipes.values()))

    def test_parallel_goes_on_after_a_kill(self):
        self.needs("parallel")
        folder = self.folder("parallel")
        recipe = (RECIPES / "parallel.sh").read_text()
        running = subprocess.Popen(["bash", "-c", recipe], cwd=folder, env=self.environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
        self.addCleanup(running.kill)
        self.kill(folder, "results-2.jsonl")
        said, _ = running.communicate(timeout=ENDS)
        self.assertEqual(running.returncode, FAIL, said)
        self.assertEqual(len(lines(folder / "all.jsonl")), PAIRS)
        self.assertEqual(self.merged(folder), self.reference)

    def kill(self, folder: pathlib.Path, results: str):
        """Hard, once there is a line."""
        end = time.monotonic() + ENDS
        while not (process := begun(folder / results)):
            self.assertLess(time.monotonic(), end, f"no line of {results}")
            time.sleep(0.02)
        os.kill(process, signal.SIGKILL)

    def test_snakemake(self):
        self.needs("snakemake")
        folder = self.folder("snakemake")
        shutil.copy(RECIPES / "Snakefile", folder)
        done = self.shell(folder, "snakemake --cores 2")
        self.assertEqual(done.returncode, 1, done.stderr)  # the merge's FAIL, as Snakemake says it
        self.assertEqual(sorted(path.name for path in (folder / "done").iterdir()), list("0123"))
        self.assertEqual(len(lines(folder / "all.jsonl")), PAIRS)
        self.assertEqual(self.merged(folder), self.reference)

    def test_kubernetes_containers(self):
        folder = self.folder("kubernetes")
        manifest = (RECIPES / "kubernetes.yml").read_text()
        completions = re.search(r"completions: (\d+)$", manifest, re.MULTILINE)[1]
        command = re.search(r"args:\n +- (exec vkhausdorff batch .*)$", manifest, re.MULTILINE)[1]
        self.assertIn(f"/{completions} ", command)
        command = command.replace(f"/{completions} ", "/3 ")
        codes = [subprocess.run(["sh", "-c", command], cwd=folder, env={**self.environment, "JOB_COMPLETION_INDEX": str(i)},
                                capture_output=True, timeout=ENDS).returncode for i in range(3)]
        self.assertEqual(sorted(codes), [0, 0, FAIL])
        self.assertIn(str(FAIL), re.search(r"FailIndex.*?values: \[(.*?)\]", manifest, re.DOTALL)[1])
        self.assertEqual(self.merged(folder), self.reference)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
