#!/usr/bin/env python3
"""distances() of the Python module: answers, order, failures, ends. Run through ctest.

That a stream's answers are those of each pair alone, whatever runs beside it: tests/app/stream_test.cpp.
"""
import collections
import gc
import inspect
import itertools
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest

import numpy as np
import vkhausdorff as vkh
from python_shapes import grid


def obj(folder, name, mesh):
    file = pathlib.Path(folder) / name
    vertices, faces = mesh
    file.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist()) +
                    "".join(f"f {a} {b} {c}\n" for a, b, c in (faces + 1).tolist()))
    return file


def by_index(results):
    results = sorted(results, key=lambda r: r.index)
    assert [r.index for r in results] == list(range(len(results))), results
    return results


PAIRS = [(grid(n, 0.01 * n), grid(3 + n % 4)) for n in range(2, 12)]
B = grid(6)


class Many(unittest.TestCase):
    def test_each_is_what_distance_says(self):
        for options in (dict(symmetric=True, together=3, lanes=2), dict(tol="0.1%", waves=5)):
            with self.subTest(**options):
                alone = {key: value for key, value in options.items() if key not in ("together", "lanes")}
                for r, (a, b) in zip(by_index(vkh.distances(PAIRS, **options)), PAIRS, strict=True):
                    self.assertEqual(r, vkh.distance(a, b, **alone))
                    self.assertIsNone(r.error)
                    self.assertIsNone(r.id)

    def test_a_shared_b_is_prepared(self):
        meshes = [a for a, _ in PAIRS]
        with vkh.Solver(B) as solver:
            expected = [solver.distance(a) for a in meshes]
        self.assertEqual(by_index(vkh.distances(meshes, against=B)), expected)
        named = by_index(vkh.distances({f"part {i}": mesh for i, mesh in enumerate(meshes)}.items(), against=B))
        self.assertEqual(named, expected)
        self.assertEqual([r.id for r in named], [f"part {i}" for i in range(len(meshes))])
        self.assertTrue(all(r.stats["hierarchy_ms"] == 0 for r in named))

    def test_a_limit(self):
        for limit, symmetric in ((0.1, False), ("5%", True)):
            for r, pair in zip(by_index(vkh.distances(PAIRS[:4], max=limit, symmetric=symmetric)), PAIRS):
                self.assertEqual(r, vkh.gate(*pair, limit, symmetric=symmetric))
                self.assertIn(r.verdict, ("pass", "fail"))

    def test_ids_and_forms_of_meshes(self):
        (va, fa), b = PAIRS[0]
        ids = [("a", 1), 7, "seven", None, ["list"]]
        forms = [(va, fa), [va.tolist(), fa.tolist()], types.SimpleNamespace(vertices=va, faces=fa),
                 types.SimpleNamespace(vertices=va, triangles=fa), (va.astype(">f8"), fa.astype(np.int16))]
        results = by_index(vkh.distances((id, a, b) for id, a in zip(ids, forms)))
        self.assertEqual([r.id for r in results], ids)
        self.assertEqual(results, 5 * [vkh.distance(va, fa, *b)])

    def test_the_example(self):
        done = subprocess.run([sys.executable, pathlib.Path(__file__).resolve().parents[1] / "package/distances_example.py"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.count("<= h <="), 5)
        self.assertIn("No such file or directory: 'gone.stl'", done.stdout)

    def test_nothing(self):
        self.assertEqual(list(vkh.distances([])), [])
        self.assertEqual(list(vkh.distances([], against=B)), [])

    def test_arguments(self):
        for wrong, kind, said in (
                (dict(tol=0), ValueError, "^tol: expected"), (dict(max=-1), ValueError, "^max: expected"),
                (dict(max=[1.0]), TypeError, "^max: expected"), (dict(max="0.1mm"), ValueError, "^max: expected"),
                (dict(ahead=0), ValueError, "^ahead: expected a whole number"), (dict(lanes="x"), TypeError, "^lanes: expected"),
                (dict(together=1.5), TypeError, "^together"), (dict(device=3.5), TypeError, "^device: expected"),
                (dict(device="0,,1"), ValueError, "^device: expected names between commas"),
                (dict(against=5), TypeError, "^against: expected .vertices, faces."), (dict(symmetric=1), TypeError, "^symmetric"),
                (dict(against="/nonesuch.ply"), FileNotFoundError, "nonesuch"), (dict(stranger=1), TypeError, "stranger")):
            with self.subTest(**wrong), self.assertRaisesRegex(kind, said):
                vkh.distances([], **wrong)
        with self.assertRaisesRegex(TypeError, "^pairs: expected an iterable of"):
            vkh.distances(5)
        for wrong, kind, said in ((dict(device="nonesuch"), vkh.DeviceError, "no usable Vulkan device matches 'nonesuch'"),
                                  (dict(device="cpu,cpu"), ValueError, "named more than once"),
                                  (dict(preset="pape"), ValueError, "preset: expected 'default', 'paper' or 'baseline-gpu'"),
                                  (dict(disable=["u9"]), ValueError, "'u9'")):
            with self.subTest(**wrong), self.assertRaisesRegex(kind, said):
                list(vkh.distances(PAIRS, **wrong))
        self.assertTrue(str(inspect.signature(vkh.distances)).startswith("(pairs, *, on_progress=None, against=None, ahead=None, max=None, tol=None"))

    def test_two_threads(self):
        ends = {}

        def work(name):
            ends[name] = by_index(vkh.distances(PAIRS))

        threads = [threading.Thread(target=work, args=(name,)) for name in "ab"]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(ends["a"], ends["b"])
        self.assertEqual(len(ends["a"]), len(PAIRS))

    def test_one_iterator_is_for_one_thread_at_a_time(self):
        results, errors = [], []
        stream = vkh.distances(itertools.islice(itertools.cycle(PAIRS), 100))

        def work():
            try:
                results.extend(stream)
            except ValueError as error:
                errors.append(str(error))

        threads = [threading.Thread(target=work) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertLessEqual(set(errors), {"generator already executing"})
        self.assertEqual(len(results), 100)


class Failures(unittest.TestCase):
    def test_a_pair_that_fails_ends_nothing(self):
        (va, fa), b = PAIRS[0]

        class Torn:
            faces = fa

            @property
            def vertices(self):
                raise LookupError("torn")

        with tempfile.TemporaryDirectory() as folder:
            bad = pathlib.Path(folder) / "bad.obj"
            bad.write_text("v 0 0\nf 1 2 3\n")
            wrong = [
                ((va, fa), "not there", FileNotFoundError, "not there"), ((va, fa), folder, IsADirectoryError, "."),
                (bad, b, ValueError, r"bad\.obj: line 1"), (5, TypeError, r"^pairs: expected \(a, b\) or \(id, a, b\), not int$"),
                ("id", (va, fa + 1000), b, ValueError, "A's faces: face 0 has index 1000"),
                ("id", (va * np.nan, fa), b, ValueError, "A: vertex 0: .* is not finite"),
                (b, (va, fa[:0]), ValueError, "B: face 0: there is no face"), (Torn(), b, LookupError, "torn"),
                (b, 3, TypeError, "^b: expected .vertices, faces."), ("", b, ValueError, "^a: expected the path")]
            given = []
            for *pair, _, _ in wrong:
                given += [PAIRS[1], tuple(pair) if len(pair) > 1 else pair[0]]
            results = by_index(vkh.distances(given))
        expected = vkh.distance(*PAIRS[1])
        self.assertEqual(results[::2], len(wrong) * [expected])
        for r, (*pair, kind, said) in zip(results[1::2], wrong, strict=True):
            self.assertIs(type(r.error), kind, r)
            self.assertRegex(str(r.error), said)
            self.assertEqual(r.id, "id" if len(pair) == 3 else None)
            self.check_failed(r, kind)
        self.assertEqual([getattr(r.error, "file", None) for r in results[1::2]],
                         ["not there", folder, str(bad), None, None, "A", "B", None, None, None])
        self.assertEqual([getattr(r.error, "place", None) for r in results[1::2]],
                         [None, None, "line 1", None, None, "vertex 0", "face 0", None, None, None])

    def check_failed(self, r, kind):
        for name in ("lower", "upper", "closed", "status", "verdict", "witness_a", "face_b", "stats", "field", "mean", "survey_met"):
            with self.assertRaises(kind) as raised:
                getattr(r, name)
            self.assertIs(raised.exception, r.error)
        with self.assertRaises(kind):
            r.area_within(1)
        self.assertIn(kind.__name__, repr(r))
        again = pickle.loads(pickle.dumps(r))
        self.assertEqual((again, again.index, again.id, type(again.error)), (r, r.index, r.id, kind))
        self.assertEqual(r.to_dict()["error"], {"type": kind.__name__, "message": str(r.error)})
        self.assertNotEqual(r, vkh.distance(*PAIRS[0]))
        self.assertIsInstance(hash(r), int)

    def test_results_keep_their_place(self):
        r = next(vkh.distances([("name", *PAIRS[0])]))
        again = pickle.loads(pickle.dumps(r))
        self.assertEqual((again, again.index, again.id, again.error), (r, 0, "name", None))
        self.assertEqual((r.to_dict()["index"], r.to_dict()["id"]), (0, "name"))
        alone = vkh.distance(*PAIRS[0])
        self.assertEqual((alone, alone.index, alone.id, alone.error), (r, None, None, None))

    def test_pairs_that_raise(self):
        def pairs(many):
            yield from PAIRS[:many]
            raise LookupError("no more")

        for many in (0, 1, 10):
            results = []
            with self.assertRaisesRegex(LookupError, "no more"):
                for r in vkh.distances(pairs(many)):
                    results.append(r)
            self.assertEqual(len(by_index(results)), many)

        def interrupted():
            yield PAIRS[0]
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            list(vkh.distances(interrupted()))


class Ahead(unittest.TestCase):
    def taken(self, **options):
        """The number of pairs taken from an endless iterable when so many answers were yielded."""
        taken = []

        def pairs():
            for i in itertools.count():
                taken.append(i)
                yield PAIRS[i % len(PAIRS)]

        stream = vkh.distances(pairs(), **options)
        counts = []
        for _, r in zip(range(20), stream):
            counts.append(len(taken))
        stream.close()
        return counts

    def test_no_more_than_was_said(self):
        for ahead in (1, 2, 7):
            self.assertTrue(all(count <= yielded + ahead for yielded, count in enumerate(self.taken(ahead=ahead))))
        self.assertTrue(all(count <= yielded + 96 for yielded, count in enumerate(self.taken())))
        self.assertTrue(all(count <= yielded + 8 for yielded, count in enumerate(self.taken(lanes=2, together=2))))

    def test_large_files_come_one_by_one(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "large.glb"
            with open(file, "wb") as out:
                out.truncate(1 << 30)  # no mesh, and nothing on the disk
            taken = []
            pairs = (taken.append(i) or (file, file) for i in itertools.count())
            with vkh.distances(pairs) as stream:
                for yielded in range(4):
                    self.assertIsInstance(next(stream).error, ValueError)
                    self.assertLessEqual(len(taken), yielded + 1)

    def test_what_is_there_does_not_wait_for_slow_pairs(self):
        def pairs():
            for i in itertools.count():
                yield PAIRS[0]
                time.sleep(0.2)

        stream = vkh.distances(pairs())
        next(stream)
        started = time.monotonic()
        for _, r in zip(range(3), stream):
            pass
        self.assertLess(time.monotonic() - started, 10)
        stream.close()

    def test_taken_on_the_thread_that_asks(self):
        threads = set()
        list(vkh.distances((threads.add(threading.get_ident()) or pair for pair in PAIRS[:5])))
        self.assertEqual(threads, {threading.get_ident()})


def entries(of):
    return len(os.listdir("/proc/self/" + of))


def threads_at_work():
    """The threads of this process, without those that wait for loops to share (host/base/parallel.cpp), which never end."""
    names = []
    for task in pathlib.Path("/proc/self/task").iterdir():
        try:
            names.append((task / "comm").read_text().strip())
        except OSError:  # it has ended
            pass
    return len(names) - names.count("vkh-left")


def resident():
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Endings(unittest.TestCase):
    def setUp(self):
        list(vkh.distances(PAIRS[:3]))  # memory that libraries keep
        gc.collect()

    def settle(self, threads):
        end = time.monotonic() + 10
        while threads_at_work() > threads and time.monotonic() < end:
            time.sleep(0.01)
        self.assertLessEqual(threads_at_work(), threads)

    def test_early(self):
        threads, files = threads_at_work(), entries("fd")

        def leave():
            for r in vkh.distances(itertools.cycle(PAIRS)):
                if r.index > 3:
                    break

        def close():
            stream = vkh.distances(itertools.cycle(PAIRS))
            next(stream)
            stream.close()
            stream.close()
            self.assertEqual(list(stream), [])

        def drop():
            vkh.distances(itertools.cycle(PAIRS))
            stream = vkh.distances(itertools.cycle(PAIRS))
            next(stream)
            ring = [stream]
            ring.append(ring)
            del stream, ring
            gc.collect()

        def fail():
            with self.assertRaisesRegex(LookupError, "enough"):
                for r in vkh.distances(itertools.cycle(PAIRS)):
                    raise LookupError("enough")

        def by_another():
            stream = vkh.distances([(grid(80), grid(7))] * 300, tol=1e-7, memory=1 << 18, disable=["centroid", "parent_samples", "u3"],
                                   ahead=3)
            threading.Timer(0.5, stream.close).start()
            self.assertLess(len(list(stream)), 300)

        def within():
            with vkh.distances(itertools.cycle(PAIRS)) as stream:
                self.assertIs(iter(stream), stream)
                next(stream)
            self.assertEqual(list(stream), [])

        for end in (leave, close, drop, fail, by_another, within):
            with self.subTest(end.__name__):
                started = time.monotonic()
                end()
                self.settle(threads)
                self.assertLessEqual(entries("fd"), files)
                self.assertLess(time.monotonic() - started, 30)
        self.assertTrue(vkh.distance(*PAIRS[0]).closed)  # as good as new

    def test_keyboard_interrupt(self):
        threads = threads_at_work()
        timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
        started = time.monotonic()
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            for r in vkh.distances(itertools.cycle([(grid(80), grid(7))]), tol=1e-7, memory=1 << 18,
                                   disable=["centroid", "parent_samples", "u3"]):
                pass
        self.assertLess(time.monotonic() - started, 30)
        timer.join()
        self.settle(threads)

    def test_other_threads_run_meanwhile(self):
        ticks, stop = [], threading.Event()

        def tick():
            while not stop.wait(0.001):
                ticks.append(time.monotonic())

        thread = threading.Thread(target=tick)
        thread.start()
        started = time.monotonic()
        list(vkh.distances([(grid(80), grid(7))], tol=1e-7, waves=2))
        ended = time.monotonic()
        stop.set()
        thread.join()
        self.assertGreater(sum(started < t < ended for t in ticks), (ended - started) / 0.05)

    def test_many_take_no_more_memory(self):
        small = [(grid(2, 0.1 * i), grid(1)) for i in range(5)]
        seen, size = 0, {}
        with tempfile.TemporaryDirectory() as folder:
            files = obj(folder, "a.obj", small[0][0]), obj(folder, "b.obj", small[0][1])
            pairs = (files if i % 2 else small[i % 5] for i in range(2000))
            kinds = collections.Counter()
            for r in vkh.distances(pairs, tol=1e-3):
                kinds[r.status] += 1
                seen += 1
                if seen in (500, 2000):
                    size[seen] = resident()
        self.assertEqual(seen, 2000)
        self.assertEqual(set(kinds), {"closed"})
        slack = (64 if "asan" in os.environ.get("LD_PRELOAD", "") else 16) << 20
        self.assertLess(size[2000], size[500] + slack, size)


if __name__ == "__main__":
    unittest.main()
