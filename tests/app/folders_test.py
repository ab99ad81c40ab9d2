"""--image-dir and --report-dir of a batch: a file a pair, under a name that is its own, and an index that tells the truth.

usage: folders_test.py PROGRAM [TEST...]
"""

import html.parser
import json
import os
import resource
import shutil
import signal
import struct
import subprocess
import sys
import time
import unittest
import zlib

from batch_test import PROGRAM, WORDS, Folder, write_mesh

SIZE = ("--size", "640x400")
VOID = {"meta", "img", "link", "br"}


class Index(html.parser.HTMLParser):
    """The rows of its table, each of cells; checks its other parts."""

    def __init__(self, text):
        super().__init__()
        self.rows, self.links, self.images, self.open, self.tags, self.text = [], [], [], [], set(), ""
        self.feed(text)
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        named = dict(attributes)
        if tag == "tr":
            self.rows.append({"cells": [], "links": [], "images": []})
        if tag in ("td", "th"):
            self.rows[-1]["cells"].append("")
        if tag == "a":
            self.rows[-1]["links"].append(named["href"])
        if tag == "img":
            assert named["loading"] == "lazy" and named["alt"], named
            self.rows[-1]["images"].append(named["src"])
        if tag not in VOID:
            self.open.append(tag)

    def handle_decl(self, decl):
        assert decl == "doctype html", decl

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag

    def handle_data(self, data):
        self.text += data
        if self.rows and "table" in self.open and self.rows[-1]["cells"]:
            self.rows[-1]["cells"][-1] += data.strip()


def png_size(data):
    """Width and height; every chunk's sum is right, and the picture is whole."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, kinds, size = 8, [], None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0] == zlib.crc32(kind + body)
        size = struct.unpack(">II", body[:8]) if kind == b"IHDR" else size
        kinds.append(kind)
        at += 12 + length
    assert kinds[0] == b"IHDR" and kinds[-1] == b"IEND", kinds
    return size


class Folders(Folder):
    def batch(self, *words, code=0, out="out.jsonl", given="list.jsonl", **more):
        done = self.run_words("batch", given, "--out", out, *SIZE, *words, **more)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def index(self, folder="d"):
        return Index((self.folder / folder / "index.html").read_text())

    def rows(self, folder="d"):
        return {row["cells"][0]: row for row in self.index(folder).rows[1:]}

    def files(self, folder="d"):
        return sorted(path.name for path in (self.folder / folder).iterdir())

    def make_named(self, ids, **more):
        """The pairs of make_pairs() by other names."""
        self.make_pairs(len(ids), size=3)
        self.write_list([{"id": name, "a": f"{i}_a.obj", "b": f"{i}_b.obj", **more} for i, name in enumerate(ids)])


class Drawn(Folders):
    def test_a_picture_and_a_row_a_pair(self):
        self.make_named(["near", "far", "farther"])
        self.assertIn("index      d/index.html", self.batch("--image-dir", "d").stdout)
        self.assertEqual(self.files(), ["far.png", "farther.png", "index.html", "near.png"])
        for name in ("near", "far", "farther"):
            self.assertEqual(png_size((self.folder / "d" / f"{name}.png").read_bytes()), (640, 400))
        index = self.index()
        self.assertEqual([row["cells"][0] for row in index.rows], ["Pair", "farther", "far", "near"])
        self.assertIn("3 of 3 pairs have an interval within the tolerance", index.text)
        self.assertIn("Each picture has its own range of colours", index.text)
        self.assertTrue({"script", "link", "iframe", "object"}.isdisjoint(index.tags))
        results = {line["id"]: line for line in self.results()}
        for row in index.rows[1:]:
            name, word, interval, share, _ = row["cells"]
            self.assertEqual((word, row["links"], row["images"]), ("CLOSED", [f"{name}.png"], [f"{name}.png"]))
            numbers = [float(number) for number in interval.split(" to ")]
            slack = 6e-3 * numbers[0] if len(numbers) == 1 else 0  # one number is both ends', rounded to nearest
            self.assertLessEqual(numbers[0], results[name]["interval"]["lower"] + slack)
            self.assertGreaterEqual(numbers[-1], results[name]["interval"]["upper"] - slack)
            share = float(share.removeprefix("at most ").removesuffix(" %"))
            self.assertGreaterEqual(share, 100 * results[name]["interval"]["upper"] / results[name]["tolerance"]["diagonal"])

    def test_result_lines_are_the_same_without(self):
        self.make_named(["a", "b", "c"], symmetric=True, max="2abs")
        self.batch("--image-dir", "d", "--report-dir", "e", code=1)
        done = self.run_words("batch", "list.jsonl", "--out", "plain.jsonl")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(self.merged("out.jsonl"), self.merged("plain.jsonl"))

    def test_limits_and_both_directions(self):
        self.make_named(["passes", "fails", "open"])
        rows = [json.loads(line) for line in (self.folder / "list.jsonl").read_text().splitlines()]
        rows[0].update(max="2abs", symmetric=True)
        rows[1].update(max="1abs")
        self.write_list(rows)
        self.batch("--image-dir", "d", "--report-dir", "d/", code=1)
        index = self.index()
        self.assertEqual([row["cells"][:2] for row in index.rows[1:]],
                         [[index.rows[1]["cells"][0], "FAIL"], ["open", "CLOSED"], [index.rows[3]["cells"][0], "PASS"]])
        self.assertTrue(index.rows[1]["cells"][0].startswith("failsat least "), "the distance is told")
        self.assertEqual(index.rows[0]["cells"][2:5], ["Deviation", "Of the limit", "Of A's diagonal"])
        self.assertRegex(index.rows[1]["cells"][2], r"\Aat least [0-9.]+\Z", "the upper end means nothing there")
        self.assertRegex(index.rows[1]["cells"][3], r"\Aat least [0-9.]+ times\Z")
        self.assertTrue(index.rows[1]["cells"][4].startswith("at least "))
        self.assertEqual(index.rows[2]["cells"][3], "")
        self.assertEqual(index.rows[1]["links"], ["fails.html", "fails.png"])
        self.assertEqual(index.rows[3]["links"], ["passes.html", "passes.png", "passes-b.png"])
        self.assertEqual(self.files(), sorted(["index.html", "passes-b.png"] + [f"{name}.{kind}" for name in ("passes", "fails", "open") for kind in ("html", "png")]))
        for name, word in (("passes", "PASS"), ("fails", "FAIL"), ("open", "DISTANCE")):
            self.assertIn(f'<span id="word">{word}</span>', (self.folder / "d" / f"{name}.html").read_text())
        self.assertIn("1 of 3 pairs are within their limit, 1 are beyond it", index.text)

    def test_two_folders_have_an_index_each(self):
        self.make_named(["a", "b"])
        done = self.batch("--image-dir", "new/d", "--report-dir", "new/e")
        self.assertEqual([line.split()[1] for line in done.stdout.splitlines() if "  index " in line], ["new/d/index.html", "new/e/index.html"])
        self.assertEqual({row["links"][0] for row in self.index("new/d").rows[1:]}, {"a.png", "b.png"})
        self.assertEqual({row["links"][0] for row in self.index("new/e").rows[1:]}, {"a.html", "b.html"})
        self.assertNotIn("img", self.index("new/e").tags)

    def test_one_range_for_all_and_pictures_as_distance_draws_them(self):
        self.make_named(["a", "b"], symmetric=True)
        look = ["--range", "0,3abs", "--map", "batlow", "--steps", "6", "--view", "six", "--up", "y"]
        self.batch("--image-dir", "d", *look)
        for i, name in enumerate("ab"):
            self.run_words("distance", f"{i}_a.obj", f"{i}_b.obj", "--symmetric", "--image", f"{name}.png", *look, *SIZE)
            for file in (f"{name}.png", f"{name}-b.png"):
                alone, many = (self.folder / file).read_bytes(), (self.folder / "d" / file).read_bytes()
                self.assertTrue(many.startswith(alone[:-12]), file)  # all but its last chunk
        self.assertIn("Colours of lengths have the same range in every picture: 0 to 3abs.", self.index().text)

    def test_odd_ids_have_files_of_their_own(self):
        ids = ["x", "X", "../x", "x/../../x", "a  b", "a_b", "INDEX", "con", "-", "x-b", "ü", "<b>&\"'", "x\ny", "n" * 300, "n" * 301, "\u202etxt", "."]
        self.make_named(ids)
        rows = [json.loads(line) for line in (self.folder / "list.jsonl").read_text().splitlines()]
        self.write_list([{**row, "symmetric": row["id"] in "xX"} for row in rows])
        self.batch("--image-dir", "d")
        names = [name for name in self.files() if name != "index.html"]
        self.assertEqual(len(names), len(ids) + 2)
        self.assertEqual(len({name.lower() for name in names}), len(names), "nor are two the same where letters' sizes do not count")
        for name in names:
            self.assertRegex(name, r"\A[A-Za-z0-9_][A-Za-z0-9_-]{0,90}\.png\Z")
            self.assertNotIn(name.split(".")[0].lower(), ("con", "com1", "index"))
        self.assertTrue({"x.png", "x-b.png", "a_b.png"} <= set(names))
        self.assertEqual(sorted(path.name for path in self.folder.iterdir() if path.suffix == ".png"), [])
        index = self.index()
        self.assertEqual(len(index.rows) - 1, len(ids))
        self.assertEqual(sorted(sum((row["images"] for row in index.rows[1:]), [])), names)
        told = [row["cells"][0] for row in index.rows[1:]]
        self.assertTrue({"<b>&\"'", "../x", "x\\x0ay", "\\u{202e}txt"} <= set(told), told)
        before = {name: (self.folder / "d" / name).stat().st_mtime_ns for name in names}
        self.batch("--image-dir", "d", "--resume")
        self.assertEqual({name: (self.folder / "d" / name).stat().st_mtime_ns for name in names}, before)

    def test_a_bad_pair_is_named(self):
        self.make_named(["good", "<bad>", "gone"])
        (self.folder / "1_a.obj").write_text("v 0 0 zero\n")
        (self.folder / "2_a.obj").unlink()
        self.batch("--image-dir", "d", "--report-dir", "d", code=4)
        self.assertEqual(self.files(), ["good.html", "good.png", "index.html"])
        rows = self.index().rows[1:]
        self.assertEqual([row["cells"][1] for row in rows], ["NO ANSWER", "NO ANSWER", "CLOSED"])
        self.assertTrue(rows[0]["cells"][0].startswith("<bad>1_a.obj: line 1:"), rows[0])
        self.assertTrue(rows[1]["cells"][0].startswith("gone2_a.obj: "), rows[1])
        self.assertEqual((rows[0]["links"], rows[1]["links"]), ([], []))
        self.assertIn("2 without an answer", self.index().text)


class Resumed(Folders):
    def done_again(self, *words, code=0):
        before = len(self.results())
        self.batch("--image-dir", "d", "--resume", *words, code=code)
        return sorted(line["id"] for line in self.results()[before:])

    def test_a_missing_or_wrong_picture_is_drawn_again(self):
        self.make_named(["a", "b", "c"])
        self.batch("--image-dir", "d")
        right = {name: (self.folder / "d" / name).read_bytes() for name in self.files()}
        self.assertEqual(self.done_again(), [])
        (self.folder / "d" / "a.png").unlink()
        shutil.copy(self.folder / "d" / "c.png", self.folder / "d" / "b.png")
        (self.folder / "d" / "index.html").unlink()
        self.assertEqual(self.done_again(), ["a", "b"])
        self.assertEqual({name: (self.folder / "d" / name).read_bytes() for name in self.files()}, right)
        (self.folder / "d" / "a.png").write_bytes(right["a.png"][:-20])
        self.assertEqual(self.done_again(), ["a"])
        for words in (["--range", "0,1abs"], ["--range", "0,1abs", "--up", "y"], ["--view", "1,0,1"], ["--map", "cividis"]):
            self.assertEqual(self.done_again(*words), ["a", "b", "c"], words)
            self.assertEqual(self.done_again(*words), [], words)
        write_mesh(self.folder / "1_a.obj", 0.5, 3)
        self.assertEqual(self.done_again("--map", "cividis"), ["b"])
        self.assertEqual(len(self.merged().splitlines()), 3)

    def test_a_missing_report_or_way_back_is_written_again(self):
        self.make_named(["a", "b"], symmetric=True)
        self.batch("--image-dir", "d", "--report-dir", "e")
        (self.folder / "d" / "a-b.png").unlink()
        self.assertEqual(self.done_again("--report-dir", "e"), ["a"])
        (self.folder / "e" / "b.html").unlink()
        self.assertEqual(self.done_again("--report-dir", "e"), ["b"])
        self.assertEqual(self.done_again("--report-dir", "e"), [])

    def test_results_from_before_get_pictures(self):
        self.make_named(["a", "b"])
        self.assertEqual(self.run_words("batch", "list.jsonl", "--out", "out.jsonl").returncode, 0)
        self.assertEqual(self.done_again(), ["a", "b"])

    def test_the_index_has_no_picture_of_another_answer(self):
        self.make_named(["a", "b"])
        self.batch("--image-dir", "d")
        write_mesh(self.folder / "0_a.obj", 0.5, 3)
        self.run_words("batch", "list.jsonl", "--out", "out.jsonl", "--resume")
        stale = (self.folder / "d" / "a.png").read_bytes()

        def limit():  # a disk that has room for lines and the index
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

        done = subprocess.run([PROGRAM, "batch", "list.jsonl", "--out", "out.jsonl", "--image-dir", "d", "--resume", "--no-cache", *SIZE],
                              cwd=self.folder, capture_output=True, text=True, preexec_fn=limit, timeout=120)
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertEqual((self.folder / "d" / "a.png").read_bytes(), stale)
        self.assertEqual((self.rows()["a"]["images"], self.rows()["b"]["images"]), ([], ["b.png"]))

    def test_an_interrupted_batch_leaves_an_index(self):
        self.make_pairs(16, size=12)
        running = subprocess.Popen([PROGRAM, "batch", "list.jsonl", "--out", "out.jsonl", "--image-dir", "d", *SIZE], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while not (self.folder / "out.jsonl").exists() or not (self.folder / "out.jsonl").read_bytes():
            self.assertIsNone(running.poll())
            time.sleep(0.01)
        running.send_signal(signal.SIGTERM)
        err = running.communicate(timeout=60)[1]
        self.assertEqual(running.returncode, 3, err)
        done = [line["id"] for line in self.results()]
        self.assertTrue(0 < len(done) < 16)
        self.assertEqual(sorted(self.rows()), sorted(done))
        self.assertIn(f"{16 - len(done)} left", self.index().text)
        self.batch("--image-dir", "d", "--resume")
        self.assertEqual(len([row for row in self.index().rows[1:] if row["images"]]), 16)


class Refused(Folders):
    def test_before_the_work(self):
        self.make_named(["a", "b"])
        (self.folder / "file").write_text("text")
        (self.folder / "d").mkdir()
        (self.folder / "d" / "b.png").symlink_to(self.folder / "1_b.obj")
        shutil.copy(self.folder / "0_a.obj", self.folder / "d" / "A.PNG")
        self.write_list([{"id": "a", "a": "d/A.PNG", "b": "0_b.obj"}], "inside.jsonl")
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        for words, said in ((["--image-dir", "file"], "is a file, no folder"), (["--image-dir", "file/d"], "cannot be made"), (["--image-dir", ""], "--image-dir: '' is no value"),
                            (["--image-dir", "d"], "would overwrite what 'd/b.png' leads to"), (["--csv", "d/index.html", "--report-dir", "d"], "would overwrite 'd/index.html'"),
                            (["--junit", "d/b.html", "--report-dir", "d"], "would overwrite 'd/b.html'"), (["--range", "0,1abs"], "ask for --image-dir or --report-dir"),
                            (["--map", "batlow"], "ask for --image-dir or --report-dir"), (["--image-dir", "e", "--size", "1x1"], "--size")):
            with self.subTest(words):
                done = self.run_words("batch", "list.jsonl", "--out", "out.jsonl", *words)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(said, done.stderr)
                self.assertFalse((self.folder / "out.jsonl").exists())
        self.assertIn("would overwrite", self.batch("--image-dir", "d", given="inside.jsonl", code=2).stderr)
        self.assertEqual({path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}, before)

    def test_what_cannot_be_written_costs_no_result(self):
        self.make_named(["a", "b", "c"])
        (self.folder / "d" / "b.png").mkdir(parents=True)
        done = self.batch("--image-dir", "d", "--report-dir", "d", code=6)
        notes = [line for line in done.stderr.splitlines() if "note: b: --image-dir 'd/b.png'" in line]
        self.assertEqual(len(notes), 1, done.stderr)
        self.assertEqual(sorted(line["id"] for line in self.results()), ["a", "b", "c"])
        self.assertEqual({line["code"] for line in self.results()}, {0})
        self.assertEqual(self.rows()["b"]["links"], ["b.html"])
        (self.folder / "d" / "b.png").rmdir()
        self.batch("--image-dir", "d", "--report-dir", "d", "--resume")
        self.assertEqual(self.rows()["b"]["links"], ["b.html", "b.png"])

    def test_a_range_that_the_files_do_not_resolve(self):
        self.make_named([f"p{i}" for i in range(7)])
        done = self.batch("--image-dir", "d", "--range", "0,1mm", code=6)
        self.assertEqual(len([line for line in done.stderr.splitlines() if "--range" in line]), 5, done.stderr)
        self.assertIn("and 2 more pairs are not drawn", done.stderr)
        self.assertEqual(len(self.results()), 7)
        self.batch("--image-dir", "d", "--range", "0,1mm", "--unit", "mm", "--resume")


class SideBySide(Folders):
    @unittest.skipIf(os.environ.get("VKH_SANITIZED"), "the layer's own leaks cannot be told apart (tools/test)")
    def test_the_validation_layer_is_silent(self):
        self.make_named([str(i) for i in range(4)], symmetric=True)
        done = self.batch("--image-dir", "d", "--report-dir", "d", "--together", "2", "--lanes", "2",
                          env={"VK_INSTANCE_LAYERS": "VK_LAYER_KHRONOS_validation",
                               "VK_LAYER_ENABLES": "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT"})
        for text in (done.stdout, done.stderr):
            for word in ("VUID", "SYNC-HAZARD", "Validation"):
                self.assertNotIn(word, text)
        self.assertEqual(len(self.files()), 13)
        alone = self.batch("--image-dir", "e", "--report-dir", "e", "--together", "1", "--lanes", "1", out="alone.jsonl")
        self.assertNotIn("vkhausdorff: ", alone.stderr)  # but perhaps lines of progress
        for i in range(4):
            self.assertEqual((self.folder / "d" / f"{i}.png").read_bytes(), (self.folder / "e" / f"{i}.png").read_bytes())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *WORDS], verbosity=2)
