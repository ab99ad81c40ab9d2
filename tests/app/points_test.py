#!/usr/bin/env python3
"""--points: files, members, words, pages and certificates of points, and what is refused.

usage: points_test.py PROGRAM VKH_CHECK
That h and figures of points are true: tests/solve/point_distances_test.cpp.
"""

import json
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import unittest

CHECK = os.path.abspath(sys.argv.pop(2))
PROGRAM = os.path.abspath(sys.argv.pop(1))
ROOT = pathlib.Path(__file__).resolve().parents[2]


def ply(points, faces=None):
    """Binary, in doubles."""
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    head += "property double x\nproperty double y\nproperty double z\n"
    if faces is not None:
        head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\n"
    body = b"".join(struct.pack("<3d", *p) for p in points)
    return (head + "end_header\n").encode() + body + b"".join(struct.pack("<B3i", 3, *f) for f in faces or [])


def las(numbers, scale, offset):
    """LAS 1.2, point format 0."""
    head = bytearray(227)
    head[0:4], head[24], head[25] = b"LASF", 1, 2
    struct.pack_into("<HII", head, 94, 227, 227, 0)
    struct.pack_into("<HI", head, 105, 20, len(numbers))
    struct.pack_into("<6d", head, 131, *scale, *offset)
    return bytes(head) + b"".join(struct.pack("<3i", *n) + bytes(8) for n in numbers)


SHEET = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (4, 4, 1)], [(0, 1, 2), (1, 3, 2)]


def cloud(count):
    rng = random.Random(41)
    return [tuple(rng.uniform(-1, 4) for _ in range(3)) for _ in range(count)]


class Points(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)

    def run_here(self, *words):
        return subprocess.run([str(word) for word in words], cwd=self.folder, capture_output=True, text=True, timeout=600)

    def ask(self, *words, codes=(0,)):
        done = self.run_here(PROGRAM, *words, "--json")
        self.assertIn(done.returncode, codes, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def proven(self, a, b):
        done = self.run_here(CHECK, "out.vhc", a, b)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("points alone, no surface", done.stdout)

    def write(self, name, data):
        (self.folder / name).write_bytes(data)
        return name

    def test_certificates(self):
        self.write("a.ply", ply(cloud(40)))
        self.write("b.ply", ply(*SHEET))
        for words in (["a.ply", "b.ply", "--points", "a"], ["b.ply", "a.ply", "--points", "b", "--tol", "1e-3abs"],
                      ["a.ply", "a.ply", "--points", "both", "--symmetric"]):
            self.ask("distance", *words, "--certificate", "out.vhc", codes=(0, 3))
            self.proven(*words[:2])

    def test_both_checkers_read_points_as_such(self):
        """Another reading of the same bytes is none of the certificate's: a file has faces or it is points."""
        vertices, faces = SHEET
        rows = "".join("v {!r} {!r} {!r}\n".format(*p) for p in vertices)
        self.write("points.obj", rows.encode())
        self.write("mesh.obj", (rows + "".join("f {} {} {}\n".format(*(v + 1 for v in f)) for f in faces)).encode())
        self.write("scan.obj", "".join("v {!r} {!r} {!r}\n".format(*p) for p in cloud(12)).encode())
        for b, how, other in (("mesh.obj", "a", "points.obj"), ("points.obj", "both", "mesh.obj")):
            self.ask("distance", "scan.obj", b, "--points", how, "--certificate", "out.vhc")
            for checker in ([CHECK], [sys.executable, "-B", ROOT / "check" / "vkh_check.py"]):
                for words, code in ((("scan.obj", b), 0), (("scan.obj", other), 4), ((b, "scan.obj"), 4 if how == "a" else 1)):
                    done = self.run_here(*checker, "out.vhc", *words)
                    self.assertEqual(done.returncode, code, (checker, words, done.stdout, done.stderr))

    def test_las_is_measured_with_its_rounding(self):
        rng = random.Random(42)
        numbers = [tuple(rng.randrange(-2000, 2000) for _ in range(3)) for _ in range(200)]
        scale, offset = (1e-3, 3e-4, 0.7), (0.1, -4e5, 1e-9)
        self.write("a.las", las(numbers, scale, offset))
        self.write("b.ply", ply([tuple(x + o for x, o in zip(p, offset)) for p in SHEET[0]], SHEET[1]))
        answer = self.ask("distance", "a.las", "b.ply", "--points", "a", "--certificate", "out.vhc")
        delta = answer["inputs"][0]["delta"]
        self.assertGreater(delta, 0)
        self.assertLess(delta, 1e-9)
        self.proven("a.las", "b.ply")

    def test_figures_of_points(self):
        heights = [0.0, 0.0, 0.25, 0.5, 1.0, 4.0]
        self.write("a.ply", ply([(0.5, 0.25, h) for h in heights]))
        self.write("b.ply", ply([(0, 0, 0), (4, 0, 0), (0, 4, 0)], [(0, 1, 2)]))
        answer = self.ask("distance", "a.ply", "b.ply", "--points", "a", "--bands", "0.3abs", "--max-distance", "2abs", "--field", "f.ply")
        figures = answer["directions"][0]["statistics"]
        self.assertEqual((figures["points"], figures["area"], figures["max_distance"]), (6, 0, 2))
        self.assertAlmostEqual(figures["kept"]["lower"], 5 / 6, 9)
        self.assertAlmostEqual(figures["mean"]["upper"], sum(heights[:5]) / 5, 3)
        self.assertAlmostEqual(figures["bands"][0]["share"]["lower"], 3 / 5, 9)
        self.assertGreaterEqual(answer["interval"]["upper"], 4)  # which is of all of A
        self.check_field(heights)
        for words, what in ((["--stats", "--signed"], "no --area, no sides"), ([], "ask for --stats, --bands, --image or --report")):
            done = self.run_here(PROGRAM, "distance", "a.ply", "b.ply", "--points", "a", "--max-distance", "1abs", *words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(what, done.stderr)

    def check_field(self, heights):
        data = (self.folder / "f.ply").read_bytes()
        head, body = data.split(b"end_header\n", 1)
        self.assertIn(b"property float distance\nproperty float lower\nproperty float upper\n", head)
        self.assertNotIn(b"element face", head)
        rows = list(struct.iter_unpack("<3d3f3B", body))
        self.assertEqual(len(rows), len(heights))
        for row, height in zip(rows, heights):
            self.assertEqual(row[:3], (0.5, 0.25, height))
            self.assertLessEqual(row[4], height)
            self.assertGreaterEqual(row[5], height)
            self.assertLess(abs(row[3] - height), 0.05)

    def test_verdicts_name_points(self):
        self.write("a.xyz", b"0 0 0\n1 0 0.5\n0 1 0\n0.2 0.2 0.1\n")
        self.write("b.ply", ply([(-4, -4, 0), (8, -4, 0), (-4, 8, 0)], [(0, 1, 2)]))
        fail = self.run_here(PROGRAM, "gate", "a.xyz", "b.ply", "--points", "a", "--max", "0.2abs")
        self.assertEqual(fail.returncode, 1)
        self.assertIn("point 1 of A, limit 0.2", fail.stdout.splitlines()[0])
        self.assertIn("a.xyz: 4 points\n", fail.stdout)
        share = self.run_here(PROGRAM, "gate", "a.xyz", "b.ply", "--points", "a", "--max", "0.2abs", "--area", "70%")
        self.assertEqual(share.returncode, 0, share.stdout)
        self.assertRegex(share.stdout, r"^PASS .*at least 7[45][.0-9]* % of A's points are within 0.2 of B")
        signed = self.ask("gate", "a.xyz", "b.ply", "--points", "a", "--max=+0.6abs,-0.01abs")
        self.assertEqual(signed["verdict"], "pass")

    def pages_data(self, name):
        """The text of a page, and what its viewer reads."""
        page = (self.folder / name).read_text()
        return page, json.loads(page.split('<script type="application/json" id="data">')[1].split("</script>")[0])

    def test_pictures_and_pages_of_points(self):
        rng = random.Random(45)
        heights = [rng.uniform(0, 0.5) for _ in range(30)] + [30.0] * 10
        self.write("scan.ply", ply([(rng.uniform(-2, 2), rng.uniform(-2, 2), h) for h in heights]))
        self.write("part.ply", ply([(-9, -9, 0), (9, -9, 0), (0, 9, 0)], [(0, 1, 2)]))
        words = ["scan.ply", "part.ply", "--points", "a", "--unit", "mm", "--symmetric", "--size", "640x400", "--tol", "1e-3mm", "--effort", "2000"]
        self.ask("distance", *words, "--image", "all.png", "--report", "all.html", "--points-out", "all.csv", "--figures-csv", "figures.csv", codes=(0, 3))
        page, data = self.pages_data("all.html")
        self.assertEqual([side["of"] for side in data["sides"]], ["points of A", "area of B"])
        self.assertEqual([side["mesh"]["faces"] for side in data["sides"]][0], 40)
        self.assertGreater(data["sides"][0]["mesh"]["spacing"], 0)
        self.assertEqual(data["sides"][1]["mesh"]["spacing"], 0)
        self.assertIn("% of the points are within", page)
        self.assertIn("% of the area is within", page)
        places = (self.folder / "all.csv").read_text().splitlines()
        self.assertAlmostEqual(float(places[1].split(",")[5]), 30, 3)
        self.assertGreaterEqual(int(places[1].split(",")[8]), 30)  # the point's number
        # Without the strays: the bar ends at what is left, they have no place, and their share is told.
        self.ask("distance", *words, "--max-distance", "1mm", "--image", "near.png", "--report", "near.html", "--points-out", "near.csv", codes=(0, 3))
        page, data = self.pages_data("near.html")
        self.assertLess(data["sides"][0]["scale"]["high"], 0.6)
        self.assertIn("left out, over 1 mm: 25 % of the points", page)
        self.assertRegex(page, r"left out, farther than 1 mm</th><td>(24\.99 to )?25(\.0[01])? % of the points")
        self.assertIn("30", (self.folder / "near.csv").read_text().split("deviation")[0] + page)  # the largest deviation is of all
        rows = [row.split(",") for row in (self.folder / "near.csv").read_text().splitlines()[1:]]
        self.assertLess(max(float(row[5]) for row in rows if row[0] == "A"), 1)

    def test_a_batch_draws_points(self):
        self.write("near.ply", ply([(0.1 * i, 0.2, 0.01 * i) for i in range(9)] + [(0, 0, 40)]))
        self.write("part.ply", ply([(-9, -9, 0), (9, -9, 0), (0, 9, 0)], [(0, 1, 2)]))
        self.write("draw.csv", b"id,a,b,points\n1,near.ply,part.ply,a\n2,part.ply,part.ply,\n")
        words = ["batch", "draw.csv", "--out", "draw.jsonl", "--image-dir", "pictures", "--report-dir", "pages", "--size", "640x400"]
        done = self.run_here(PROGRAM, *words, "--max-distance", "1abs")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("left out, over 1: 10 % of the points", (self.folder / "pages" / "1.html").read_text())
        self.assertIn("left out, farther than 1</th><td>0 % of the area", (self.folder / "pages" / "2.html").read_text())
        first = (self.folder / "pictures" / "1.png").read_bytes()
        # Another distance is another picture: the old one is no answer to it.
        done = self.run_here(PROGRAM, *words, "--resume")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertNotEqual((self.folder / "pictures" / "1.png").read_bytes(), first)
        self.assertNotIn("left out", (self.folder / "pages" / "1.html").read_text().split("<script>")[0])
        done = self.run_here(PROGRAM, "batch", "draw.csv", "--out", "none.jsonl", "--max-distance", "1abs")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--image-dir or --report-dir", done.stderr)

    def test_points_without_the_option_are_told_of_it(self):
        self.write("part.ply", ply([(-9, -9, 0), (9, -9, 0), (0, 9, 0)], [(0, 1, 2)]))
        self.write("vertices.ply", ply([(0, 0, 1), (1, 0, 1)]))
        rows = b"0 0 1\n1 0 1\n"
        for name in ("rows.xyz", "rows.txt", "rows", "rows.pts"):
            self.write(name, rows)
        self.write("rows.csv", b"0,0,1\n1,0,1\n")
        self.write("scan.las", las([(0, 0, 1)], (1, 1, 1), (0, 0, 0)))
        self.write("v.obj", b"v 0 0 1\nv 1 0 1\n")
        for name in ("vertices.ply", "rows.xyz", "rows.txt", "rows", "rows.pts", "rows.csv", "scan.las", "v.obj"):
            pair = ("part.ply", name) if name == "scan.las" else (name, "part.ply")
            done = self.run_here(PROGRAM, "distance", *pair)
            self.assertEqual(done.returncode, 4, (pair, done.stderr))
            self.assertIn("--points a measures points, b those of the second file", done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for name in ("rows.txt", "rows", "rows.csv"):
            self.assertEqual(self.ask("distance", name, "part.ply", "--points", "a")["inputs"][0]["faces"], 2)
        self.write("decimals.csv", b"0,0 0,0 1,0\n1,0 0,0 1,0\n")
        done = self.run_here(PROGRAM, "distance", "decimals.csv", "part.ply", "--points", "a")
        self.assertEqual(done.returncode, 4)
        self.assertIn("decimals.csv: line 1: decimal commas, as in '0 0'; expected decimal points", done.stderr)

    def test_a_heading_says_which_columns_are_measured(self):
        """Each point is 3 over the sheet, and would lie on it if its number were x, x y, and y z."""
        self.write("sheet.ply", ply([(-99, -99, 0), (99, -99, 0), (0, 99, 0)], [(0, 1, 2)]))
        rows = "".join(f"{i} {i % 3} 0 3\n" for i in range(5))
        for name, text in (("heading.xyz", "ID X Y Z\n" + rows), ("heading.csv", "ID,X,Y,Z\n" + rows.replace(" ", ",")), ("comment.txt", "# id x y z\n" + rows)):
            self.write(name, text.encode())
            answer = self.ask("gate", name, "sheet.ply", "--points", "a", "--max", "0.1abs", codes=(1,))
            self.assertIn("unread: x, y and z are columns 2, 3 and 4", [f"{note['code']}: {note['text'][:33]}" for note in answer["inputs"][0]["notes"]])
        self.write("none.xyz", rows.encode())
        done = self.run_here(PROGRAM, "gate", "none.xyz", "sheet.ply", "--points", "a", "--max", "0.1abs")
        self.assertEqual(done.returncode, 4)
        self.assertIn("expected a heading that says which: id x y z or x y z a", done.stderr)

    def test_what_is_no_question_is_refused(self):
        self.write("a.ply", ply([(0, 0, 0), (1, 0, 1)]))
        self.write("b.ply", ply([(0, 0, 0), (4, 0, 0), (0, 4, 0)], [(0, 1, 2)]))
        for words, code, what in (
                (["distance", "a.ply", "b.ply"], 4, "2 points and no element 'face'"),
                (["distance", "b.ply", "a.ply", "--points", "a"], 4, "1 face in a file of points"),
                (["distance", "b.ply", "b.ply", "--points", "both"], 4, "1 face in a file of points"),
                (["distance", "a.ply", "b.ply", "--points", "c"], 2, "expected a, b or both"),
                (["distance", "b.ply", "a.ply", "--points", "b", "--signed"], 2, "--signed: a.ply is points, which have no sides"),
                (["distance", "a.ply", "b.ply", "--points", "a", "--symmetric", "--signed"], 2, "which have no sides"),
                (["distance", "a.ply", "b.ply", "--points", "a", "--field", "x.glb"], 2, "written as .ply"),
                (["gate", "a.ply", "b.ply", "--points", "a", "--max", "1abs", "--face-max", "b.ply"], 2, "which have no faces")):
            done = self.run_here(PROGRAM, *words)
            self.assertEqual(done.returncode, code, (words, done.stdout, done.stderr))
            self.assertIn(what, done.stderr, words)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for words, is_noted in ((["b.ply", "a.ply", "--points", "b"], True), (["a.ply", "b.ply", "--points", "a"], False),
                                (["a.ply", "b.ply", "--points", "a", "--symmetric"], True), (["a.ply", "a.ply", "--points", "both"], False)):
            answer = self.ask("distance", *words, "--tol", "1e-3abs")
            self.assertEqual("points" in [note["code"] for note in answer["notes"]], is_noted, words)

    def test_lists_and_folders_take_points(self):
        for name in ("scans", "parts"):
            (self.folder / name).mkdir()
        self.write("scans/p.las", las([(0, 0, 1), (1, 0, 2)], (1, 1, 1), (0, 0, 0)))
        self.write("parts/p.ply", ply([(-9, -9, 0), (9, -9, 0), (0, 9, 0)], [(0, 1, 2)]))
        self.write("l.csv", b"id,a,b,points\n1,scans/p.las,parts/p.ply,a\n2,scans/p.las,parts/p.ply,\n3,scans/p.las,parts/p.ply,both\n")
        done = self.run_here(PROGRAM, "batch", "l.csv", "--out", "l.jsonl")
        self.assertEqual(done.returncode, 4, done.stderr)
        lines = {line["id"]: line for line in map(json.loads, (self.folder / "l.jsonl").read_text().splitlines())}
        self.assertAlmostEqual(lines["1"]["interval"]["upper"], 2, 5)
        self.assertIn("a LAS file (points, no faces)", lines["2"]["error"]["message"])
        self.assertIn("1 face in a file of points", lines["3"]["error"]["message"])
        done = self.run_here(PROGRAM, "batch", "scans", "parts", "--points", "a", "--out", "f.jsonl")
        self.assertEqual(done.returncode, 0, done.stderr)
        again = self.run_here(PROGRAM, "batch", "scans", "parts", "--points", "a", "--out", "f.jsonl", "--resume")
        self.assertRegex(again.stdout, r"\n  pairs      0 pairs in [0-9.]+ s; 1 was done before\n")


if __name__ == "__main__":
    unittest.main()
