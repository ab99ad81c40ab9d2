"""A field's PLY and GLB, as readers see them that are not ours: positions, colours and values are those of every face.

VTK, assimp and three.js read both. meshio reads faces' values of text alone, so the PLY's rows are given to it as text.
The expected values are taken from the PLY's bytes, by struct.

usage: readers_test.py PROGRAM SOURCE SCRATCH. A reader that is not here is left out, aloud.
"""

import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import unittest

PROGRAM, SOURCE, SCRATCH = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
HERE = pathlib.Path(__file__).resolve().parent
SYSTEM_PYTHON = "/usr/bin/python3"  # Debian's modules are its own
STEPS = 12


def grid(height):
    """Far from the origin, so that a GLB has to place it."""
    rows = [f"v {1000 + x / 8} {y / 8} {height(x, y)}\n" for y in range(STEPS + 1) for x in range(STEPS + 1)]
    for y in range(STEPS):
        for x in range(STEPS):
            v = y * (STEPS + 1) + x + 1
            rows.append(f"f {v} {v + 1} {v + STEPS + 2}\nf {v} {v + STEPS + 2} {v + STEPS + 1}\n")
    return "".join(rows)


class Rows:
    """The PLY's vertices (x, y, z, quality, colour) and faces (corners, lower, upper, quality, colour).

    With sides a vertex has `signed` after its quality, and a face signed_lower, signed_upper and side.
    """

    def __init__(self, path, is_signed=False):
        data = path.read_bytes()
        end = data.index(b"end_header\n") + 11
        self.head = data[:end].decode()
        count = int(re.search(r"element vertex (\d+)", self.head)[1])
        vertex, face = struct.Struct("<dddffBBB" if is_signed else "<dddfBBB"), struct.Struct("<BiiifffffbBBB" if is_signed else "<BiiifffBBB")
        split = end + count * vertex.size
        self.vertices = list(vertex.iter_unpack(data[end:split]))
        self.faces = list(face.iter_unpack(data[split:]))

    def as_text(self):
        lines = [" ".join(map(repr, row)) for row in self.vertices + self.faces]
        return self.head.replace("binary_little_endian", "ascii") + "\n".join(lines) + "\n"

    def corners(self):
        """Yields for each face's corners: position, lower, upper, the face's colour."""
        return [(self.vertices[v][:3], face[4], face[5], face[7:10]) for face in self.faces for v in face[1:4]]


def has_module(name):
    return pathlib.Path(SYSTEM_PYTHON).exists() and subprocess.run([SYSTEM_PYTHON, "-c", f"import {name}"], capture_output=True).returncode == 0


def run(*words):
    done = subprocess.run(words, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def groups(values, size):
    return [tuple(values[i:i + size]) for i in range(0, len(values), size)]


def srgb(light):
    """The byte that shows a linear colour (IEC 61966-2-1)."""
    return round(255 * (12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055))


def bytes_of(colours, scale):
    return [tuple(srgb(part / scale) for part in colour[:3]) for colour in colours]


class Readers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(SCRATCH, ignore_errors=True)
        SCRATCH.mkdir(parents=True)
        (SCRATCH / "a.obj").write_text(grid(lambda x, y: (7 * x * x + 3 * x * y + 5 * y * y) % 61 / 64))
        (SCRATCH / "b.obj").write_text(grid(lambda x, y: 0))
        for ending in ("ply", "glb"):
            run(PROGRAM, "distance", SCRATCH / "a.obj", SCRATCH / "b.obj", "--field", SCRATCH / f"out.{ending}")
        cls.rows = Rows(SCRATCH / "out.ply")
        cls.positions, cls.lower, cls.upper, cls.colours = map(list, zip(*cls.rows.corners()))
        assert len(set(cls.colours)) > 20, "a field of few colours shows little"

    def test_vtk(self):
        if not has_module("vtk"):
            self.skipTest("no VTK here")
        read = json.loads(run(SYSTEM_PYTHON, HERE / "vtk_reads.py", SCRATCH))
        ply, glb = read["ply"], read["glb"]
        self.assertEqual(list(map(tuple, ply["points"])), [v[:3] for v in self.rows.vertices])
        self.assertEqual(list(map(tuple, ply["of_points"]["RGB"])), [v[4:7] for v in self.rows.vertices])
        self.assertEqual(list(map(tuple, ply["of_faces"]["RGB"])), [f[7:10] for f in self.rows.faces])
        self.assertEqual(list(map(tuple, glb["points"])), self.positions)
        self.assertEqual(glb["of_points"]["_LOWER"], self.lower)
        self.assertEqual(glb["of_points"]["_UPPER"], self.upper)
        self.assertEqual(bytes_of(glb["of_points"]["COLOR_0"], 1), self.colours)

    def test_three(self):
        modules = self.three()
        shutil.copy(HERE / "three_reads.mjs", modules)
        read = json.loads(run("node", modules / "three_reads.mjs", SCRATCH))
        ply, glb = read["ply"]["arrays"], read["glb"]["arrays"]
        self.assertEqual(groups(ply["position"]["values"], 3), self.positions)
        self.assertEqual(ply["quality"]["values"], [self.rows.vertices[v][3] for f in self.rows.faces for v in f[1:4]])
        place = read["glb"]["placed"][12:15]
        self.assertEqual([tuple(x + s for x, s in zip(p, place)) for p in groups(glb["position"]["values"], 3)], self.positions)
        self.assertEqual((glb["_lower"]["values"], glb["_upper"]["values"]), (self.lower, self.upper))
        self.assertEqual(bytes_of(groups(glb["color"]["values"], 4), 65535), self.colours)
        # It makes a PLY's colours linear, in bytes: then dark ones are a few levels off.
        for read_as, face in zip(bytes_of(groups(ply["color"]["values"], 3), 255), self.colours):
            for got, wanted in zip(read_as, face):
                self.assertLessEqual(abs(got - wanted), 13)

    def three(self):
        if not shutil.which("node") or not shutil.which("npm"):
            self.skipTest("no node here")
        page = SCRATCH / "three"
        page.mkdir()
        for name in ("package.json", "package-lock.json"):
            shutil.copy(SOURCE / "tools/page" / name, page)
        try:
            done = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=page, capture_output=True, text=True, timeout=120)
        except subprocess.TimeoutExpired:
            self.skipTest("npm waits for the network")
        if done.returncode:
            self.skipTest("npm cannot fetch three: " + done.stderr.strip()[-200:])
        return page

    def test_assimp(self):
        if not shutil.which("assimp"):
            self.skipTest("no assimp here")
        positions, colours = self.by_assimp("out.ply")
        self.assertEqual(positions, [v[:3] for v in self.rows.vertices])
        self.assertEqual([tuple(round(255 * part) for part in c[:3]) for c in colours], [v[4:7] for v in self.rows.vertices])
        positions, colours = self.by_assimp("out.glb")
        low = [min(p[axis] for p in self.positions) for axis in range(3)]
        here = [min(p[axis] for p in positions) for axis in range(3)]
        self.assertEqual([tuple(x - h + l for x, h, l in zip(p, here, low)) for p in positions], self.positions)
        self.assertEqual(bytes_of(colours, 1), self.colours)

    def by_assimp(self, name):
        """Positions and colours, as six decimals: coordinates here are 64ths."""
        run("assimp", "export", SCRATCH / name, SCRATCH / "dump.assxml")
        text = (SCRATCH / "dump.assxml").read_text()
        rows = lambda tag: [tuple(map(float, line.split())) for line in re.search(f"<{tag} [^>]*>(.*?)</{tag}>", text, re.S)[1].strip().splitlines()]
        return rows("Positions"), rows("Colors")

    def test_meshio(self):
        if not has_module("meshio"):
            self.skipTest("no meshio here")
        (SCRATCH / "text.ply").write_text(self.rows.as_text())
        program = ("import json, meshio, sys; m = meshio.read(sys.argv[1]); flat = lambda d: {k: [float(x) for x in (v[0] if len(v) == 1 else v)] for k, v in d.items()};"
                   "print(json.dumps([m.points.tolist(), {k: v.tolist() for k, v in m.point_data.items()}, m.cells[0].data.tolist(), flat(m.cell_data)]))")
        points, of_points, faces, of_faces = json.loads(run(SYSTEM_PYTHON, "-c", program, SCRATCH / "text.ply"))
        self.assertEqual(list(map(tuple, points)), [v[:3] for v in self.rows.vertices])
        self.assertEqual(list(map(tuple, faces)), [f[1:4] for f in self.rows.faces])
        for at, name in ((3, "quality"), (4, "red"), (5, "green"), (6, "blue")):
            self.assertEqual([struct.unpack("<f", struct.pack("<f", x))[0] for x in of_points[name]], [v[at] for v in self.rows.vertices])
        for at, name in ((4, "lower"), (5, "upper"), (6, "quality"), (7, "red"), (8, "green"), (9, "blue")):
            self.assertEqual([struct.unpack("<f", struct.pack("<f", x))[0] for x in of_faces[name]], [f[at] for f in self.rows.faces])


class Signed(unittest.TestCase):
    """Sides, as programs show them that read vertices' figures (CloudCompare), or a GLB's own attributes (ParaView)."""

    @classmethod
    def setUpClass(cls):
        cls.folder = SCRATCH / "signed"
        shutil.rmtree(cls.folder, ignore_errors=True)
        cls.folder.mkdir(parents=True)
        (cls.folder / "a.obj").write_text(grid(lambda x, y: (x - 5) / 16 if x < 9 else 0.25))
        (cls.folder / "b.obj").write_text(grid(lambda x, y: 0))
        for ending in ("ply", "glb"):
            run(PROGRAM, "distance", cls.folder / "a.obj", cls.folder / "b.obj", "--signed", "--field", cls.folder / f"out.{ending}")
        cls.rows = Rows(cls.folder / "out.ply", True)

    def test_the_rows(self):
        heights = [v[2] for v in self.rows.vertices]
        sides = set()
        for _, a, b, c, lower, upper, _, signed_lower, signed_upper, side, *_ in self.rows.faces:
            at = [heights[v] for v in (a, b, c)]
            self.assertLessEqual(signed_lower, min(at))
            self.assertGreaterEqual(signed_upper, max(at))
            self.assertEqual(upper, max(-signed_lower, signed_upper))
            self.assertTrue(side == 0 or all(side * height >= 0 for height in at), (side, at))
            sides.add(side)
        self.assertEqual(sides, {-1, 0, 1})
        for v, vertex in enumerate(self.rows.vertices):
            ends = [end for face in self.rows.faces if v in face[1:4] for end in face[7:9]]
            self.assertIn(vertex[4], ends)
            self.assertEqual(abs(vertex[4]), max(map(abs, ends)))

    def test_vtk(self):
        if not has_module("vtk"):
            self.skipTest("no VTK here")
        read = json.loads(run(SYSTEM_PYTHON, HERE / "vtk_reads.py", self.folder))
        self.assertEqual(list(map(tuple, read["ply"]["points"])), [v[:3] for v in self.rows.vertices])
        self.assertEqual(list(map(tuple, read["ply"]["of_faces"]["RGB"])), [f[10:13] for f in self.rows.faces])
        for name, at in (("_SIGNED_LOWER", 7), ("_SIGNED_UPPER", 8), ("_SIDE", 9)):
            self.assertEqual(read["glb"]["of_points"][name], [f[at] for f in self.rows.faces for _ in range(3)])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
