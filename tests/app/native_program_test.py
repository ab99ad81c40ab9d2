"""--device native: each command answers, and takes neither a driver nor a loader.

usage: native_program_test.py PROGRAM
That the answers are true: the tests of solve that run natively, too, and tests/solve/native_test.cpp and native_solver_test.cpp.
"""

import errno
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "platforms"))

import meshes  # noqa: E402

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
NO_DRIVER = {"VK_DRIVER_FILES": "/nowhere/icd.json", "VK_ICD_FILENAMES": "/nowhere/icd.json"}
NATIVE = ("--device", "native")
PASS, FAIL, USAGE, OPEN = 0, 1, 2, 3
OF_THE_RUN = ("started", "times", "device", "arguments", "wall_ms")


def stripped(found):
    """An answer without what two runs of it differ in."""
    if isinstance(found, dict):
        return {key: stripped(value) for key, value in found.items() if key not in OF_THE_RUN}
    return [stripped(value) for value in found] if isinstance(found, list) else found


def ends(found):
    upper = found["interval"]["upper"]  # none before the meshes are read
    return found["interval"]["lower"], math.inf if upper is None else upper


def meet(x, y):
    return max(ends(x)[0], ends(y)[0]) <= min(ends(x)[1], ends(y)[1])


def bent(n, by):
    """A sheet of 2 n * n faces that is no mesh's neighbour: its distances differ from place to place."""
    at = [(x / n, y / n, by * math.sin(5 * x / n) * math.cos(7 * y / n)) for y in range(n + 1) for x in range(n + 1)]
    faces = []
    for y in range(n):
        for x in range(n):
            v = y * (n + 1) + x
            faces += [(v, v + 1, v + n + 2), (v, v + n + 2, v + n + 1)]
    return at, faces


class Native(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        for name, mesh in {
            "inner": meshes.sphere(10, 1.0), "outer": meshes.sphere(13, 1.125), "sheet": bent(12, 0.05), "flat": bent(5, 0.0),
        }.items():
            (cls.folder / f"{name}.ply").write_bytes(meshes.as_ply(*mesh))
        (cls.folder / "points.xyz").write_text("".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in bent(6, 0.05)[0]))

    def run_with(self, *words, code=None, **environment):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=300, env=os.environ | environment)
        if code is not None:
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def answer(self, *words, code=PASS, **environment):
        return json.loads(self.run_with(*words, "--json", code=code, **environment).stdout)

    def test_an_interval_meets_the_device_s(self):
        words = ("distance", "sheet.ply", "flat.ply", "--symmetric")
        native, device = self.answer(*words, *NATIVE, **NO_DRIVER), self.answer(*words)
        self.assertTrue(meet(native, device), (ends(native), ends(device)))
        self.assertEqual((native["status"], device["status"]), ("closed", "closed"))
        self.assertLessEqual(ends(native)[1] - ends(native)[0], native["tolerance"]["absolute"])

    def test_every_question_is_answered(self):
        for words in (("distance", "outer.ply", "inner.ply", "--part=2/3"), ("distance", "points.xyz", "flat.ply", "--points=a", "--stats", "--signed"),
                      ("distance", "sheet.ply", "inner.ply", "--align"), ("metrics", "sheet.ply", "flat.ply", "--normals=20", "--figures=hd95"),
                      ("distance", "inner.ply", "outer.ply", "--verify", "--symmetric")):
            with self.subTest(words):
                found = self.answer(*words, *NATIVE, **NO_DRIVER)
                self.assertEqual(found["device"]["type"], "native")
                for direction in found["directions"] if "--verify" in words else ():
                    self.assertTrue(direction["verified"]["witness"] and direction["verified"]["coverage"])

    def test_a_gate_s_codes(self):
        for limit, code in (("0.1abs", PASS), ("0.025abs", FAIL)):  # the sheet is at most 0.05 from the flat one, and nearly that
            self.run_with("gate", "sheet.ply", "flat.ply", "--max", limit, *NATIVE, code=code, **NO_DRIVER)
        found = self.answer("distance", "sheet.ply", "flat.ply", *NATIVE)
        between = sum(ends(found)) / 2
        self.answer("gate", "sheet.ply", "flat.ply", "--max", f"{between!r}abs", "--tol", "0.1abs", *NATIVE, code=OPEN)

    def test_any_number_of_threads_gives_the_same_bits(self):
        def bits(threads):
            found = self.answer("distance", "outer.ply", "sheet.ply", "--symmetric", "--tol", "1e-9", *NATIVE, "--threads", str(threads))
            self.assertTrue(found["device"]["name"].endswith(f", {threads} thread" + ("s" if threads > 1 else "")))
            return stripped(found)

        self.assertEqual(bits(1), bits(16))

    def test_the_device_is_named(self):
        said = self.run_with("distance", "inner.ply", "outer.ply", *NATIVE, code=PASS).stdout
        self.assertRegex(said, r"device     native, .*, \d+ threads?\n")

    def test_pictures_and_pages(self):
        self.run_with("distance", "sheet.ply", "flat.ply", "--image=native.png", "--report=native.html", "--points-out=native.csv", "--effort=2000", *NATIVE,
                      code=PASS, **NO_DRIVER)
        for name in ("native.png", "native.html", "native.csv"):
            self.assertGreater((self.folder / name).stat().st_size, 500)

    def test_what_needs_a_device_is_refused_before_the_files(self):
        refused = {
            "distance": ("--preset=paper", "--enable=u4", "--disable=u3"),
        }
        for command, options in refused.items():
            for option in options:
                with self.subTest(option):
                    done = self.run_with(command, "no.ply", "file.ply", *option.split(), *NATIVE, code=USAGE)
                    self.assertRegex(done.stderr, f"{option.split('=')[0]}: needs a Vulkan device")
                    self.assertEqual(done.stdout, "")
        self.assertIn("--threads", self.run_with("distance", "no.ply", "file.ply", "--threads=2", code=USAGE).stderr)
        self.assertIn("native", self.run_with("distance", "inner.ply", "outer.ply", "--device=native,0", code=USAGE).stderr)

    def test_simplify(self):
        words = ("simplify", "sheet.ply", "--max=0.01abs", "--out=small.ply", "--certificate=small.vhc", *NATIVE)
        done = self.run_with(*words, **NO_DRIVER)
        if done.returncode == USAGE and "meshoptimizer" in done.stderr:
            self.skipTest("built without meshoptimizer")
        self.assertEqual(done.returncode, PASS, done.stderr)
        found = self.answer("distance", "sheet.ply", "small.ply", "--symmetric", *NATIVE)
        self.assertLessEqual(ends(found)[0], 0.01)

    def test_budgets(self):
        for more, status in (("--waves=1", "waves"), ("--time=1e-9", "time"), ("--memory=1K", "memory")):
            with self.subTest(more):
                self.assertEqual(self.answer("distance", "inner.ply", "outer.ply", "--tol=1e-9", more, *NATIVE, code=OPEN)["status"], status)
        survey = self.answer("distance", "outer.ply", "sheet.ply", "--tol=1e-3", "--field-tol=1e-9abs", "--effort=1000", *NATIVE)["directions"][0]["survey"]
        self.assertEqual(survey["ended"], "effort")

    @unittest.skipUnless(sys.platform == "linux", "of Linux's pipes with names")
    def test_an_interrupt_ends_with_a_true_interval(self):
        """SIGINT comes once both meshes are read, in a survey whose effort is hours."""
        pair = ("distance", "outer.ply", "sheet.ply", *NATIVE)
        words = [PROGRAM, *pair[:2], "pipe.ply", *pair[3:], "--field-tol=1e-12abs", "--effort=2000000000", "--json"]
        os.mkfifo(self.folder / "pipe.ply")
        run = subprocess.Popen(words, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        (self.folder / "pipe.ply").write_bytes((self.folder / "sheet.ply").read_bytes())
        self.wait_for_no_reader(self.folder / "pipe.ply")
        run.send_signal(signal.SIGINT)
        out, error = run.communicate(timeout=120)
        found = json.loads(out)
        survey = found["directions"][0]["survey"] if found["status"] == "closed" else {"ended": found["status"]}
        self.assertEqual(survey["ended"], "cancelled", error)
        self.assertTrue(meet(found, self.answer(*pair)))

    def wait_for_no_reader(self, pipe):
        while True:
            try:
                os.close(os.open(pipe, os.O_WRONLY | os.O_NONBLOCK))
            except OSError as error:
                self.assertEqual(error.errno, errno.ENXIO)
                return
            time.sleep(0.001)

    def test_a_batch(self):
        rows = ["id,a,b,max", "one,inner.ply,outer.ply,1abs", "two,sheet.ply,flat.ply,0.01abs", "three,outer.ply,flat.ply,", "four,inner.ply,flat.ply,"]
        (self.folder / "list.csv").write_text("\n".join(rows) + "\n")
        self.run_with("batch", "list.csv", "--out", "native.jsonl", *NATIVE, code=FAIL, **NO_DRIVER)
        lines = map(json.loads, (self.folder / "native.jsonl").read_text().splitlines())
        self.assertEqual({line["id"]: line["code"] for line in lines}, {"one": PASS, "two": FAIL, "three": PASS, "four": PASS})

    @unittest.skipUnless(sys.platform == "linux", "of glibc's linker")
    def test_no_loader_is_looked_for(self):
        def said(*words):
            return self.run_with("distance", "inner.ply", "outer.ply", *words, code=PASS, LD_DEBUG="files").stderr

        # The loader by its name: sanitized programs open the driver themselves (verification/sanitize/keep_driver.c).
        self.assertNotIn("libvulkan.so", said(*NATIVE))
        self.assertIn("libvulkan.so", said())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
