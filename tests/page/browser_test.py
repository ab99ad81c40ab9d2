"""The report's page in Debian's chromium, without a network: its text, pictures, counts and prints.

usage: browser_test.py WRITE_PAGES SOURCE SCRATCH. Exit code 77: no node, no chromium, or npm's
packages are not available.
"""

import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import unittest
import zlib

WRITE_PAGES = sys.argv[1]
SOURCE, SCRATCH = (pathlib.Path(path).resolve() for path in sys.argv[2:4])
TEST = SCRATCH / "test"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


def skip(why):
    print(f"browser_test: skipped, {why}")
    sys.exit(77)


def prepare():
    if not CHROMIUM:
        skip("no chromium here")
    if not shutil.which("node") or not shutil.which("npm"):
        skip("no node here")
    TEST.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json", "browser.mjs"):
        shutil.copy(SOURCE / "tests/page" / name, TEST)
    if not (TEST / "node_modules/puppeteer-core").exists():
        done = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=TEST, capture_output=True, text=True)
        if done.returncode:
            skip("npm cannot fetch puppeteer-core: " + done.stderr.strip()[-200:])
    (SCRATCH / "picture.png").write_bytes(png(64, 48))
    subprocess.run([WRITE_PAGES, SCRATCH], check=True, capture_output=True)


def png(width, height):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes((90, 140, 200)) * width for _ in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def look(name, mode):
    done = subprocess.run(["node", "browser.mjs", CHROMIUM, SCRATCH, name, mode], cwd=TEST, capture_output=True, text=True, timeout=300)
    if done.returncode:
        raise AssertionError(done.stderr)
    return json.loads(done.stdout)


def number(cell):
    return int(cell.replace(",", ""))


class Browser(unittest.TestCase):
    maxDiff = 2000

    def check_common(self, seen, name, mode):
        self.assertEqual((seen["console"], seen["errors"]), ([], []))
        self.assertEqual([url for url in seen["requests"] if not url.startswith(("file:", "data:"))], [])
        answer = json.loads(seen["answer"])
        said = seen["words"] if seen["word"] == "DISTANCE" else seen["word"] + "  " + seen["words"]
        self.assertEqual(said, answer["words"])
        self.assertEqual(seen["word"].lower(), answer.get("verdict", "distance"))
        lower, upper = seen["digits"].strip("[]").split(", ")
        for key, digits in (("lower", lower), ("upper", upper)):  # as text, every digit
            self.assertEqual(re.search(rf'"interval":\{{.*?"{key}":([^,]+),', seen["answer"]).group(1), digits)
        self.check_counts(seen)
        self.assertTrue(seen["wide"] and seen["narrow"], "something is wider than the page")
        self.check_print(SCRATCH / f"{name}-{mode}.pdf")

    # The numbers beside the slider are the file's, at each of its steps.
    def check_counts(self, seen):
        steps, side = seen["data"]["steps"], seen["data"]["sides"][0]
        for key in ("start", "Home", "ArrowRight", "PageUp", "End", "dragged"):
            now = seen[key]
            at = steps["value"].index(float(now["value"]))
            self.assertEqual(now["tolerance"], steps["label"][at] + " mm")
            self.assertEqual(number(now["within"][0]), side["within"][at])
            self.assertEqual(number(now["beyond"][0]), side["beyond"][at])
            self.assertEqual(sum(number(now[row][0]) for row in ("within", "undecided", "beyond")), side["faces"])
            share = side["withinArea"][at]
            self.assertIn(now["within"][1], (f"{100 * share:.2f} %", "0 %", "100 %", "< 0.01 %", "> 99.99 %"))
        self.assertEqual(float(seen["Home"]["value"]), 0)
        self.assertGreater(float(seen["PageUp"]["value"]), float(seen["ArrowRight"]["value"]))
        self.assertEqual(number(seen["End"]["within"][0]), side["faces"])
        self.assertNotEqual(seen["Home"]["within"], seen["End"]["within"])

    def check_print(self, path):
        data = path.read_bytes()
        self.assertEqual(len(re.findall(rb"/Type\s*/Page\b", data)), 1)
        width, height = map(float, re.search(rb"/MediaBox\s*\[\s*0 0 ([\d.]+) ([\d.]+)", data).groups())
        self.assertAlmostEqual(width, 595.28, delta=1)
        self.assertAlmostEqual(height, 841.89, delta=1)

    def check_view(self, seen):
        self.assertEqual(seen["ready"], "view")
        self.assertEqual(seen["shown"], [])
        pictures = [seen[key]["canvas"] for key in ("Home", "dragged", "End")]
        self.assertEqual(len(set(pictures)), 3, "the slider does not recolour")
        self.assertNotIn(seen["place"], pictures)
        self.assertNotEqual(seen["place"], seen["log"])
        mark, stage = seen["mark"], seen["stage"]
        self.assertFalse(mark["hidden"])
        self.assertTrue(mark["label"].startswith("2: "), mark["label"])  # the third in the list: the witness is the first
        self.assertTrue(seen["pressed"].startswith("2face"), seen["pressed"])
        self.assertAlmostEqual(mark["x"], stage["x"] + stage["width"] / 2, delta=3)
        self.assertAlmostEqual(mark["y"], stage["y"] + stage["height"] / 2, delta=3)

    def test_views(self):
        for name, word in (("pass", "PASS"), ("fail", "FAIL"), ("undecided", "UNDECIDED"), ("plain", "DISTANCE"), ("decimated", "DISTANCE")):
            with self.subTest(name):
                seen = look(name, "view")
                self.assertEqual(seen["word"], word)
                self.check_common(seen, name, "view")
                self.check_view(seen)
                if name == "fail":
                    self.assertEqual(seen["back"]["mesh"], "B")
                    self.assertNotEqual(seen["back"]["canvas"], seen["log"])
                    self.assertGreater(number(seen["start"]["beyond"][0]), 0)

    # All on B, and no bound for any face: there is nothing to scale a chart by.
    def test_nothing_to_scale_by(self):
        for name in ("zero", "unbounded"):
            with self.subTest(name):
                seen = look(name, "still")
                self.assertEqual((seen["console"], seen["errors"], seen["ready"]), ([], [], "view"))
                side = seen["data"]["sides"][0]
                self.assertEqual(number(seen["start"]["within"][0]), side["faces"] if name == "zero" else 0)
                self.check_print(SCRATCH / f"{name}-still.pdf")

    def test_odd_names_are_text(self):
        seen = look("odd", "view")
        self.check_common(seen, "odd", "view")
        self.assertTrue(json.loads(seen["answer"])["inputs"][0]["path"].startswith("</script>"))
        self.assertNotEqual(seen["title"], "taken")

    def test_without_webgl_the_picture_stands_in(self):
        seen = look("odd", "picture")
        self.check_common(seen, "odd", "picture")
        self.assertEqual(seen["ready"], "picture")
        self.assertEqual(seen["shown"], ["This browser cannot draw the mesh; there is no view to turn.", "64x48"])
        seen = look("fail", "picture")
        self.check_common(seen, "fail", "picture")
        self.assertEqual(seen["shown"], ["This browser cannot draw the mesh; there is no view to turn.", "No picture was drawn for this page."])


if __name__ == "__main__":
    prepare()
    unittest.main(argv=sys.argv[:1])
