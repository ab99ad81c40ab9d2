#!/usr/bin/env python3
"""vkhausdorff.dask on a scheduler and two workers: what comes is what one process finds, also where a worker is killed.

usage: dask_test.py RECIPE. Exit code 77: Dask's distributed is not here.
"""

import logging
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import numpy as np  # noqa: E402
from spheres import meshes, write_pairs  # noqa: E402

RECIPE = pathlib.Path(sys.argv[1]).resolve()
PAIRS, SHARD = 20, 4
OPTIONS = {"tol": 1e-5}


def pair(i: int):
    return tuple(tuple(np.array(part) for part in meshes.sphere(n, radius)) for n, radius in ((50 + i, 1.0), (51 + i, 1.1)))


def by_index(results):
    return sorted(results, key=lambda r: r.index)


def claimed(devices):
    """Runs in a worker."""
    import vkhausdorff.dask

    return vkhausdorff.dask._device_of(devices)


class Dask(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = cls.enterClassContext(tempfile.TemporaryDirectory(prefix="vkh-dask-"))
        os.environ["TMPDIR"] = folder  # the workers' locks, too
        cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=2, processes=True, dashboard_address=None,
                                           local_directory=folder, silence_logs=logging.CRITICAL)
        cls.client = cls.enterClassContext(distributed.Client(cls.enterClassContext(cluster)))
        cls.pairs = [pair(i) for i in range(PAIRS)]
        cls.expected = by_index(vkh.distances(cls.pairs, **OPTIONS))

    def test_as_one_process_finds_it(self):
        found = list(distances(self.client, iter(self.pairs), shard=SHARD, **OPTIONS))
        self.assertEqual(by_index(found), self.expected)
        self.assertEqual([r.index for r in by_index(found)], list(range(PAIRS)))
        self.assertEqual(list(distances(self.client, [])), [])

    def test_ids_failures_and_one_b(self):
        named = [("first", *self.pairs[0]), (7, *self.pairs[1]), self.pairs[2], ("bad", "nowhere.ply", self.pairs[0][1]), "none"]
        found = by_index(distances(self.client, named, shard=2, **OPTIONS))
        self.assertEqual([r.id for r in found], ["first", 7, None, "bad", None])
        self.assertEqual([r.index for r in found], list(range(5)))
        self.assertEqual([type(r.error) for r in found], [type(None)] * 3 + [FileNotFoundError, TypeError])
        self.assertIn(str(pathlib.Path("nowhere.ply").resolve()), str(found[3].error))
        b = self.pairs[0][1]
        to_one = by_index(distances(self.client, [("x", self.pairs[1][0]), self.pairs[2][0]], against=b, shard=1, **OPTIONS))
        self.assertEqual(to_one, by_index(vkh.distances([("x", self.pairs[1][0]), self.pairs[2][0]], against=b, **OPTIONS)))
        self.assertEqual([r.id for r in to_one], ["x", None])

    def test_a_killed_workers_shard_is_done_again(self):
        found = distances(self.client, self.pairs, shard=SHARD, **OPTIONS)
        first = next(found)
        busy = self.until(lambda: [address for address, keys in self.client.processing().items() if keys])
        process = self.client.run(os.getpid, workers=busy[:1])[busy[0]]
        os.kill(process, signal.SIGKILL)
        self.assertEqual(by_index([first, *found]), self.expected)
        self.until(lambda: len(self.pids()) == 2 and process not in self.pids())

    def test_on_progress_reaches_one(self):
        names = ("first", *self.pairs[0]), ("bad", "nowhere.ply", self.pairs[0][1]), *self.pairs[:3]
        for pairs, is_counted in ((names, True), (iter(names), False)):
            heard = []
            found = list(distances(self.client, pairs, shard=2, on_progress=lambda *now: heard.append(now), **OPTIONS))
            self.assertEqual(len(found), len(heard))
            fractions, lowers, uppers = zip(*heard)
            self.assertEqual(fractions, tuple(sorted(fractions)))
            self.assertEqual(fractions[-1], 1)
            if is_counted:
                self.assertEqual(fractions, tuple((i + 1) / 5 for i in range(5)))
            good = [r for r in found if r.error is None]
            self.assertEqual((lowers[-1], uppers[-1]), (max(r.lower for r in good), max(r.upper for r in good)))
        heard = []
        self.assertEqual(list(distances(self.client, [], on_progress=lambda *now: heard.append(now))), [])
        self.assertEqual(heard, [(1, 0, 0)])

    def test_on_progress_may_end_it(self):
        found = list(distances(self.client, self.pairs, shard=SHARD, on_progress=lambda *now: now[0] < 0.1, **OPTIONS))
        self.assertEqual(len(found), 2)  # of 20
        self.until(lambda: not any(self.client.processing().values()))

    def pids(self):
        return list(self.client.run(os.getpid).values())

    def until(self, true, seconds=30):
        end = time.monotonic() + seconds
        while not (found := true()):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)
        return found

    def test_each_worker_takes_a_device_of_its_own(self):
        self.assertEqual(sorted(self.client.run(claimed, ("0", "1")).values()), ["0", "1"])
        self.assertEqual(list(self.client.run(claimed, ("cpu",)).values()), ["cpu", "cpu"])  # there is but one
        self.assertEqual(list(self.client.run(claimed, ()).values()), ["", ""])
        found = list(distances(self.client, self.pairs[:2], devices=["cpu"], **OPTIONS))
        self.assertEqual(by_index(found), self.expected[:2])

    def test_the_recipe(self):
        with tempfile.TemporaryDirectory() as folder:
            write_pairs(pathlib.Path(folder))
            self.client.write_scheduler_file(f"{folder}/scheduler.json")
            said = subprocess.run([sys.executable, RECIPE], cwd=folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(said.returncode, 0, said.stderr)
        lines = [re.fullmatch(r"(.*) \((.*), (.*)\)", line).groups() for line in said.stdout.splitlines()]
        self.assertEqual(sorted(name for name, _, _ in lines), sorted(f"pair {i}" for i in range(24)))
        self.assertTrue(said.stderr.splitlines()[-1].startswith("100 %"), said.stderr)
        self.assertTrue(all(0.1 < float(lower) <= float(upper) < 0.11 for _, lower, upper in lines), said.stdout)

    def test_what_is_wrong_is_said(self):
        for wrong in ({"device": "0"}, {"devices": "0"}):
            with self.assertRaisesRegex(TypeError, "a sequence of devices"):
                distances(self.client, self.pairs, **wrong)
        with self.assertRaisesRegex(TypeError, "^on_progress: expected a function"):
            distances(self.client, self.pairs, on_progress=1)
        with self.assertRaisesRegex(ValueError, "from 1"):
            distances(self.client, self.pairs, shard=0)
        with self.assertRaises(TypeError):
            list(distances(self.client, self.pairs, shard=SHARD, retries=0, no_such_option=1))
        self.until(lambda: not any(self.client.processing().values()))  # and nothing goes on


if __name__ == "__main__":
    try:
        import distributed
    except ImportError:
        print("no distributed here (Debian: python3-distributed)")
        sys.exit(77)
    import vkhausdorff as vkh
    from vkhausdorff.dask import distances

    unittest.main(argv=sys.argv[:1], verbosity=2)
