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


def share_at(curve, tolerance):
    """What is within less is within more: the survey's enclosures of both sides of a tolerance."""
    lower = max([low for distance, low, _ in curve if distance <= tolerance], default=0)
    upper = min([high for distance, _, high in curve if distance >= tolerance], default=1)
    return lower, max(lower, upper)


def check_share(test, text, lower, upper):
    """A share as it is printed encloses it, to a hundredth of a percent."""
    numbers = [float(word) / 100 for word in text.removesuffix(" %").split(" to ")]
    test.assertLessEqual(numbers[0], lower + 1e-9, text)
    test.assertGreaterEqual(numbers[-1], upper - 1e-9, text)
    test.assertLess(lower - numbers[0] + numbers[-1] - upper, 2.1e-4, text)


class Browser(unittest.TestCase):
    maxDiff = 2000

    def check_common(self, seen, name, mode):
        self.assertEqual((seen["console"], seen["errors"]), ([], []))
        self.assertEqual([url for url in seen["requests"] if not url.startswith(("file:", "data:"))], [])
        answer = json.loads(seen["answer"])
        self.assertTrue(seen["words"].endswith("."), seen["words"])
        self.assertEqual(seen["word"].lower(), answer.get("verdict", "distance"))
        lower, upper = seen["run"][1].strip("[]").split(", ")
        for key, digits in (("lower", lower), ("upper", upper)):  # as text, every digit
            self.assertEqual(re.search(rf'"interval":\{{.*?"{key}":([^,]+),', seen["answer"]).group(1), digits)
        self.check_counts(seen)
        self.assertTrue(seen["wide"] and seen["narrow"], "something is wider than the page")
        self.check_print(SCRATCH / f"{name}-{mode}.pdf")
        self.check_printed(seen)

    # Both directions are on the sheet, large enough to be read, with all their rows, and nothing is below its end.
    def check_printed(self, seen):
        printed = seen["printed"]
        self.assertEqual(len(printed["figures"]), len(seen["data"]["sides"]))
        for box in printed["figures"]:
            self.assertGreater(box["width"], 400)
            self.assertGreater(box["height"], 150)
        self.assertEqual(printed["whole"], [True] * 2 * len(printed["figures"]), "a row of places or figures is cut off")
        self.assertLessEqual(printed["footer"]["bottom"], printed["height"] + 1)

    # The shares beside the slider are the survey's, at each tolerance, and rounded outward.
    def check_counts(self, seen):
        steps, side = seen["data"]["steps"], seen["data"]["sides"][0]
        for key in ("start", "Home", "ArrowRight", "PageUp", "End", "dragged"):
            now = seen[key]
            at = steps["value"].index(float(now["value"]))
            self.assertEqual(now["tolerance"], steps["label"][at] + " mm")
            share = side["atLimit"] if at == seen["data"]["asked"] and "atLimit" in side else share_at(side["curve"], float(now["value"]))
            check_share(self, now["within"], *share)
            check_share(self, now["beyond"], 1 - share[1], 1 - share[0])
        self.assertEqual(float(seen["Home"]["value"]), 0)
        self.assertGreater(float(seen["PageUp"]["value"]), float(seen["ArrowRight"]["value"]))
        self.assertEqual(seen["End"]["within"], "100 %")
        self.assertEqual(seen["End"]["beyond"], "0 %")
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
        mark, stage = seen["mark"], seen["stage"]
        self.assertFalse(mark["hidden"])
        last = len(seen["places"])
        self.assertIn(last, range(1, 6))
        self.assertEqual(mark["label"], f"{last}: {seen['places'][-1]}")
        self.assertTrue(seen["pressed"].startswith(f"{last}{seen['places'][-1]}("), seen["pressed"])
        self.assertAlmostEqual(mark["x"], stage["x"] + stage["width"] / 2, delta=3)
        self.assertAlmostEqual(mark["y"], stage["y"] + stage["height"] / 2, delta=3)
        self.assertEqual(len(set(seen["views"] + [seen["place"]])), 4, "a view's button does nothing")
        self.check_overlay(seen)

    # A colour that is beyond the bar's end is named, where there is any, and so is what is not resolved.
    def check_rows(self, seen, name):
        high = seen["data"]["sides"][0]["scale"]["high"]
        over = [re.fullmatch(r"over ([0-9.e-]+) mm: (under )?[0-9.]+ % of the area", row) for row in seen["rows"]]
        over = [match for match in over if match]
        self.assertEqual(len(over), 1 if name in ("fail", "plain", "decimated") else 0, seen["rows"])
        for match in over:
            self.assertAlmostEqual(float(match[1]), high, delta=1e-3 * high)
        self.assertEqual(seen["rows"][-1], "beyond the tolerance")
        ticks = [float(text) for text in seen["ticks"]]
        self.assertEqual(ticks, sorted(ticks))
        self.assertLessEqual(ticks[-1], high * 1.001)

    # A reading has a value and a point; a click keeps it; axes are drawn, and a ruler to scale.
    def check_overlay(self, seen):
        value, low, high = self.reading(seen["read"])
        self.assertLessEqual(low, value)
        self.assertGreaterEqual(high, value)
        place = float(seen["places"][-1].split()[0])  # it lies under the cursor
        self.assertLessEqual(low, 1.001 * place, seen["read"])
        self.assertGreaterEqual(high, 0.999 * place, seen["read"])
        self.assertEqual(seen["kept"], seen["read"], "off the mesh, what was clicked is read")
        self.assertEqual(len(seen["axes"]), 3)
        self.assertGreater(max(seen["axes"]), 15)
        self.assertRegex(seen["ruler"]["text"], r"\A[125](0+|)(\.|e|) ?.*mm\Z|\A0\.0*[125] mm\Z")
        self.assertTrue(20 < seen["ruler"]["width"] <= 111, seen["ruler"])

    def reading(self, text):
        found = re.fullmatch(r"(?:farthest about here: )?([-+\u2212]?[0-9.e-]+) mm(?: (?:over|under) B)?(?:, side not known)?(?:, not resolved)?, "
                             r"between ([\u2212]?[0-9.e-]+) and ([\u2212]?[0-9.e-]+) mm, at \(([-0-9.e, ]+)\)", text)
        self.assertTrue(found, text)
        self.assertEqual(len(found[4].split(", ")), 3)
        return [float(number.replace("\u2212", "-")) for number in found.groups()[:3]]

    # A page with sides: the bar, places and readings have signs.
    def test_signs(self):
        seen = look("signed", "view")
        self.assertEqual((seen["console"], seen["errors"], seen["ready"]), ([], [], "view"))
        scale = seen["data"]["sides"][0]["scale"]
        self.assertTrue(scale["signed"])
        self.assertEqual(scale["low"], -scale["high"])
        self.assertIn("signed distance from B, estimated, mm: under B below 0, over it above", seen["title_of_bar"])
        self.assertLess(float(seen["ticks"][0].replace("\u2212", "-")), 0)
        self.assertTrue(any(text[0] in "+\u2212" for text in seen["places"]), seen["places"])
        self.assertTrue(any(row.startswith("no side known: ") for row in seen["rows"]), seen["rows"])
        value, low, high = self.reading(seen["read"])
        self.assertTrue(low <= value <= high)

    def test_views(self):
        for name, word in (("pass", "PASS"), ("fail", "FAIL"), ("undecided", "UNDECIDED"), ("plain", "DISTANCE"), ("decimated", "DISTANCE")):
            with self.subTest(name):
                seen = look(name, "view")
                self.assertEqual(seen["word"], word)
                self.check_common(seen, name, "view")
                self.check_view(seen)
                self.check_rows(seen, name)
                if name == "fail":
                    self.assertEqual(seen["back"]["mesh"], "area of B")
                    self.assertNotEqual(seen["back"]["canvas"], seen["log"])
                    self.assertNotEqual(seen["start"]["beyond"], "0 %")

    # All on B, and no bound for any face: there is nothing to scale a chart by.
    def test_nothing_to_scale_by(self):
        for name in ("zero", "unbounded"):
            with self.subTest(name):
                seen = look(name, "still")
                self.assertEqual((seen["console"], seen["errors"], seen["ready"]), ([], [], "view"))
                self.assertEqual(seen["start"]["within"], "not measured")
                self.check_print(SCRATCH / f"{name}-still.pdf")

    def test_an_index_on_a_phone(self):
        seen = look("index", "index")
        self.assertEqual((seen["console"], seen["errors"]), ([], []))
        self.assertTrue(seen["narrow"], "something is wider than the phone")
        self.assertGreaterEqual(seen["least"], 13)
        self.assertEqual([row[1] for row in seen["rows"]], ["FAIL", "FAIL", "UNDECIDED", "PASS"])
        self.assertTrue(seen["rows"][0][0].startswith("n" * 90), "the larger lower end comes first")
        self.assertTrue(seen["rows"][1][0].startswith("bad"))
        self.assertEqual(seen["rows"][1][2], "at least 0.2 mm", "an upper end that was not sought is not told")
        self.assertEqual(seen["rows"][3][2], "0.0312 to 0.0938 mm")
        self.assertNotIn("--", "".join(seen["rows"][2]), "a customer has no options")
        self.assertEqual(seen["links"], ["n" * 90 + ".html", "bad.html", "open.html", "good.html"])
        self.assertEqual(seen["labels"], ['"Deviation: "', '"Of the limit: "', '"Of A\'s diagonal: "'])

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
        self.assertEqual(seen["shown"], ["This browser cannot draw the mesh; there is no view to turn."] + 2 * ["No picture was drawn for this page."])


if __name__ == "__main__":
    prepare()
    unittest.main(argv=sys.argv[:1])
