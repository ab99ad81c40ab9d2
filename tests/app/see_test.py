"""--field, --image, --report, --figures-csv, --points-out, --stats, --bands and --area, by the program: files are read again by code that is not ours.

usage: see_test.py PROGRAM. Uses assimp's program where it is there.
"""

import csv
import json
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

PROGRAM = sys.argv[1]
SQUARE = "v 0 0 {z}\nv {x} 0 {z}\nv {x} 1 {z}\nv 0 1 {z}\nf 1 2 3\nf 1 3 4\n"
# B is the plane, and A lies over it: one face at 0.25, the other from 0.25 up to 0.5.
# From m to n on each axis, its faces outward.
CUBE = ("v {m} {m} {m}\nv {n} {m} {m}\nv {n} {n} {m}\nv {m} {n} {m}\nv {m} {m} {n}\nv {n} {m} {n}\nv {n} {n} {n}\nv {m} {n} {n}\n"
        "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
ROOF = "v 0 0 0.25\nv 1 0 0.25\nv 1 1 0.25\nv 0 1 0.5\nf 1 2 3\nf 1 3 4\n"


def ply(path):
    """Vertices and faces as tuples: only what to_ply writes."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + 11
    head = data[:end].decode()
    vertex_count, face_count = (int(head.split(f"element {name} ")[1].split()[0]) for name in ("vertex", "face"))
    vertex = struct.Struct("<dddfBBB")
    face = struct.Struct("<BiiifffBBB" + ("I" if "property uint file_face\n" in head else ""))
    assert len(data) == end + vertex_count * vertex.size + face_count * face.size, "a size that the header does not say"
    split = end + vertex_count * vertex.size
    return head, list(vertex.iter_unpack(data[end:split])), list(face.iter_unpack(data[split:]))


def glb(path):
    """The JSON, and the accessors by name as lists of tuples."""
    data = path.read_bytes()
    magic, version, size = struct.unpack("<4sII", data[:12])
    assert (magic, version, size) == (b"glTF", 2, len(data))
    length, kind = struct.unpack("<I4s", data[12:20])
    assert kind == b"JSON"
    tree = json.loads(data[20:20 + length])
    length, kind = struct.unpack("<I4s", data[20 + length:28 + length])
    binary = data[len(data) - length:]
    forms = {("SCALAR", 5126): "<f", ("VEC3", 5126): "<fff", ("VEC4", 5123): "<HHHH"}
    named = {}
    for name, index in tree["meshes"][0]["primitives"][0]["attributes"].items():
        accessor = tree["accessors"][index]
        view = tree["bufferViews"][accessor["bufferView"]]
        form = struct.Struct(forms[accessor["type"], accessor["componentType"]])
        named[name] = list(form.iter_unpack(binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]))
        assert len(named[name]) == accessor["count"]
    return tree, named


def srgb(light):
    """The byte of a linear colour of 16 bits: glTF's, as screens show it (IEC 61966-2-1)."""
    part = light / 65535
    return round(255 * (12.92 * part if part <= 0.0031308 else 1.055 * part ** (1 / 2.4) - 0.055))


def png(path):
    """Width, height and the rows' bytes, filters not undone."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0] == zlib.crc32(kind + body)
        if kind == b"IHDR":
            width, height = struct.unpack(">II", body[:8])
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    return width, height, zlib.decompress(packed)


def numbers_of(value):
    """The numbers of a JSON value that a page may show, without their signs, and differences of a share from 1."""
    if isinstance(value, dict):
        value = [item for key, item in value.items() if key not in ("curve", "times", "options", "device")]
    if isinstance(value, list):
        return {number for item in value for number in numbers_of(item)}
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return set()
    return {abs(value), 1 - value} if 0 <= value <= 1 else {abs(value)}


class See(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "roof.obj").write_text(ROOF)
        (self.folder / "plane.obj").write_text(SQUARE.format(x=1, z=0))
        (self.folder / "wide.obj").write_text(SQUARE.format(x=2, z=0))

    def run_program(self, *words, code=0):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_a_ply_and_a_glb_say_the_same_of_each_face(self):
        for ending in ("ply", "glb"):
            self.run_program("distance", "roof.obj", "plane.obj", "--unit", "mm", "--field", f"out.{ending}")
        head, vertices, faces = ply(self.folder / "out.ply")
        self.assertIn("certified, in mm", head)
        self.assertEqual([v[:3] for v in vertices], [(0, 0, 0.25), (1, 0, 0.25), (1, 1, 0.25), (0, 1, 0.5)])
        self.assertEqual([f[:4] for f in faces], [(3, 0, 1, 2), (3, 0, 2, 3)])
        for face, most in zip(faces, (0.25, 0.5)):
            lower, upper, quality = face[4:7]
            self.assertLessEqual(lower, most)
            self.assertGreaterEqual(upper, most)
            self.assertLess(upper - lower, 0.006)
            self.assertEqual(quality, upper)
        self.assertEqual(vertices[1][3], faces[0][5])
        self.assertEqual(vertices[0][3], faces[1][5])
        tree, named = glb(self.folder / "out.glb")
        self.assertEqual([u for (u,) in named["_UPPER"]], [f[5] for f in faces for _ in range(3)])
        self.assertEqual([u for (u,) in named["_LOWER"]], [f[4] for f in faces for _ in range(3)])
        self.assertEqual({c[3] for c in named["COLOR_0"]}, {65535})
        self.assertEqual([tuple(map(srgb, c[:3])) for c in named["COLOR_0"]], [f[7:10] for f in faces for _ in range(3)])
        scaled, moved = tree["nodes"]
        self.assertEqual((scaled, tree["scenes"][0]["nodes"]), ({"children": [1], "scale": [0.001, 0.001, 0.001]}, [0]))
        shift = moved["translation"]
        placed = [tuple(x + s for x, s in zip(p, shift)) for p in named["POSITION"]]
        self.assertEqual(placed, [vertices[v][:3] for f in faces for v in f[1:4]])
        self.assertEqual(tree["meshes"][0]["extras"]["unit"], "mm")
        self.assertNotEqual(faces[0][7:10], faces[1][7:10])

    def test_a_glb_is_in_metres(self):
        for unit, size in (("mm", "1 x 1 x 0.25 mm"), ("in", "1 x 1 x 0.25 in"), ("m", "1 x 1 x 0.25 m")):
            with self.subTest(unit):
                said = self.run_program("distance", "roof.obj", "plane.obj", "--unit", unit, "--field", "out.glb").stderr
                self.assertEqual(said, "")
                told = self.run_program("distance", "out.glb", "roof.obj", "--unit", unit).stdout
                self.assertIn(f"A {size} (out.glb), B {size} (roof.obj)", told)
        said = self.run_program("distance", "roof.obj", "plane.obj", "--field", "out.glb").stderr
        self.assertIn("note: out.glb: glTF is in metres", said)
        self.assertEqual([sorted(node) for node in glb(self.folder / "out.glb")[0]["nodes"]], [["mesh", "translation"]])

    def test_a_unit_is_of_the_files_that_name_none(self):
        self.run_program("distance", "roof.obj", "plane.obj", "--unit", "m", "--field", "out.glb")
        self.assertIn("converted from in to m", self.run_program("distance", "roof.obj", "out.glb", "--unit", "in").stdout)
        for words in (("out.glb", "out.glb", "--unit", "in"), ("roof.obj", "out.glb", "--unit-b", "in"), ("out.glb", "roof.obj", "--unit-a", "in")):
            self.assertIn(f"{words[2]} in: out.glb is in m", self.run_program("distance", *words, code=2).stderr)

    def test_faces_of_a_file_with_polygons_keep_their_numbers(self):
        (self.folder / "mixed.obj").write_text(ROOF.split("f 1 2 3")[0] + "v 0 1 0.25\nf 1 2 3 5\nf 1 2\nf 2 3\nf 1 3 4\n")
        self.run_program("distance", "mixed.obj", "plane.obj", "--field", "out.ply", "--report", "out.html")
        self.assertEqual([f[10] for f in ply(self.folder / "out.ply")[2]], [0, 0, 3])
        page = (self.folder / "out.html").read_text()
        self.assertIn("<small>face 3</small>", page)
        self.assertNotIn("<small>face 2</small>", page)
        self.run_program("distance", "roof.obj", "plane.obj", "--field", "out.ply")
        self.assertNotIn("file_face", ply(self.folder / "out.ply")[0])

    @unittest.skipUnless(shutil.which("assimp"), "no assimp here")
    def test_assimp_reads_both(self):
        for ending in ("ply", "glb"):
            self.run_program("distance", "roof.obj", "plane.obj", "--field", f"out.{ending}")
            said = subprocess.run(["assimp", "info", f"out.{ending}"], cwd=self.folder, capture_output=True, text=True, timeout=60).stdout
            self.assertIn("Faces:              2", said)
            self.assertRegex(said, r"Minimum point +\(0\.000000 0\.000000 0\.250000\)")
            self.assertRegex(said, r"Maximum point +\(1\.000000 1\.000000 0\.500000\)")

    def test_symmetric_writes_both_meshes(self):
        self.run_program("distance", "roof.obj", "wide.obj", "--symmetric", "--field", "out.ply", "--image", "out.png", "--size", "640x480")
        self.assertEqual(len(ply(self.folder / "out.ply")[2]), 2)
        back = ply(self.folder / "out-b.ply")[2]
        self.assertGreater(max(f[5] for f in back), 1)
        for name in ("out.png", "out-b.png"):
            width, height, rows = png(self.folder / name)
            self.assertEqual((width, height), (640, 480))
            self.assertEqual(len(rows) % height, 0)
            self.assertGreater(len(set(rows)), 20)

    def test_a_report_holds_the_answer(self):
        done = self.run_program("gate", "roof.obj", "plane.obj", "--max", "0.3mm", "--unit", "mm", "--report", "out.html", "--json", code=1)
        answer = json.loads(done.stdout)
        page = (self.folder / "out.html").read_text()
        self.assertIn('id="answer"', page)
        held = page.split('id="answer">', 1)[1].split("</script>", 1)[0]
        held = json.loads(held)
        for key in ("verdict", "words", "interval", "max"):
            self.assertEqual(held[key], answer[key])
        self.assertNotIn("field", held["directions"][0])  # cells are drawn, and no bounds of faces are asked for
        self.assertEqual(len(held["inputs"][0]["sha256"]), 64)
        self.assertNotIn("http://", page.split("<script", 1)[0].replace("http://www.w3.org", ""))

    # The numbers of all outputs are those of JSON, and what a page writes encloses or rounds them.
    def test_tables_hold_the_figures_of_json_and_of_the_page(self):
        done = self.run_program("gate", "roof.obj", "wide.obj", "--max", "0.3mm", "--unit", "mm", "--symmetric", "--report", "out.html",
                                "--title", "Roof & <b>wide", "--figures-csv", "f.csv", "--points-out", "p.csv", "--json", code=1)
        answer = json.loads(done.stdout)
        page = (self.folder / "out.html").read_text()
        self.assertIn("<h1>Roof &amp; &lt;b&gt;wide</h1>", page)
        with open(self.folder / "f.csv", newline="") as text:
            figures = list(csv.DictReader(text))
        for name, direction in zip("AB", answer["directions"]):
            rows = {row["figure"]: row for row in figures if row["from"] == name}
            self.assertEqual(float(rows["largest"]["lower"]), direction["interval"]["lower"])
            statistics = direction["statistics"]
            for figure, known in (("mean", statistics["mean"]), ("rms", statistics["rms"]), ("within 0.3 mm", statistics["bands"][0]["share"])):
                self.assertEqual([float(rows[figure][key]) for key in ("lower", "estimate", "upper")], [known[key] for key in ("lower", "estimate", "upper")])
            self.assertEqual(rows["mean"]["unit"], "mm")
            self.assertEqual(rows["within 0.3 mm"]["unit"], "1")
            self.check_page_figures(page.split("<h2>Figures of " + name, 1)[1].split("</table>", 1)[0], rows)
        with open(self.folder / "p.csv", newline="") as text:
            points = list(csv.DictReader(text))
        self.assertEqual((points[0]["from"], points[0]["place"], points[0]["unit"]), ("A", "1", "mm"))
        witness = answer["directions"][0]["witness"]["from"]
        self.assertEqual([float(points[0][axis]) for axis in "xyz"], witness["point"])
        self.assertEqual(float(points[0]["lower"]), answer["directions"][0]["interval"]["lower"])
        self.assertEqual({row["from"] for row in points}, {"A", "B"})
        for name in "AB":
            self.check_page_places(page.split("<h2>Worst places of " + name, 1)[1].split("</ol>", 1)[0], [row for row in points if row["from"] == name])
        self.assertEqual(page.count(">limit 0.3</text>"), 2)

    # Each number of the head, the figures and the legend of a page, of the words and of the table is one of JSON's, rounded to
    # the digits that are shown, and so is each share of area that a legend names.
    def test_every_number_is_one_of_json(self):
        for words, code in ((("gate", "roof.obj", "wide.obj", "--max", "0.2mm", "--unit", "mm", "--symmetric"), 1),
                            (("distance", "roof.obj", "wide.obj", "--range", "0,0.3mm", "--unit", "mm"), 0),
                            (("gate", "over.obj", "cube.obj", "--max", "0.1mm", "--unit", "mm"), 1)):
            (self.folder / "cube.obj").write_text(CUBE.format(n=1, m=0))
            (self.folder / "over.obj").write_text(CUBE.format(n=1.25, m=-0.0625))
            done = self.run_program(*words, "--report", "out.html", "--figures-csv", "f.csv", "--json", code=code)
            answer, page = json.loads(done.stdout), (self.folder / "out.html").read_text()
            known = sorted(numbers_of(answer))
            self.check_known(re.split(r" \([0-9.e-]+ % of A's diagonal|Check the inputs", answer["words"])[0], known)
            for row in csv.DictReader((self.folder / "f.csv").read_text().splitlines()):
                for key in ("estimate", "lower", "upper"):
                    self.assertIn(float(row[key] or 0), [0.0, *known], row)
            head = page.split("<header>")[1].split("</header>")[0].split("</h1>")[1]
            shown = [re.sub(r'<ul class="warnings">.*?</ul>', "", head, flags=re.S)]  # they are of boxes: sums of JSON's
            shown += re.findall(r"<h2>Figures of .*?</table>", page, re.S)
            for text in re.findall(r"<(?:p|li|dd|td|small)[^>]*>([^<]+)<", "".join(shown)):
                self.check_known(text, known)
            legends = re.findall(r'<div class="legend".*?</div>', page, re.S)
            self.assertEqual(len(legends), len(answer["directions"]))
            for legend, direction in zip(legends, answer["directions"]):
                self.check_legend(re.findall(r"</svg>([^<]+)</li>", legend), direction["map"])
            self.assertEqual(answer["directions"][0]["map"]["signed"], "cube.obj" in words)

    def check_legend(self, rows, shares):
        names = {"over": "above", "below": "below", "no side known": "no_side", "not resolved": "unresolved", "not resolved, in cells under a pixel": "unresolved"}
        rows = [row for row in rows if row != "beyond the tolerance"]
        for row in rows:
            name, share = re.fullmatch(r"(.+?)(?: [\u22120-9.e-]+ mm)?: (.+) %(?: of the area)?", row).groups()
            share = re.sub("under |over ", "", share)
            self.assertAlmostEqual(float(share), 100 * shares[names[name]], delta=max(6e-3 * float(share), 1e-2), msg=row)
        self.assertEqual({names[re.split(r" [\u2212\d]|:", row)[0]] for row in rows},
                         {name for name in ("above", "below", "no_side", "unresolved") if shares[name] > 0})

    def check_known(self, text, known):
        for number in re.findall(r"(?<![\w.])[0-9]+(?:\.[0-9]+)?(?:e[-+]?[0-9]+)?", text.replace("(", " ").replace(",", " ")):
            value = float(number)
            places = [value] + ([value / 100] if "%" in text else [])
            is_known = any(abs(one - x) <= 6e-3 * abs(x) + 1e-12 for one in places for x in known)
            self.assertTrue(is_known or value in (0, 1, 90, 95, 99, 50, 100), f"{number} in {text!r}")

    # The places of a page are the table's: an estimate to four digits, coordinates, the face, and what encloses it.
    def check_page_places(self, listed, rows):
        places = re.findall(r'<span class="length">([^<]+) mm</span><span class="where">\(([^<]+)\)<small>face (\d+)(?:, ([^<]+) mm)?</small>', listed)
        self.assertEqual(len(places), len(rows))
        for (length, where, face, known), row in zip(places, rows):
            self.assertAlmostEqual(float(length), float(row["deviation"]), delta=6e-4 * float(row["deviation"]))
            for text, axis in zip(where.split(", "), "xyz"):
                self.assertAlmostEqual(float(text), float(row[axis]), delta=1e-4)
            self.assertEqual(face, row["face"])
            self.assertLessEqual(float(row["lower"]), float(row["deviation"]))
            self.assertGreaterEqual(float(row["upper"]), float(row["deviation"]))
            ends = [float(word) for word in re.findall(r"[0-9.]+(?:e[-+]?\d+)?", known or length)]
            slack = 6e-3 * ends[-1] if len(ends) == 1 else 1e-12
            self.assertLessEqual(ends[0], float(row["lower"]) + slack)
            self.assertGreaterEqual(ends[-1], float(row["upper"]) - slack)

    def check_page_figures(self, table, rows):
        names = {"mean deviation": "mean", "root mean square": "rms", "50 % of the area is within": "p50", "area within 0.3 mm": "within 0.3 mm"}
        seen = 0
        for name, estimate, text in re.findall(r"<th scope=\"row\">([^<]+)</th><td(?: class=\"estimate\">([^<]+)<small)?>([^<]+)<", table):
            row = rows.get(names.get(name))
            if row is None:
                continue
            seen += 1
            factor = 0.01 if text.endswith("%") else 1
            if estimate:
                likely = float(row["estimate"])
                self.assertAlmostEqual(factor * float(estimate.split()[0]), likely, delta=6e-5 if factor < 1 else 6e-4 * likely)
            numbers = [factor * float(word) for word in re.findall(r"[0-9.]+(?:e[-+]?\d+)?", text)]
            lower, upper = float(row["lower"]), float(row["upper"])
            slack = 6e-3 * upper if len(numbers) == 1 else 1e-12
            self.assertLessEqual(numbers[0], lower + slack, text)
            self.assertGreaterEqual(numbers[-1], upper - slack, text)
        self.assertEqual(seen, len(names))

    def test_a_share_of_area_is_a_verdict(self):
        for share, code, verdict, words in (("80%", 0, "PASS  ", "at least 8"), ("0.95", 1, "FAIL  ", "at most 8")):
            said = self.run_program("gate", "roof.obj", "plane.obj", "--max", "0.375abs", "--area", share, code=code).stdout
            self.assertTrue(said.startswith(verdict), said)
            self.assertIn(words, said.splitlines()[0])

    def test_what_makes_no_sense_is_refused_before_the_run(self):
        for words, named in ((["--field", "out.stl"], "--field"), (["--image", "out.jpg"], "--image"), (["--report", "out.pdf"], "--report"),
                             (["--figures-csv", "out.txt"], "--figures-csv"), (["--points-out", "out.ply"], "--points-out"),
                             (["--image", "o.png", "--view", "behind"], "--view"), (["--image", "o.png", "--map", "jet"], "--map"),
                             (["--image", "o.png", "--size", "9"], "--size"), (["--image", "o.png", "--range", "1mm"], "--range"),
                             (["--image", "o.png", "--range", "0.5mm,0"], "--range '0.5mm,0': expected the shorter length first"),
                             (["--image", "o.png", "--range", "1in,3mm", "--unit", "mm"], "--range '1in,3mm': expected the shorter length first"),
                             (["--image", "o.png", "--range", "9mm,1%", "--unit", "mm"], "--range '9mm,1%': expected the shorter length first"),
                             (["--image", "o.png", "--range", "9mm,1%", "--unit", "mm"], "--range '9mm,1%'"),
                             (["--image", "o.png", "--up", "x"], "--up"), (["--bands", "0.1"], "--bands"),
                             (["--field", "missing/out.ply"], "--field")):
            with self.subTest(words):
                said = self.run_program("distance", "roof.obj", "plane.obj", *words, code=2).stderr
                self.assertIn(named, said)
        said = self.run_program("gate", "roof.obj", "plane.obj", "--max", "1abs", "--area", "120%", code=2).stderr
        self.assertIn("--area", said)
        (self.folder / "in.ply").write_bytes(b"x")
        said = self.run_program("distance", "in.ply", "plane.obj", "--field", "in.ply", code=2).stderr
        self.assertIn("--field", said)
        self.assertEqual((self.folder / "in.ply").read_bytes(), b"x")

    def test_what_would_be_ignored_or_lost_is_refused(self):
        for words in (["--size", "800x600"], ["--view", "six"], ["--steps", "5"], ["--map", "batlow"], ["--range", "0,1abs"], ["--title", "T"]):
            with self.subTest(words):
                self.assertIn(words[0], self.run_program("distance", "roof.obj", "plane.obj", *words, code=2).stderr)
        for words in (["--json=out.html", "--report", "./out.html"], ["--field", "a.ply", "--image", "a.png", "--json=a.png"], ["--figures-csv", "a.csv", "--points-out", "a.csv"]):
            with self.subTest(words):
                self.assertIn("two outputs", self.run_program("distance", "roof.obj", "plane.obj", *words, code=2).stderr)

    def test_a_verdict_that_is_known_outlives_the_survey(self):
        # B lacks a part of A, so that the directions differ: facts about one are not reported for the
        # other.
        done = self.run_program("gate", "plane.obj", "wide.obj", "--max", "0.5abs", "--stats", "--field-tol", "1e-9", "--time", "8s", "--json")
        self.assertEqual(json.loads(done.stdout)["verdict"], "pass")
        started = subprocess.Popen([PROGRAM, "distance", "wide.obj", "plane.obj", "--symmetric", "--stats", "--field-tol", "1e-12", "--bands",
                                    "0.3abs", "--json"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(2.5)
        started.send_signal(signal.SIGINT)
        out, err = started.communicate(timeout=60)
        answer = json.loads(out)
        there, back = answer["directions"]
        self.assertLessEqual(there["interval"]["lower"], 1)
        self.assertGreaterEqual(there["interval"]["upper"], 1)
        self.assertEqual(back["interval"]["lower"], 0, err)

    def test_a_run_that_ends_before_there_is_a_field_says_so(self):
        done = self.run_program("distance", "roof.obj", "plane.obj", "--field", "out.ply", "--time", "1ms", code=6)
        self.assertIn("before there were bounds", done.stderr)
        self.assertFalse((self.folder / "out.ply").exists())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
