"""Lists that are kept by hand agree: the formats that are read, wherever words name them, and the readers that are fuzzed.

docs/adding.md says where they stand.
"""
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROSE = ("README.md", "docs/batch.md", "docs/formats.md", "docs/limits.md", "docs/man/vkhausdorff.1", "host/app/commands.cpp", "host/include/vkhausdorff/mesh_io.h",
         "host/python/mesh.cpp", "host/read/mesh_io.cpp", "host/read/strangers.cpp")
# A list of formats in words. Lists of meshes name STL, lists of points do not.
LIST = re.compile(r"(?:\b(?:OBJ, STL|STL, OBJ), PLY, OFF\b|`\.obj`, `\.stl`).{,60}")
SAME_AS = {"glb": "gltf"}  # one format by two extensions
FUZZ = "tests/verification/fuzz"


def text(path: str) -> str:
    return (SOURCE / path).read_text()


def part(path: str, begin: str, end: str) -> str:
    return text(path).split(begin, 1)[1].split(end, 1)[0]


def parsers() -> dict[str, str]:
    """The parser of each extension that a mesh is read by."""
    found = {}
    for line in part("host/read/mesh_io.cpp", "Parse parser_by_extension", "\n}").splitlines():
        for extension in re.findall(r'extension == "\.(\w+)"', line):
            found[extension] = re.search(r"return (\w+);", line)[1]
    return found


def left_out(sentence: str, formats: set[str]) -> set[str]:
    """The formats that a list in words does not name."""
    words = set(re.findall(r"\w+", sentence.lower()))
    return {f for f in formats if SAME_AS.get(f, f) not in words}


class Lists(unittest.TestCase):
    def test_formats_in_words(self):
        self.assertLessEqual({"obj", "stl", "ply", "off", "gltf", "glb", "3mf"}, set(parsers()))
        for path in PROSE:
            lists = LIST.findall(" ".join(text(path).split()))
            self.assertTrue(lists, f"{path} names no formats; is its list written otherwise?")
            for sentence in lists:
                self.assertFalse(left_out(sentence, set(parsers())), f"{path}: {sentence}")

    def test_points_are_found_by_what_reads_them(self):
        known = set(re.findall(r'"\.(\w+)"', part("host/read/mesh_io.cpp", "kKnown = {", "};")))
        refusing = re.findall(r"&(parse_\w+)", part("host/read/mesh_io.cpp", "void refuse_without_points", "\n}"))
        read = set(re.findall(r'extension == "\.(\w+)"', part("host/read/mesh_io.cpp", "Parse parser_of_points", "\n}")))
        with_points = {e for e, parser in parsers().items() if parser not in refusing}
        self.assertEqual(known, read | with_points | {"las"})  # LAS is recognised by its first bytes

    def test_a_list_too_short_is_seen(self):
        self.assertEqual(left_out("OBJ, STL, PLY, OFF or glTF", {"obj", "glb", "gltf", "3mf"}), {"3mf"})

    def test_no_format_is_read_and_refused(self):
        refused = set(re.findall(r"\.(\w+)", part("host/read/strangers.cpp", "kFormats = {{", "}};")))
        self.assertIn("step", refused)
        self.assertFalse(refused & set(parsers()))

    def test_malformed_files(self):
        modules = {p.stem for p in (SOURCE / "tests/files/malformed").glob("*.py")} - {"cases", "write"}
        for path in ("tests/files/malformed/write.py", f"{FUZZ}/seeds.py"):
            imported = set(re.findall(r"^import (\w+)", text(path), re.M))
            gone_over = set(re.findall(r"\w+", re.search(r"for part in \(([\w, ]+)\)", text(path))[1]))
            self.assertFalse(modules - imported, path)
            self.assertEqual(modules, gone_over, path)

    def test_fuzzed_readers(self):
        readers = set(re.findall(r'\{"([\w-]+)", "fuzz', text(f"{FUZZ}/read_fuzz.cpp")))
        self.assertLess(8, len(readers))
        self.assertEqual(readers, set(part(f"{FUZZ}/CMakeLists.txt", "foreach(reader IN ITEMS", ")").split()))
        self.assertEqual(readers, set(re.findall(r"'([\w-]+)'", part("tools/fuzz", "READERS = (", ")"))))
        row = next(line for line in text("CONTRIBUTING.md").splitlines() if line.startswith("| `any`"))
        self.assertEqual(readers, set(re.findall(r"`([\w-]+)`", row.split("|")[1])))
        for reader in readers:
            self.assertTrue((SOURCE / FUZZ / (reader.split("-")[0] + ".dict")).exists(), reader)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
