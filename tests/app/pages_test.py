"""Each command of the pages runs here: the lines that are indented and begin with the program, vkh_check or a loop, and
those that they go on in, behind a backslash.

usage: pages_test.py PROGRAM CHECK PAGE... A page's commands run in their order, in one folder with small files of the
names that they use. Files of the shared pairs are taken from there, if they are there.
"""

import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "platforms"))

import glb  # noqa: E402
import meshes  # noqa: E402

PROGRAM, CHECK, *PAGES = (pathlib.Path(word).resolve() for word in sys.argv[1:])
SHARED = pathlib.Path(__file__).resolve().parents[2].parent / "shared/pairs"
COMMAND = re.compile(r"^    (?:\$ )?((?:out/)?vkhausdorff .*|vkh_check .*|for .*; do vkhausdorff .*)$", re.MULTILINE)
FAILS = {"thingi10k_37322.ply"}  # commands that name these end with FAIL
TWO_DEVICES = "--device 0,1"


def body(n, size):
    """A closed, bumpy body without any symmetry, some 20 units long; `size` is 1 for the part."""
    vertices, faces = meshes.sphere(n, 1.0)
    bumps = [1 + 0.1 * x * y + 0.05 * y * z * z + 0.07 * x for x, y, z in vertices]
    return [(10 * size * b * x, 7 * size * b * y, 5 * size * b * z) for b, (x, y, z) in zip(bumps, vertices)], faces


def scaled(mesh, factor):
    return [tuple(factor * x for x in vertex) for vertex in mesh[0]], mesh[1]


def as_las(points):
    """LAS 1.2 of point format 0, in thousandths."""
    head = bytearray(227)
    head[0:4], head[24], head[25] = b"LASF", 1, 2
    struct.pack_into("<HII", head, 94, 227, 227, 0)
    struct.pack_into("<HI", head, 105, 20, len(points))
    struct.pack_into("<6d", head, 131, 0.001, 0.001, 0.001, 0, 0, 0)
    return bytes(head) + b"".join(struct.pack("<3i", *(round(1000 * x) for x in point)) + bytes(8) for point in points)


def write_files(folder):
    part, scan = body(12, 1), body(12, 1.001)
    for name in ("models", "references", "out", "scans"):
        (folder / name).mkdir()
    for name in ("part.stl", "reference.stl", "references/a.stl", "models/a.stl"):
        (folder / name).write_bytes(meshes.as_stl(*part))
    for name in ("37322", "49220", "96582"):
        for place in ("models", "references", "out", "scans"):
            (folder / place / f"{name}.ply").write_bytes(meshes.as_ply(*(scan if place in ("models", "scans") else part)))
    for name, mesh in (("scan", scan), ("part", part), ("reference", part), ("result", scan), ("truth", part)):
        (folder / f"{name}.ply").write_bytes(meshes.as_ply(*mesh))
    (folder / "scan.stl").write_bytes(meshes.as_stl(*scaled(scan, 1 / 25.4)))
    (folder / "scan.las").write_bytes(as_las(scan[0]))
    (folder / "scan.xyz").write_text("".join("{} {} {}\n".format(*point) for point in scan[0]))
    (folder / "part.glb").write_bytes(glb.as_glb(*scaled(part, 0.001)))
    (folder / "packed.glb").write_bytes(glb.as_quantized_glb(*scaled(part, 0.001), bits=14, is_packed=False))
    (folder / "icp.txt").write_text("1 0 0 0\n0 1 0 0\n0 0 1 0.001\n0 0 0 1\n")
    (folder / "LIST.csv").write_text("id,a,b\n" + "".join(f"{i},models/{i}.ply,out/{i}.ply\n" for i in ("37322", "49220", "96582")))
    (folder / "bin").mkdir()
    (folder / "bin/vkhausdorff").symlink_to(PROGRAM)
    (folder / "out/vkhausdorff").symlink_to(PROGRAM)
    (folder / "bin/vkh_check").symlink_to(CHECK)


def commands_of(page):
    """What is typed, without comments, and without what cuts the output off."""
    return [re.split(r"\s+#|\s+\| head", line)[0].strip() for line in COMMAND.findall(page.read_text().replace("\\\n", ""))]


def run(command, folder):
    for word in command.split():
        if "--out" in command and "--resume" not in command and word.endswith(".jsonl") and "*" not in word:
            if not word.startswith("part-") or "batch" in command:
                (folder / word).unlink(missing_ok=True)  # results of a command before
    environment = {**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}"}
    return subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True, timeout=600, env=environment)


class Pages(unittest.TestCase):
    def test_each_command_runs(self):
        for page in PAGES:
            commands = commands_of(page)
            self.assertGreater(len(commands), 0, f"{page} has no command")
            with tempfile.TemporaryDirectory() as scratch:
                folder = pathlib.Path(scratch)
                write_files(folder)
                for command in commands:
                    if TWO_DEVICES in command:
                        print(f"not run, for it needs two devices: {command}")
                        continue
                    shared = [word for word in command.split() if word.startswith("thingi10k_")]
                    if any(not (SHARED / word).exists() for word in shared):
                        print(f"not run, for it needs {SHARED}: {command}")
                        continue
                    for word in shared:
                        shutil.copy(SHARED / word, folder)
                    with self.subTest(page=page.name, command=command):
                        done = run(command, folder)
                        self.assertEqual(done.returncode, 1 if FAILS & set(shared) else 0, done.stdout[-2000:] + done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
