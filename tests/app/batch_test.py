"""The commands batch and merge as people run them: what is done stays done, whatever ends the program.

usage: batch_test.py PROGRAM [--kills N] [TEST...]
Which options a key has: options_test.cpp. Answers of streams and of a shared B: stream_test.cpp.
"""

import csv
import hashlib
import json
import os
import pathlib
import random
import re
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = os.path.abspath(sys.argv[1])
WORDS = sys.argv[2:]
KILLS = 3
if WORDS[:1] == ["--kills"]:
    KILLS, WORDS = int(WORDS[1]), WORDS[2:]
FLOATS = ("lower_hex", "upper_hex")


def write_mesh(path, lift, size=6, seed=0):
    """A bumpy square of 2 size^2 faces, OBJ."""
    random_bumps = random.Random(seed)
    lines = [f"v {x} {y} {lift + random_bumps.random() / 8}" for y in range(size + 1) for x in range(size + 1)]
    for y in range(size):
        for x in range(size):
            i = y * (size + 1) + x + 1
            lines += [f"f {i} {i + 1} {i + size + 2}", f"f {i} {i + size + 2} {i + size + 1}"]
    path.write_text("\n".join(lines) + "\n")


class Folder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_words(self, *words, env=None, timeout=300):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=timeout,
                              env={**os.environ, **(env or {})})

    def make_pairs(self, count, size=6):
        """Meshes and LIST.jsonl; returns the ids."""
        rows = []
        for i in range(count):
            write_mesh(self.folder / f"{i}_a.obj", 0, size, i)
            write_mesh(self.folder / f"{i}_b.obj", i + 1, size, 1000 + i)
            rows.append({"id": f"pair {i}", "a": f"{i}_a.obj", "b": f"{i}_b.obj"})
        self.write_list(rows)
        return [row["id"] for row in rows]

    def write_list(self, rows, name="list.jsonl"):
        (self.folder / name).write_text("".join(json.dumps(row) + "\n" for row in rows))

    def results(self, name="out.jsonl"):
        return [json.loads(line) for line in (self.folder / name).read_text().splitlines()]

    def merged(self, *files):
        """The part of the results that two runs share, as bytes."""
        done = self.run_words("merge", *(files or ["out.jsonl"]), "--out", "merged.jsonl", "--reproducible")
        self.assertIn(done.returncode, (0, 1, 3, 4), done.stderr)
        return (self.folder / "merged.jsonl").read_bytes()


class Answers(Folder):
    def test_a_line_a_pair_as_distance_says(self):
        ids = self.make_pairs(5)
        done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--together", "2", "--lanes", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("5 of 5 pairs", done.stdout.splitlines()[0])
        results = {line["id"]: line for line in self.results()}
        self.assertEqual(sorted(results), sorted(ids))
        for i, name in enumerate(ids):
            alone = json.loads(self.run_words("distance", f"{i}_a.obj", f"{i}_b.obj", "--json").stdout)
            self.assertEqual([results[name]["interval"][key] for key in FLOATS], [alone["interval"][key] for key in FLOATS])
            self.assertEqual(results[name]["directions"][0]["witness"], alone["directions"][0]["witness"])
            self.assertEqual(list(results[name])[-1], "run")

    def test_junit_has_notes_on_polygons(self):
        (self.folder / "quad.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 2\n")
        self.write_list([{"id": "quads", "a": "quad.obj", "b": "quad.obj"}])
        done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--junit=out.xml")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "out.xml").read_text()
        for side in "AB":
            self.assertIn(f"\n{side}: polygons: 1 face of more than three corners was triangulated", text)
        self.assertIn("polylines", text)

    def test_limits_and_options_of_a_pair(self):
        self.make_pairs(3)
        self.write_list([{"id": "in", "a": "0_a.obj", "b": "0_b.obj", "max": "1.2abs"},
                         {"id": "out", "a": "1_a.obj", "b": "1_b.obj", "max": "1.2abs", "symmetric": True},
                         {"id": "percent", "a": "1_a.obj", "b": "1_b.obj", "max": "90%"},
                         {"id": "no limit", "a": "2_a.obj", "b": "2_b.obj", "tol": 1e-3}])
        done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--csv=out.csv", "--junit=out.xml")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertTrue(done.stdout.startswith("FAIL"), done.stdout)
        results = {line["id"]: line for line in self.results()}
        self.assertEqual({name: line.get("verdict") for name, line in results.items()},
                         {"in": "pass", "out": "fail", "percent": "pass", "no limit": None})
        self.assertEqual(len(results["out"]["directions"]), 2)
        self.assertEqual({name: line["tolerance"]["requested"] for name, line in results.items()},
                         {"in": "1e-7", "out": "1e-7", "percent": "1e-7", "no limit": "0.001"})
        with (self.folder / "out.csv").open(newline="") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual([row["id"] for row in rows], ["out", "no limit", "in", "percent"], "the worst first")
        worst = [line[13:] for line in done.stdout.splitlines() if line.startswith(("  worst ", "             "))][:4]
        self.assertEqual([line.split()[0] for line in worst], ["FAIL", "CLOSED", "PASS", "PASS"])
        self.assertRegex(worst[0], r"^FAIL  at least [0-9.]+, 1\.[0-9]+ times its limit  out$")
        for row in rows:
            if row["verdict"] == "fail":  # no upper end was sought
                self.assertEqual((row["upper"], row["gap"]), ("", ""))
            else:
                self.assertLessEqual(float(row["lower"]), float(row["upper"]))

    def test_a_shared_b(self):
        self.make_pairs(3)
        done = self.run_words("batch", *(f"{i}_a.obj" for i in range(3)), "--against", "1_b.obj", "--out", "out.jsonl")
        self.assertEqual(done.returncode, 0, done.stderr)
        inputs = [[side["path"] for side in line["inputs"]] for line in self.results()]
        self.assertEqual(sorted(inputs), [[f"{i}_a.obj", "1_b.obj"] for i in range(3)])

    def test_failures_are_lines_and_end_nothing(self):
        self.make_pairs(3)
        (self.folder / "bad.obj").write_text("v 0 0 zero\n")
        self.write_list([{"id": "bad", "a": "bad.obj", "b": "0_b.obj"}, {"id": "good", "a": "1_a.obj", "b": "1_b.obj"},
                         {"id": "missing", "a": "none.obj", "b": "0_b.obj"}, {"id": "unit", "a": "2_a.obj", "b": "2_b.obj", "max": "1mm"},
                         {"id": "length", "a": "2_a.obj", "b": "2_b.obj", "tol": "much"}])
        done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl")
        self.assertEqual(done.returncode, 4, done.stderr)
        results = {line["id"]: line for line in self.results()}
        self.assertEqual({name: line["code"] for name, line in results.items()},
                         {"bad": 4, "good": 0, "missing": 4, "unit": 2, "length": 2})
        self.assertEqual(results["bad"]["error"]["file"], "bad.obj")
        self.assertIn("line 1", results["bad"]["error"]["place"])
        # A file that was missing, or was fixed, is tried again; the rest is not.
        write_mesh(self.folder / "none.obj", 0)
        write_mesh(self.folder / "bad.obj", 0)
        done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)
        again = [line["id"] for line in self.results()[5:]]
        self.assertEqual(sorted(again), ["bad", "length", "missing"])

    def test_fail_fast(self):
        self.make_pairs(20)
        done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--max", "1.05abs", "--fail-fast", "--together", "1")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertLess(len(self.results()), 20)

    def test_what_is_refused(self):
        self.make_pairs(2)
        before = (self.folder / "0_a.obj").read_bytes()
        for words in (["--out", "0_a.obj"], ["--out", "list.jsonl"], ["--out", "."], ["--out", "none/out.jsonl"],
                      ["--out", "out.jsonl", "--shard", "2/2"], ["--out", "out.jsonl", "--max", "0.1"],
                      ["--out", "out.jsonl", "--device", "0,0"], ["--out", "out.jsonl", "--csv=out.jsonl"]):
            done = self.run_words("batch", "list.jsonl", *words)
            self.assertEqual(done.returncode, 2, (words, done.stderr))
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertEqual((self.folder / "0_a.obj").read_bytes(), before)
        (self.folder / "list.jsonl").write_text('{"id":"x","a":"0_a.obj","b":"0_b.obj"}\n{"id":"x","a":"1_a.obj","b":"1_b.obj"}\n')
        done = self.run_words("batch", "list.jsonl", "--out", "other.jsonl")
        self.assertEqual(done.returncode, 4)
        self.assertIn("list.jsonl: line 2: the id 'x'", done.stderr)


class Interrupted(Folder):
    def test_resumed_after_any_byte(self):
        self.make_pairs(4)
        self.assertEqual(self.run_words("batch", "list.jsonl", "--out", "out.jsonl").returncode, 0)
        whole, truth = (self.folder / "out.jsonl").read_bytes(), self.merged()
        refused = self.run_words("batch", "list.jsonl", "--out", "out.jsonl")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("has results: add --resume", refused.stderr)
        for cut in (1, whole.index(b"\n"), len(whole) // 2, len(whole) - 1):
            (self.folder / "out.jsonl").write_bytes(whole[:cut])
            done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--resume")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.merged(), truth)
            self.assertEqual(len(self.results()), 4)

    def test_killed_at_random_moments(self):
        """No pair with a line is lost or done again."""
        self.make_pairs(40, size=4)
        self.assertEqual(self.run_words("batch", "list.jsonl", "--out", "truth.jsonl").returncode, 0)
        truth = self.merged("truth.jsonl")
        moments = random.Random(5)
        kept = b""
        for kill in range(KILLS):
            running = subprocess.Popen([PROGRAM, "batch", "list.jsonl", "--out", "out.jsonl", "--resume"], cwd=self.folder,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(moments.uniform(0.1, 1.5))
            running.send_signal(moments.choice([signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT]))
            running.wait(60)
            if not (self.folder / "out.jsonl").exists():
                continue
            now = (self.folder / "out.jsonl").read_bytes()
            self.assertTrue(now.startswith(kept[:kept.rfind(b"\n") + 1]))
            kept = now
            if now.count(b"\n") == 40:
                self.assertEqual(self.merged(), truth)
                (self.folder / "out.jsonl").unlink()
                kept = b""
        self.assertEqual(self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--resume").returncode, 0)
        self.assertEqual(self.merged(), truth)
        self.assertEqual(len(self.results()), 40)

    def test_stopped_with_a_word(self):
        self.make_pairs(60, size=20)
        running = subprocess.Popen([PROGRAM, "batch", "list.jsonl", "--out", "out.jsonl"], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while not (self.folder / "out.jsonl").exists() or not (self.folder / "out.jsonl").read_bytes():
            self.assertIsNone(running.poll())
            time.sleep(0.01)
        running.send_signal(signal.SIGTERM)
        out, err = running.communicate(timeout=60)
        self.assertEqual(running.returncode, 3, err)
        done = len(self.results())
        self.assertLess(done, 60)
        self.assertIn(f"{done} of 60 pairs", out)
        self.assertIn(f"{60 - done} left", out)

    def test_one_process_at_a_time(self):
        self.make_pairs(60, size=20)
        running = subprocess.Popen([PROGRAM, "batch", "list.jsonl", "--out", "out.jsonl"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (self.folder / "out.jsonl").exists():
            time.sleep(0.01)
        time.sleep(0.05)
        second = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--resume")
        running.kill()
        running.wait(60)
        self.assertEqual(second.returncode, 2)
        self.assertIn("another process", second.stderr)

    def test_other_options_are_done_again(self):
        self.make_pairs(4)
        self.run_words("batch", "list.jsonl", "--out", "out.jsonl")
        self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--resume", "--tol", "1e-3")
        self.assertEqual(len(self.results()), 8)
        write_mesh(self.folder / "2_a.obj", 0.5)
        done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--resume", "--tol", "1e-3")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([line["id"] for line in self.results()[8:]], ["pair 2"])
        self.assertEqual(len(self.merged().splitlines()), 4)

    def test_a_failure_that_is_kept_keeps_its_reason(self):
        self.make_pairs(2)
        (self.folder / "0_a.obj").write_text("v 0 0 zero\n")
        first = self.run_words("batch", "list.jsonl", "--out", "out.jsonl")
        again = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--resume")
        for done in (first, again):
            self.assertEqual(done.returncode, 4)
            failed = [line for line in done.stdout.splitlines() if line.startswith("  failed")]
            self.assertEqual(len(failed), 1, done.stdout)
            self.assertIn("pair 0: 0_a.obj: line 1", failed[0])
        self.assertEqual(len(self.results()), 2)

    def test_a_file_beyond_the_limit_is_read_under_a_larger_one(self):
        self.make_pairs(2)
        self.assertEqual(self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--max-input", "100").returncode, 4)
        done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--max-input", "1M", "--resume")
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_a_full_disk(self):
        self.make_pairs(8)

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000))

        done = subprocess.run([PROGRAM, "batch", "list.jsonl", "--out", "out.jsonl", "--no-cache"], cwd=self.folder,
                              capture_output=True, text=True, preexec_fn=limit, timeout=120)
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertIn("--out 'out.jsonl': cannot be written", done.stderr)
        before = self.results()
        self.assertTrue(0 < len(before) < 8)
        self.assertEqual(self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--resume").returncode, 0)
        self.assertEqual(self.results()[:len(before)], before)
        self.assertEqual(len(self.results()), 8)

    def test_an_input_that_vanishes(self):
        self.make_pairs(30, size=20)
        running = subprocess.Popen([PROGRAM, "batch", "list.jsonl", "--out", "out.jsonl", "--read-ahead", "100K"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        while not (self.folder / "out.jsonl").exists() or not (self.folder / "out.jsonl").read_bytes():
            time.sleep(0.01)
        (self.folder / "29_b.obj").unlink()
        running.communicate(timeout=120)
        self.assertEqual(running.returncode, 4)
        codes = {line["id"]: line["code"] for line in self.results()}
        self.assertEqual(len(codes), 30)
        self.assertEqual([name for name, code in codes.items() if code], ["pair 29"])


LAYER = os.environ.get("VKH_LAYER_FOLDER")


@unittest.skipIf(not LAYER, "no test layer")
class Counts(Folder):
    """Submissions to the device, which the test layer counts (docs/test_layer.md)."""

    def submissions(self, *words):
        counts = self.folder / "counts"
        counts.unlink(missing_ok=True)
        (self.folder / "out.jsonl").unlink(missing_ok=True)
        done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", *words,
                              env={"VK_LAYER_PATH": f"{LAYER}:/usr/share/vulkan/explicit_layer.d",
                                   "VK_INSTANCE_LAYERS": "VK_LAYER_VKH_test", "NODEVICE_SELECT": "1", "VKH_LAYER_COUNT": str(counts)})
        self.assertIn(done.returncode, (0, 3), done.stderr)
        return int(re.search(r"^vkQueueSubmit (\d+)$", counts.read_text(), re.M)[1])

    # Without effort no cell is split, so that no clock decides how many submissions a survey takes.
    def test_a_pair_with_sides_and_a_page_is_surveyed_once(self):
        self.make_pairs(1)
        bare = self.submissions()
        sided = self.submissions("--signed", "--effort", "0")
        page = self.submissions("--report-dir", "pages", "--effort", "0")
        self.assertGreater(sided, bare)
        self.assertGreater(page, bare)
        both = self.submissions("--signed", "--report-dir", "both", "--effort", "0")
        self.assertLess(both, page + sided - bare)  # a second survey would take as many as the first


@unittest.skipIf(not LAYER, "no test layer")
class Faults(Folder):
    """A device that is lost (docs/test_layer.md)."""

    def run_lost(self, fault, *words):
        return self.run_words("batch", "list.jsonl", "--out", "out.jsonl", *words,
                              env={"VK_LAYER_PATH": f"{LAYER}:/usr/share/vulkan/explicit_layer.d",
                                   "VK_INSTANCE_LAYERS": "VK_LAYER_VKH_test", "NODEVICE_SELECT": "1", "VKH_LAYER_FAIL": fault})

    def test_it_is_opened_anew(self):
        self.make_pairs(12)
        self.assertEqual(self.run_words("batch", "list.jsonl", "--out", "truth.jsonl").returncode, 0)
        truth = self.merged("truth.jsonl")
        lanes = ("--together", "4", "--lanes", "2")
        for fault, words in (("vkQueueSubmit:1:VK_ERROR_DEVICE_LOST", lanes), ("vkQueueSubmit:9:VK_ERROR_DEVICE_LOST", ()),
                             ("vkWaitForFences:5:VK_ERROR_DEVICE_LOST", lanes), ("vkAllocateMemory:4:VK_ERROR_OUT_OF_DEVICE_MEMORY", ())):
            done = self.run_lost(fault, *words)
            self.assertEqual(done.returncode, 0, (fault, done.stderr))
            self.assertEqual(self.merged(), truth)
            (self.folder / "out.jsonl").unlink()

    @unittest.skipIf(os.environ.get("VKH_SANITIZED"), "the layer's own leaks cannot be told apart (tools/test)")
    def test_the_validation_layer_is_silent(self):
        self.make_pairs(8)
        self.write_list([{"id": str(i), "a": f"{i}_a.obj", "b": f"{i % 3}_b.obj", "symmetric": i % 2 == 0} for i in range(8)])
        done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--together", "3", "--lanes", "2",
                              env={"VK_INSTANCE_LAYERS": "VK_LAYER_KHRONOS_validation",
                                   "VK_LAYER_ENABLES": "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT"})
        self.assertEqual(done.returncode, 0, done.stderr)
        for text in (done.stdout, done.stderr):
            self.assertNotIn("VUID", text)
            self.assertNotIn("SYNC-HAZARD", text)
            self.assertNotIn("Validation", text)

    def test_one_that_is_always_lost_ends_the_batch(self):
        self.make_pairs(6)
        done = self.run_lost("vkQueueSubmit:7+:VK_ERROR_DEVICE_LOST", "--together", "1")
        self.assertEqual(done.returncode, 5, done.stderr)
        kept = [line for line in self.results() if line["code"] == 0]
        self.assertGreater(len(kept), 0)
        done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([line for line in self.results() if line["code"] == 0][:len(kept)], kept)
        self.assertEqual(len(self.merged().splitlines()), 6)


class Beneath(Folder):
    """A glTF document's numbers lie in a file beneath it, which no list names."""

    def write_scene(self, height):
        corners = struct.pack("<9f", 0, 0, height, 1, 0, height, 0, 1, height)
        (self.folder / "a.bin").write_bytes(corners)
        (self.folder / "a.gltf").write_text(json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": len(corners)}],
            "buffers": [{"uri": "a.bin", "byteLength": len(corners)}]}))

    def setUp(self):
        super().setUp()
        self.write_scene(0.25)
        (self.folder / "b.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.write_list([{"id": "one", "a": "a.gltf", "b": "b.obj"}])

    def batch(self, *words, out="out.jsonl"):
        return self.run_words("batch", "list.jsonl", "--out", out, "--max", "0.5m", *words)

    def test_a_changed_file_is_done_again(self):
        self.assertEqual(self.batch().returncode, 0)
        first = self.results()[0]
        self.assertEqual([file["path"] for file in first["inputs"][0]["files"]], ["a.bin"])
        self.assertEqual(first["inputs"][0]["files"][0]["sha256"], hashlib.sha256((self.folder / "a.bin").read_bytes()).hexdigest())
        self.assertEqual(first["inputs"][1]["files"], [])
        self.assertEqual(self.batch("--resume").returncode, 0)
        self.assertEqual(len(self.results()), 1)
        document = (self.folder / "a.gltf").read_bytes()
        self.write_scene(7)
        self.assertEqual((self.folder / "a.gltf").read_bytes(), document)
        done = self.batch("--resume")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertTrue(done.stdout.startswith("FAIL"), done.stdout)
        self.assertEqual([line["verdict"] for line in self.results()], ["pass", "fail"])
        self.assertEqual(json.loads(self.merged())["verdict"], "fail")

    def test_one_that_is_shared_as_b(self):
        self.write_list([{"id": str(i), "a": "b.obj", "b": "a.gltf"} for i in range(3)])
        self.assertEqual(self.batch().returncode, 0)
        self.write_scene(7)
        self.assertEqual(self.batch("--resume").returncode, 1)
        self.assertEqual(len(self.results()), 6)

    def test_one_that_was_missing_is_read_once_it_is_there(self):
        corners = (self.folder / "a.bin").read_bytes()
        (self.folder / "a.bin").unlink()
        self.assertEqual(self.batch().returncode, 4)
        self.assertEqual(self.results()[0]["inputs"][0]["files"], [{"path": "a.bin", "sha256": None}])
        self.assertEqual(self.batch("--resume").returncode, 4)
        self.assertEqual(len(self.results()), 1)
        (self.folder / "a.bin").write_bytes(corners)
        self.assertEqual(self.batch("--resume").returncode, 0)

    def test_shards_of_different_geometry_do_not_merge(self):
        self.batch(out="0.jsonl")
        self.write_scene(7)
        self.batch(out="1.jsonl")
        done = self.run_words("merge", "0.jsonl", "1.jsonl", "--out", "merged.jsonl")
        self.assertEqual(done.returncode, 4, done.stdout)
        self.assertIn("'one' has other inputs", done.stderr)
        self.assertFalse((self.folder / "merged.jsonl").exists())

    def test_parts_of_different_geometry_do_not_merge(self):
        write_mesh(self.folder / "two.obj", 0, size=1)
        for i, height in enumerate((0.25, 7)):
            self.write_scene(height)
            part = self.run_words("distance", "two.obj", "a.gltf", "--part", f"{i}/2", f"--json={i}.json")
            self.assertEqual(part.returncode, 0, part.stderr)
        done = self.run_words("merge", "0.json", "1.json", "--out", "merged.json")
        self.assertEqual(done.returncode, 4, done.stdout)
        self.assertIn("another file beneath B", done.stderr)

    def test_a_line_of_an_older_program_is_done_again(self):
        """The key was only the document's, so that the shape is unknown."""
        self.batch()
        line = self.results()[0]
        digests = [side["sha256"] for side in line["inputs"]]
        no_waves = "4294967295"
        parts = [line["version"], *digests, line["tolerance"]["requested"], line["max"]["requested"], "", "", "", "", "inf", no_waves, "0"]
        line["key"] = hashlib.sha256("\n".join(parts).encode()).hexdigest()  # as 0.1.0 made it
        for side in line["inputs"]:
            del side["files"]
        (self.folder / "out.jsonl").write_text(json.dumps(line, separators=(",", ":")) + "\n")
        self.write_scene(7)
        done = self.batch("--resume")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertEqual(len(self.results()), 2)

    def test_an_answer_and_a_report_name_it(self):
        done = self.run_words("distance", "a.gltf", "b.obj", "--json", "--report", "out.html")
        digest = hashlib.sha256((self.folder / "a.bin").read_bytes()).hexdigest()
        self.assertEqual(json.loads(done.stdout)["inputs"][0]["files"], [{"path": "a.bin", "sha256": digest}])
        page = (self.folder / "out.html").read_text()
        self.assertIn(digest, page.split("other files read", 1)[1].split("</tr>", 1)[0])


class Merged(Folder):
    def test_what_does_not_go_together(self):
        self.make_pairs(2)
        self.run_words("batch", "list.jsonl", "--out", "0.jsonl")
        self.run_words("batch", "list.jsonl", "--out", "1.jsonl", "--tol", "1e-3")
        done = self.run_words("merge", "0.jsonl", "1.jsonl", "--out", "out.jsonl")
        self.assertEqual(done.returncode, 4)
        self.assertIn("pair 0", done.stderr)
        (self.folder / "2.jsonl").write_text('{"schema":"other"}\n')
        done = self.run_words("merge", "0.jsonl", "2.jsonl", "--out", "out.jsonl")
        self.assertEqual(done.returncode, 4)
        self.assertIn("2.jsonl: line 1", done.stderr)
        self.assertFalse((self.folder / "out.jsonl").exists())
        done = self.run_words("merge", "0.jsonl", "--out", "0.jsonl")
        self.assertEqual(done.returncode, 2)


class Memory(Folder):
    @unittest.skipIf(os.environ.get("VKH_SANITIZED"), "a sanitizer keeps what is freed")
    def test_it_is_bounded(self):
        """Six hundred pairs take no more memory than a hundred: under 34 KB a pair."""
        most = []
        for count in (100, 600):
            self.make_pairs(count, size=2)
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
            done = self.run_words("batch", "list.jsonl", "--out", f"{count}.jsonl", "--together", "8")
            self.assertEqual(done.returncode, 0, done.stderr)
            most.append(max(before, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss))
        self.assertLess(most[1], most[0] + 17_000)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *WORDS], verbosity=2)
