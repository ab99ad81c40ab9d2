"""Certificates that the program writes, given to vkh_check: every way to ask and to end.

usage: program_test.py VKHAUSDORFF VKH_CHECK
VKH_CHECK_PROVEN, if it is set, has to accept them, too.
"""

import hashlib
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

PROGRAM, CHECK = sys.argv[1:3]
PROVEN = os.environ.get("VKH_CHECK_PROVEN", "")
ROOT = pathlib.Path(__file__).resolve().parents[3]


def sheet(name, n, height, seed):
    """A bumpy square of 2 n n faces."""
    rng = random.Random(seed)
    lines = [f"v {x / n!r} {y / n!r} {height + 0.1 * math.sin(7 * x / n) * y / n + 0.3 / n * rng.random()!r}"
             for y in range(n + 1) for x in range(n + 1)]
    for y in range(n):
        for x in range(n):
            a = y * (n + 1) + x + 1
            lines += [f"f {a} {a + 1} {a + n + 2}", f"f {a} {a + n + 2} {a + n + 1}"]
    return name, "\n".join(lines) + "\n"


FILES = dict([sheet("a.obj", 12, 0, 1), sheet("b.obj", 9, 0.05, 2), sheet("same.obj", 12, 0, 1), sheet("fine.obj", 60, 0, 3)])
FILES["wide.off"] = "OFF\n4 2 0\n-1 -1 0\n2 -1 0\n2 2 0.1\n-1 2 0\n3 0 1 2\n3 2 3 0\n"
# The farthest point of the one from the other's three points is at thirds of its edges.
FILES["face.obj"] = "v 0 0 0\nv 4 0 0\nv 1 3 0\nf 1 2 3\n"
FILES["points.obj"] = "v 0 0 0\nv 4 0 0\nv 1 3 0\nf 1 1 1\nf 2 2 2\nf 3 3 3\n"
# A plate with a hole, to which an edge leads, off its plane at a corner; quads; a bow tie.
FILES["plate.obj"] = ("v 0 0 0\nv 9 0 0\nv 9 9 0.25\nv 0 9 0\nv 3 3 0\nv 3 6 0\nv 6 6 0\nv 6 3 0\nv 9 9 9\n"
                      "f 1 2 9\nf 1 2 3 4 1 5 6 7 8 5\n")
FILES["quads.off"] = "OFF\n6 2 0\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n2 0 0\n2 1 0\n4 0 1 2 3\n4 1 4 5 2\n"
FILES["bow.obj"] = "v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 4 0\nf 1 2 3 4\n"
FILES["scene.gltf"] = json.dumps({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "rotation": [0.1, 0.2, 0.3, 0.9], "scale": [1.1, 0.7, 1.3], "translation": [0.1, 0.2, 0.3]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})


class Program(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        for name, text in FILES.items():
            (cls.folder / name).write_text(text)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def run_here(self, *words):
        return subprocess.run([str(word) for word in words], cwd=self.folder, capture_output=True, text=True, timeout=300)

    def certify(self, *words, codes=(0,)):
        """The answer, once its certificate is accepted."""
        done = self.run_here(PROGRAM, *words, "--certificate", "out.vhc", "--json")
        self.assertIn(done.returncode, codes, done.stderr)
        a, b = words[1:3]
        checked = self.run_here(CHECK, "out.vhc", a, b)
        self.assertEqual(checked.returncode, 0, checked.stderr + checked.stdout)
        self.assertTrue(checked.stdout.startswith("proven: "), checked.stdout)
        if PROVEN:
            self.assertEqual(self.run_here(CHECK, "out.vhc", a, b, "--corners", "a.corners", "b.corners").returncode, 0)
            proven = self.run_here(PROVEN, "out.vhc", "a.corners", "b.corners")
            self.assertEqual(proven.returncode, 0, proven.stderr)
        return json.loads(done.stdout)

    def test_every_way_to_ask(self):
        for words, codes in ((["distance", "a.obj", "b.obj"], (0,)), (["distance", "a.obj", "b.obj", "--symmetric"], (0,)),
                             (["distance", "fine.obj", "wide.off", "--symmetric", "--tol", "1e-9"], (0, 3)),
                             (["distance", "a.obj", "same.obj"], (0,)), (["distance", "scene.gltf", "b.obj", "--symmetric"], (0,)),
                             (["distance", "a.obj", "b.obj", "--preset", "paper"], (0,)),
                             (["distance", "a.obj", "b.obj", "--preset", "baseline-gpu", "--memory", "1"], (0, 3)),
                             (["distance", "a.obj", "b.obj", "--waves", "1", "--tol", "1e-9"], (3,)),
                             (["distance", "face.obj", "points.obj", "--tol", "1e-8"], (0,)),
                             (["distance", "face.obj", "points.obj", "--tol", "2e-8", "--symmetric", "--verify"], (0,)),
                             (["distance", "a.obj", "b.obj", "--field-tol", "1%", "--stats"], (0,)),
                             (["gate", "a.obj", "b.obj", "--max", "0.5abs"], (0,)),
                             (["gate", "a.obj", "b.obj", "--max", "0.01abs", "--symmetric"], (1,))):
            with self.subTest(words):
                answer = self.certify(*words, codes=codes)
                for way in answer["directions"]:
                    self.assertEqual(way["certificate"]["upper"], way["interval"]["upper"], "raised")
                    self.assertLess(way["certificate"]["bytes"], 20 * way["certificate"]["leaves"] + 9)

    def test_natively(self):
        """The same bound is proven, although no device left it wide; check/vkh_check.py accepts it, too."""
        for words, codes in ((["distance", "a.obj", "b.obj", "--symmetric"], (0,)), (["distance", "a.obj", "b.obj", "--tol", "1e-9"], (0,)),
                             (["distance", "a.obj", "same.obj"], (0,)), (["distance", "scene.gltf", "b.obj", "--symmetric"], (0,)),
                             (["distance", "fine.obj", "wide.off", "--symmetric", "--tol", "1e-9"], (0,)),
                             (["distance", "a.obj", "b.obj", "--waves", "1", "--tol", "1e-9"], (3,)),
                             (["distance", "face.obj", "points.obj", "--tol", "1e-8"], (0,)), (["distance", "plate.obj", "b.obj"], (0,)),
                             (["gate", "a.obj", "b.obj", "--max", "0.5abs"], (0,)), (["gate", "a.obj", "b.obj", "--max", "0.01abs"], (1,))):
            with self.subTest(words):
                answer = self.certify(*words, "--device", "native", codes=codes)
                for way in answer["directions"]:
                    self.assertEqual(way["certificate"]["upper"], way["interval"]["upper"], "raised")
                if "scene.gltf" not in words:  # which it does not read
                    other = self.run_here(sys.executable, "-B", ROOT / "check" / "vkh_check.py", "out.vhc", *words[1:3])
                    self.assertEqual(other.returncode, 0, other.stderr)

    def test_what_time_ends_has_one_all_the_same(self):
        certificate = self.folder / "out.vhc"
        for time in ("150ms", "250ms", "400ms"):
            certificate.unlink(missing_ok=True)
            done = self.run_here(PROGRAM, "distance", "fine.obj", "b.obj", "--tol", "1e-9", "--time", time, "--certificate", "out.vhc")
            self.assertIn(done.returncode, (0, 3, 6), done.stderr)
            self.assertEqual(done.returncode == 6, not certificate.exists(), done.stderr)
            if certificate.exists():
                self.assertEqual(self.run_here(CHECK, "out.vhc", "fine.obj", "b.obj").returncode, 0)

    def test_polygons(self):
        for words, said in ((["plate.obj", "b.obj", "--symmetric"], "A: 1 polygon, tiled by triangles"),
                            (["b.obj", "plate.obj"], "B: 1 polygon, tiled"),
                            (["quads.off", "plate.obj", "--tol", "1e-4"], "B: 1 polygon, tiled"),
                            (["quads.off", "b.obj"], "A: stated, not proven"),
                            (["bow.obj", "b.obj", "--polygons", "fan"], "A: 1 polygon as a fan of corners")):
            with self.subTest(words):
                self.certify("distance", *words)
                self.assertIn(said, self.run_here(CHECK, "out.vhc", *words[:2]).stdout)
                other = self.run_here(sys.executable, "-B", ROOT / "check" / "vkh_check.py", "out.vhc", *words[:2])
                self.assertEqual(other.returncode, 0, other.stderr)

    def test_of_other_meshes_it_proves_nothing(self):
        self.certify("distance", "a.obj", "b.obj")
        for a, b in (("b.obj", "a.obj"), ("a.obj", "wide.off"), ("same.obj", "same.obj")):
            self.assertEqual(self.run_here(CHECK, "out.vhc", a, b).returncode, 1)

    def test_corners(self):
        """The certificate's hashes are those of the files that --corners writes."""
        self.certify("distance", "a.obj", "quads.off")
        done = self.run_here(CHECK, "out.vhc", "a.obj", "quads.off", "--corners", "a.corners", "b.corners")
        self.assertEqual((done.returncode, done.stdout), (0, "corners written; nothing is proven yet\n"), done.stderr)
        certificate = (self.folder / "out.vhc").read_bytes()
        for name, at in (("a.corners", 112), ("b.corners", 144)):
            self.assertEqual(hashlib.sha256((self.folder / name).read_bytes()).digest(), certificate[at:at + 32])
        self.assertEqual((self.folder / "b.corners").stat().st_size, 72 * 4)
        for words in (["a.corners"], ["a.obj", "b.corners"], ["b.corners", "out.vhc"]):
            done = self.run_here(CHECK, "out.vhc", "a.obj", "quads.off", "--corners", *words)
            self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual((self.folder / "out.vhc").read_bytes(), certificate)
        done = self.run_here(CHECK, "out.vhc", "a.obj", "b.obj", "--corners", "a.corners", "b.corners")
        self.assertEqual(done.returncode, 1, done.stdout)

    def test_usage(self):
        for words in (["distance", "a.obj", "b.obj", "--certificate", "out.txt"],
                      ["gate", "a.obj", "b.obj", "--max", "1abs", "--area", "50%", "--certificate", "out.vhc"]):
            self.assertEqual(self.run_here(PROGRAM, *words).returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
