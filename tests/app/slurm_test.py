#!/usr/bin/env python3
"""tools/slurm on a Slurm of this test's own: what is killed, preempted or cancelled there comes out as if nothing had been.

usage: slurm_test.py PROGRAM. Exit code 77, with the reason: Slurm's daemons are not here, or this is not root.
"""

import fcntl
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from local_slurm import LocalSlurm, missing  # noqa: E402
from spheres import FAIL, PAIRS, begun, lines, write_pairs  # noqa: E402

SLURM = pathlib.Path(__file__).resolve().parents[2] / "tools" / "slurm"
SHARDS, TASKS = 6, 4  # MaxArraySize is 4: tasks 0 and 1 have two shards
OPTIONS = ["--tol", "1e-5", "--device", "cpu"]


class Slurm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="vkh-slurm-")
        cls.addClassCleanup(cls.temporary.cleanup)
        root = pathlib.Path(cls.temporary.name)
        (root / "slurm").mkdir()
        cls.slurm = LocalSlurm(root / "slurm", largest_array=TASKS).__enter__()
        cls.addClassCleanup(cls.slurm.stop)
        cls.root = root
        cls.list = write_pairs(root)
        cls.reference = cls.without_slurm()

    @classmethod
    def without_slurm(cls) -> bytes:
        """The outputs of a batch and a merge without Slurm, each exiting with FAIL."""
        for words in (["batch", cls.list, "--out", cls.root / "plain.jsonl", *OPTIONS],
                      ["merge", cls.root / "plain.jsonl", "--out", cls.root / "reference.jsonl", "--reproducible"]):
            done = cls.slurm.run(PROGRAM, *words, check=False, seconds=120)
            assert done.returncode == FAIL, (words, done)
        return (cls.root / "reference.jsonl").read_bytes()

    def submit(self, folder: pathlib.Path, *before: str, **variables) -> subprocess.Popen:
        environment = {**self.slurm.environment, "VKH_PROGRAM": str(PROGRAM), "VKH_SHARDS": str(SHARDS),
                       "VKH_MERGE": "--reproducible", "VKH_TIME": "10", **variables}
        process = subprocess.Popen([SLURM / "submit", *before, self.list, folder, *OPTIONS], env=environment,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def ends(self, process: subprocess.Popen, code: int, seconds: float = 120) -> str:
        said, _ = process.communicate(timeout=seconds)
        self.assertEqual(process.returncode, code, said + self.logs)
        return said

    def until(self, true, what: str, seconds: float = 60):
        """The value of `true()`, once it is true."""
        found = []
        self.slurm.until(lambda: found.append(true()) or found[-1], what, seconds)
        return found[-1]

    def folder(self, name: str) -> pathlib.Path:
        folder = self.root / name
        self.of = folder
        return folder

    @property
    def logs(self) -> str:
        return "".join(f"\n{path.name}:\n{path.read_text()}" for path in sorted((self.of / "logs").glob("*.log")))

    def array(self, folder: pathlib.Path) -> str:
        return self.until(lambda: lines(folder / "jobs"), "the array").pop().decode().split()[0]

    def begun(self, results: pathlib.Path) -> int:
        """The process that writes a shard, as soon as there is a line of it."""
        return self.until(lambda: begun(results), f"a line of {results.name}")

    def whole(self, folder: pathlib.Path):
        """The merged file is that of a run without Slurm; each pair was done once."""
        self.assertEqual((folder / "all.jsonl").read_bytes(), self.reference, self.logs)
        ids = [json.loads(line)["id"] for path in folder.glob("results-*.jsonl") for line in lines(path)]
        self.assertEqual(sorted(ids), sorted(f"pair {i}" for i in range(PAIRS)))
        for name in ("all.csv", "all.xml"):
            self.assertIn("pair 7", (folder / name).read_text())

    def test_0_the_recipe(self):
        folder = self.folder("recipe")
        folder.mkdir()
        (folder / "tools").symlink_to(SLURM.parent)
        write_pairs(folder)
        recipe = (SLURM.parents[1] / "docs" / "recipes" / "clusters" / "slurm.sh").read_text()
        done = subprocess.run(["bash", "-c", recipe], cwd=folder, env={**self.slurm.environment, "VKH_PROGRAM": str(PROGRAM)},
                              capture_output=True, text=True, timeout=120)
        self.of = folder / "results"
        self.assertEqual(done.returncode, FAIL, done.stderr + self.logs)
        array = (folder / "results" / "jobs").read_text().split()[0]
        job = self.slurm.run("scontrol", "show", "job", array).stdout
        for setting in ("Partition=gpu", "TimeLimit=01:00:00", "gpu:1", "ArrayTaskId=0"):
            self.assertIn(setting, job)
        self.assertEqual(len(lines(folder / "results" / "all.jsonl")), PAIRS)

    def test_1_what_is_killed_or_near_its_limit_goes_on(self):
        folder = self.folder("out 100%a & more")  # %a would be the task's number in a log's name
        waiting = self.submit(folder, "--wait", VKH_GRES="gpu:1")
        array = self.array(folder)
        os.kill(self.begun(folder / "results-2.jsonl"), signal.SIGKILL)
        self.begun(folder / "results-3.jsonl")
        self.slurm.run("scancel", "--batch", "--signal=USR1", f"{array}_3")
        self.ends(waiting, FAIL)
        self.whole(folder)
        for task, why in ((2, "killed by signal 9"), (3, "told that its time ends")):
            log = (folder / "logs" / f"task-{task}.log").read_text()
            had = re.search(rf"{why} after (\d+) lines: requeued", log)
            self.assertTrue(had, log)
            self.assertLess(int(had[1]), len(lines(folder / f"results-{task}.jsonl")), "it was too late to stop anything")
            self.assertIn("Restarts=1 ", self.slurm.run("scontrol", "show", "job", f"{array}_{task}").stdout)

    def test_2_what_is_cancelled_goes_on_where_it_was(self):
        folder = self.folder("cancelled")
        self.ends(self.submit(folder), 0)
        array, _ = (folder / "jobs").read_text().split()
        self.begun(folder / "results-0.jsonl")
        self.assertIn(f"job {array} still writes", self.ends(self.submit(folder), 2))
        self.slurm.run("scancel", array)
        self.until(lambda: "no result: pair" in self.logs, "a merge that misses pairs")
        kept = lines(folder / "results-0.jsonl")
        self.assertTrue(kept)
        self.assertIn("another folder", self.ends(self.submit(folder, VKH_SHARDS="7"), 2))
        self.ends(self.submit(folder, "--wait"), FAIL)
        self.whole(folder)
        self.assertEqual(lines(folder / "results-0.jsonl")[:len(kept)], kept)

    def test_3_what_is_preempted_goes_on(self):
        folder = self.folder("preempted")
        waiting = self.submit(folder, "--wait", VKH_PARTITION="gpu", VKH_SBATCH_MERGE="--partition=day")
        array = self.array(folder)
        self.begun(folder / "results-1.jsonl")
        self.slurm.run("sbatch", "--wait", "--partition=day", "--nodes=2", "--exclusive", f"--output={folder}/day.log", "--wrap", "sleep 1")
        self.ends(waiting, FAIL)
        self.whole(folder)
        self.assertIn("Restarts=1 ", self.slurm.run("scontrol", "show", "job", f"{array}_1").stdout)

    def test_4_by_hand_and_beside_a_former_process(self):
        folder = self.folder("by hand")
        folder.mkdir()
        with open(folder / "results-1.jsonl", "w") as former:
            fcntl.flock(former, fcntl.LOCK_EX)
            task = subprocess.Popen(["sbatch", "--wait", "--array=0-1", f"--output={folder}/%a.log", SLURM / "job.sh", "task", PROGRAM,
                                     self.list, folder, "2", "2", *OPTIONS], env=self.slurm.environment, stdout=subprocess.DEVNULL)
            self.addCleanup(task.kill)
            self.until(lambda: (folder / "code-0").exists(), "the other shard")
            self.until(lambda: "waits for another process" in (folder / "1.log").read_text(), "the wait")
            self.assertFalse(lines(folder / "results-1.jsonl"))
        self.assertEqual(task.wait(120), FAIL)
        self.assertIn(b"1\n", [(folder / f"code-{i}").read_bytes() for i in (0, 1)])

    def test_5_what_fails_of_itself_is_no_verdict(self):
        folder = self.folder("never")
        self.ends(self.submit(folder, SLURM_CONF="/dev/null"), 5)  # not 1, which is FAIL
        self.ends(self.submit(folder, VKH_PROGRAM="/nowhere"), 4)
        self.ends(self.submit(folder, VKH_SHARDS="many"), 2)
        self.assertFalse((folder / "jobs").exists())
        task = ["task", PROGRAM, self.list, self.root / "nowhere", "1", "1"]
        done = subprocess.run([SLURM / "job.sh", *task], env={**self.slurm.environment, "SLURM_ARRAY_TASK_ID": "0"}, capture_output=True)
        self.assertEqual((done.returncode, b"shared file system" in done.stdout), (6, True), done)
        done = subprocess.run([SLURM / "job.sh", *task], env=self.slurm.environment, capture_output=True)
        self.assertEqual(done.returncode, 6, "a variable that is not set")


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
    if missing():
        print(missing())
        sys.exit(77)
    unittest.main(verbosity=2)
