"""A quantized GLB, and one packed by meshopt, are gated against their original: what rounding to so many bits moved.

usage: packed_glb_test.py PROGRAM. The largest deviation is at most what rounding moved a vertex, which is known here.
"""

import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "platforms"))

import glb  # noqa: E402
import meshes  # noqa: E402

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
HALF_DIAGONAL = math.sqrt(3) / 2  # of a cube of one step: no vertex is rounded farther


def moved(vertices, bits):
    """The step, and how far rounding moves the vertex that it moves most."""
    numbers, step, low = glb.quantized(vertices, bits)
    places = [[least + n * step for n, least in zip(row, low)] for row in numbers]
    return step, max(map(math.dist, vertices, places))


class PackedGlb(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        vertices, cls.faces = meshes.sphere(20, 0.05)
        cls.vertices = [struct.unpack("<3f", struct.pack("<3f", *vertex)) for vertex in vertices]  # as float32 has them
        (cls.folder / "part.glb").write_bytes(glb.as_glb(cls.vertices, cls.faces))

    def gate(self, limit):
        words = [PROGRAM, "gate", "part.glb", "packed.glb", "--max", f"{limit!r}m", "--symmetric", "--worst", "--json"]
        done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, timeout=120)
        answer = json.loads(done.stdout)
        if "meshoptimizer" in answer.get("error", {}).get("message", ""):
            self.skipTest("built without meshoptimizer")
        return done.returncode, answer

    def test_the_deviation_is_that_of_the_rounding(self):
        for bits, is_packed in ((8, False), (14, True), (16, True)):
            with self.subTest(bits=bits, is_packed=is_packed):
                step, most = moved(self.vertices, bits)
                self.assertLessEqual(most, HALF_DIAGONAL * step)
                (self.folder / "packed.glb").write_bytes(glb.as_quantized_glb(self.vertices, self.faces, bits, is_packed))
                code, answer = self.gate(step)
                self.assertEqual((code, answer["verdict"]), (0, "pass"), answer)
                self.assertEqual(answer["inputs"][1]["faces"], len(self.faces))
                lower, upper = answer["interval"]["lower"], answer["interval"]["upper"]
                self.assertLessEqual(lower, most)  # convex: no point of a face moves farther than a corner
                self.assertGreater(lower, 0.5 * most)  # a sphere's corners are seldom moved along it
                self.assertLess(upper - lower, 0.01 * most + 2e-8)
        self.assertEqual(self.gate(0.5 * lower)[0], 1)

    def test_a_vertex_that_is_off_by_three_steps_fails(self):
        step, _ = moved(self.vertices, 12)
        vertices = [tuple(1.0 * x for x in vertex) for vertex in self.vertices]
        x, y, z = vertices[210]
        vertices[210] = (x + 3 * step * x / 0.05, y + 3 * step * y / 0.05, z + 3 * step * z / 0.05)
        for is_packed in (False, True):
            (self.folder / "packed.glb").write_bytes(glb.as_quantized_glb(vertices, self.faces, 12, is_packed))
            self.assertEqual(self.gate(step)[0], 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
