"""--device native: the answers meet the Vulkan device's, and it takes neither a driver nor a loader.

usage: native_program_test.py PROGRAM
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
OF_CELLS = ("curve", "unsigned")  # not of the meshes alone


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


def enclosures(found, path=""):
    """Every lower and upper end of an answer, by its path."""
    if isinstance(found, list):
        return {key: ends for i, value in enumerate(found) for key, ends in enclosures(value, f"{path}[{i}]").items()}
    if not isinstance(found, dict):
        return {}
    own = {path: (found["lower"], found["upper"])} if isinstance(found.get("lower"), (int, float)) and isinstance(found.get("upper"), (int, float)) else {}
    return own | {key: ends for name, value in found.items() if name not in OF_CELLS for key, ends in enclosures(value, f"{path}/{name}").items()}


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
            "inner": meshes.sphere(24, 1.0), "outer": meshes.sphere(31, 1.125), "sheet": bent(24, 0.05), "flat": bent(9, 0.0),
            "far": ([(x + 2.0**40, y, z) for x, y, z in bent(12, 0.05)[0]], bent(12, 0.05)[1]), "large": bent(60, 0.05), "wide": bent(46, 0.1),
        }.items():
            (cls.folder / f"{name}.ply").write_bytes(meshes.as_ply(*mesh))
        (cls.folder / "points.xyz").write_text("".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in bent(24, 0.05)[0]))

    def run_with(self, *words, code=None, **environment):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=300, env=os.environ | environment)
        if code is not None:
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def answer(self, *words, code=PASS, **environment):
        return json.loads(self.run_with(*words, "--json", code=code, **environment).stdout)

    def test_intervals_meet_the_device_s(self):
        for a, b, more in (("inner", "outer", ()), ("inner", "outer", ("--symmetric", "--tol=1e-9")), ("outer", "inner", ("--part=2/3",)),
                           ("sheet", "flat", ("--symmetric",)), ("flat", "sheet", ("--tol=1e-9",)), ("far", "far", ("--symmetric",))):
            with self.subTest(a=a, b=b, more=more):
                words = ("distance", f"{a}.ply", f"{b}.ply", *more)
                native, device = self.answer(*words, *NATIVE, **NO_DRIVER), self.answer(*words)
                self.assertTrue(meet(native, device), (ends(native), ends(device)))
                self.assertEqual((native["status"], device["status"]), ("closed", "closed"))
                lower, upper = ends(native)
                self.assertLessEqual(upper - lower, native["tolerance"]["absolute"])

    def test_a_mesh_is_0_from_itself(self):
        found = self.answer("distance", "sheet.ply", "sheet.ply", "--symmetric", *NATIVE)
        self.assertEqual(ends(found), (0, 0))

    def test_points(self):
        words = ("distance", "points.xyz", "flat.ply", "--points=a", "--tol", "1e-9")
        native, device = self.answer(*words, *NATIVE), self.answer(*words)
        self.assertTrue(meet(native, device), (ends(native), ends(device)))

    def test_a_gate_s_codes(self):
        for limit, code in (("0.1abs", PASS), ("0.025abs", FAIL)):  # the sheet is at most 0.05 from the flat one, and nearly that
            for more in ((), ("--symmetric",)):
                words = ("gate", "sheet.ply", "flat.ply", "--max", limit, *more)
                self.run_with(*words, *NATIVE, code=code, **NO_DRIVER)
        found = self.answer("distance", "sheet.ply", "flat.ply", *NATIVE)
        between = sum(ends(found)) / 2
        self.answer("gate", "sheet.ply", "flat.ply", "--max", f"{between!r}abs", "--tol", "0.1abs", *NATIVE, code=OPEN)

    def test_a_gate_that_fails_ends_early(self):
        whole = self.answer("distance", "large.ply", "wide.ply", *NATIVE)
        early = self.answer("gate", "large.ply", "wide.ply", "--max", f"{ends(whole)[0] / 2}abs", *NATIVE, code=FAIL)
        self.assertEqual(early["status"], "limit")
        count = [found["directions"][0]["counts"]["candidates"] for found in (early, whole)]
        self.assertLess(count[0], count[1] / 10)

    def test_any_number_of_threads_gives_the_same_bits(self):
        def bits(threads):
            found = self.answer("distance", "outer.ply", "sheet.ply", "--symmetric", "--tol", "1e-9", *NATIVE, "--threads", str(threads))
            self.assertTrue(found["device"]["name"].endswith(f", {threads} thread" + ("s" if threads > 1 else "")))
            return stripped(found)

        self.assertEqual(bits(1), bits(2))
        self.assertEqual(bits(1), bits(16))

    def test_the_device_is_named(self):
        device = self.answer("distance", "inner.ply", "outer.ply", *NATIVE)["device"]
        self.assertEqual(device["type"], "native")
        self.assertRegex(device["name"], r"^native, .*, \d+ threads?$")
        said = self.run_with("distance", "inner.ply", "outer.ply", *NATIVE, code=PASS).stdout
        self.assertRegex(said, r"device     native, .*, \d+ threads?\n")

    def figures_meet(self, native, device):
        """All enclosures that both answers have meet; returns how many."""
        of_native, of_device = enclosures(native), enclosures(device)
        for path, (lower, upper) in of_native.items():
            if path in of_device:
                self.assertLessEqual(max(lower, of_device[path][0]), min(upper, of_device[path][1]), path)
        return len(of_native.keys() & of_device.keys())

    def test_figures_meet_the_device_s(self):
        fields, signed, metrics = ("distance", "--stats", "--bands=0.01abs,0.05abs", "--field-tol=0.001abs"), ("distance", "--signed", "--symmetric"), ("metrics", "--normals=20")
        for words, least, pairs in ((fields, 10, (("inner", "outer"), ("flat", "sheet"))), (signed, 8, (("inner", "outer"), ("far", "far"))),
                                    (metrics, 10, (("sheet", "flat"), ("far", "far"))), (("gate", "--max=0.05abs", "--area=5%"), 1, (("sheet", "flat"),)),
                                    (("gate", "--max=+0.2abs,-0.2abs"), 1, (("inner", "outer"), ("flat", "sheet")))):
            for a, b in pairs:
                with self.subTest(a=a, b=b, words=words):
                    command = (words[0], f"{a}.ply", f"{b}.ply", *words[1:], "--effort=2000", "--json")
                    native, device = self.run_with(*command, *NATIVE, **NO_DRIVER), self.run_with(*command)
                    self.assertEqual(native.returncode, device.returncode, native.stderr + device.stderr)
                    self.assertGreaterEqual(self.figures_meet(json.loads(native.stdout), json.loads(device.stdout)), least)

    def test_figures_of_points(self):
        words = ("distance", "points.xyz", "flat.ply", "--points=a", "--stats", "--signed")
        self.assertGreaterEqual(self.figures_meet(self.answer(*words, *NATIVE), self.answer(*words)), 5)

    def test_any_number_of_threads_gives_the_same_figures(self):
        def figures(threads):
            return stripped(self.answer("metrics", "outer.ply", "sheet.ply", "--effort=2000", *NATIVE, f"--threads={threads}", code=OPEN))

        self.assertEqual(figures(1), figures(2))
        self.assertEqual(figures(1), figures(16))

    def test_pictures_and_pages(self):
        for words, name in ((("--image=native.png",), "native.png"), (("--report=native.html",), "native.html"), (("--points-out=native.csv",), "native.csv")):
            self.run_with("distance", "sheet.ply", "flat.ply", *words, "--effort=2000", *NATIVE, code=PASS, **NO_DRIVER)
            self.assertGreater((self.folder / name).stat().st_size, 500)

    def test_budgets_end_a_survey_with_true_figures(self):
        for pair, more, ended in ((("outer.ply", "sheet.ply"), "--effort=1000", "effort"), (("sheet.ply", "inner.ply"), "--memory=400K", "memory")):
            with self.subTest(more):
                words = ("distance", *pair, "--tol=1e-3", "--stats", "--json", *NATIVE)
                found = json.loads(self.run_with(*words, more).stdout)
                self.assertEqual(found["directions"][0]["survey"]["ended"], ended)
                self.assertGreaterEqual(self.figures_meet(found, json.loads(self.run_with(*words, "--effort=10000").stdout)), 5)

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

    def test_verify(self):
        """The witness by brute force, and that no part of A is lost, also where the run is cut short."""
        for more, code in (((), PASS), (("--waves=1", "--tol=1e-9"), OPEN), (("--memory=4K", "--tol=1e-9"), OPEN)):
            with self.subTest(more):
                found = self.answer("distance", "inner.ply", "outer.ply", "--verify", "--symmetric", *more, *NATIVE, code=code)
                for direction in found["directions"]:
                    check = direction["verified"]
                    self.assertTrue(check["witness"] and check["coverage"], check)

    def test_limits_of_faces(self):
        count = len(bent(24, 0.05)[1])
        for name, limit, code in (("within", "0.06", PASS), ("beyond", "0.02", FAIL)):
            (self.folder / f"{name}.csv").write_text("".join(f"{face},{limit}\n" for face in range(count - 400, count)))
            words = ("gate", "sheet.ply", "flat.ply", "--max=0.06abs", f"--face-max={name}.csv", "--json")
            native, device = self.run_with(*words, *NATIVE, code=code, **NO_DRIVER), self.run_with(*words, code=code)
            self.assertEqual(json.loads(native.stdout)["verdict"], json.loads(device.stdout)["verdict"])

    def test_a_fit(self):
        """A lies turned and shifted: the fits of both find it again."""
        at, faces = bent(24, 0.2)
        turned = [(x * math.cos(0.4) - y * math.sin(0.4) + 3, x * math.sin(0.4) + y * math.cos(0.4), z - 1) for x, y, z in at]
        for name, mesh in (("still", at), ("turned", turned)):
            (self.folder / f"{name}.ply").write_bytes(meshes.as_ply(mesh, faces))
        for device in (NATIVE, ()):
            found = self.answer("distance", "turned.ply", "still.ply", "--align", *device)
            self.assertLess(ends(found)[1], 1e-4)

    def test_simplify(self):
        words = ("simplify", "sheet.ply", "--max=0.01abs", "--out=small.ply", "--certificate=small.vhc", *NATIVE)
        done = self.run_with(*words, **NO_DRIVER)
        if done.returncode == USAGE and "meshoptimizer" in done.stderr:
            self.skipTest("built without meshoptimizer")
        self.assertEqual(done.returncode, PASS, done.stderr)
        found = self.answer("distance", "sheet.ply", "small.ply", "--symmetric", *NATIVE)
        self.assertLessEqual(ends(found)[0], 0.01)

    def test_budgets_end_with_a_true_interval(self):
        large, spheres = ("large.ply", "wide.ply"), ("inner.ply", "outer.ply")
        for pair, more, status in ((large, ("--waves", "1"), "waves"), (large, ("--waves", "3"), "waves"), (large, ("--time", "1e-9"), "time"),
                                   (spheres, ("--memory", "4K"), "memory")):
            with self.subTest(more):
                words = ("distance", *pair, "--tol", "1e-9", *NATIVE)
                whole = self.answer(*words)
                found = self.answer(*words, *more, code=OPEN)
                self.assertEqual(found["status"], status)
                self.assertTrue(meet(found, whole), (ends(found), ends(whole)))

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
        for device, out in ((NATIVE, "native.jsonl"), ((), "device.jsonl")):
            environment = NO_DRIVER if device else {}
            self.run_with("batch", "list.csv", "--out", out, *device, code=FAIL, **environment)
        native, device = ({(line := json.loads(text))["id"]: line for text in (self.folder / name).read_text().splitlines()} for name in ("native.jsonl", "device.jsonl"))
        self.assertEqual(set(native), {"one", "two", "three", "four"})
        for pair, found in native.items():
            self.assertEqual(found["code"], device[pair]["code"])
            self.assertTrue(meet(found, device[pair]), pair)

    @unittest.skipUnless(sys.platform == "linux", "of glibc's linker")
    def test_no_loader_is_looked_for(self):
        def said(*words):
            return self.run_with("distance", "inner.ply", "outer.ply", *words, code=PASS, LD_DEBUG="files").stderr

        # The loader by its name: sanitized programs open the driver themselves (verification/sanitize/keep_driver.c).
        self.assertNotIn("libvulkan.so", said(*NATIVE))
        self.assertIn("libvulkan.so", said())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
