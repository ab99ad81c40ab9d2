#!/usr/bin/env python3
"""The rooms of shaders/, host/ and tests/: every file is in one, and includes only files before it.

  rooms_test.py [ROOT]    exits 1 and names each arrow upwards, cycle, file without one
  rooms_test.py --table   files, and levels within, of each room

The order of the rooms below is the way of the data.
"""

import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ROOMS = {
    "shaders": ["math", "base", "bvh", "traversal", "wave", "paper", "report", "survey", "doctor"],
    "host": ["base", "mesh", "read", "gpu", "native", "solve", "survey", "write", "simplify", "answer", "show", "batch", "app"],
    "tests": ["verification/oracle", "shapes", "support", "verification/model", "verification/math", "unit", "files/malformed", "files",
              "engine", "solve", "page", "verification/check", "verification/faults", "app", "python", "platforms",
              "verification/fuzz", "verification/sanitize", "verification/proofs"],
}
FLOORS = list(ROOMS)
OUTSIDE = {"gpu_types.h", "stages.h"}  # seen by both languages: before every room
BESIDE = {"host/python", "tests/package", "tests/verification/layer"}  # with builds of their own: after all of the floor's rooms
# The public headers of host/ lie in one folder, as they are installed; each belongs to a room.
PUBLIC = {
    "base": "error length limit needs_cpp20 note sha256",
    "gpu": "device device_description",
    "mesh": "file_faces frame mesh mesh_transform polygon",
    "read": "mesh_io place read_limits",
    "solve": "align closest_points engine_options face_gate report solve_options solver stream together verify",
    "survey": "cell_map certificate field metrics prover side survey",
    "write": "colour_map field_file",
    "simplify": "levels simplify",
    "answer": "answer asking question work_meter",
}
PUBLIC_FOLDER = "host/include/vkhausdorff"
ROOM_OF_PUBLIC = {f"{PUBLIC_FOLDER}/{name}.h": room for room, names in PUBLIC.items() for name in names.split()}
INCLUDING = {".h", ".c", ".cpp", ".glsl", ".comp"}
SOURCES = {*INCLUDING, ".py", ".sh"}


def files_of(root):
    """Every source of the rooms' floors, as a path from the root, and what it includes."""
    out = {}
    for floor in ROOMS:
        for path in sorted((root / floor).rglob("*")):
            if path.suffix in SOURCES:
                text = path.read_text() if path.suffix in INCLUDING else ""
                found = re.findall(r'^\s*#\s*include "((?:host|shaders|tests|vkhausdorff)/[^"]+)"', text, re.M)
                out[path.relative_to(root).as_posix()] = [
                    f"host/include/{name}" if name.startswith("vkhausdorff/") else name for name in found]
    return out


def level_of(path):
    """The place of a file's room on its floor; None for a file that is in none."""
    floor, _, inner = path.partition("/")
    room, _, name = inner.rpartition("/")
    room = ROOM_OF_PUBLIC.get(path, room)
    if not room:
        return -1 if name in OUTSIDE else None
    if any(path.startswith(f"{beside}/") for beside in BESIDE):
        return len(ROOMS[floor])
    return ROOMS[floor].index(room) if room in ROOMS[floor] else None


def without_room(files):
    return [f"{path}: is in no room" for path in files if level_of(path) is None]


def arrows_up(files):
    for path, includes in files.items():
        for included in includes:
            if included not in files:
                yield f"{path}: includes {included}, which is not there"
                continue
            if path.split("/")[0] != included.split("/")[0]:
                if FLOORS.index(included.split("/")[0]) > FLOORS.index(path.split("/")[0]):
                    yield f"{path}: includes {included}, a floor above it"
                continue
            here, there = level_of(path), level_of(included)
            if None not in (here, there) and there > here:
                yield f"{path}: includes {included}, which stands after it"


def cycles(files):
    """Files that include themselves by way of others, each once."""
    done, on_way = set(), []

    def visit(path):
        if path in on_way:
            yield " -> ".join([*on_way[on_way.index(path):], path])
            return
        if path in done or path not in files:
            return
        done.add(path)
        on_way.append(path)
        for included in files[path]:
            yield from visit(included)
        on_way.pop()

    for path in files:
        yield from visit(path)


def breaches(root):
    files = files_of(root)
    return [*without_room(files), *arrows_up(files), *cycles(files)]


def depth(files, path, known):
    """Levels of includes below a file, within its room."""
    if path not in known:
        room = path.rsplit("/", 1)[0]
        inner = [p for p in files.get(path, []) if p.rsplit("/", 1)[0] == room]
        known[path] = 1 + max((depth(files, p, known) for p in inner), default=0)
    return known[path]


def print_table(root):
    files, known = files_of(root), {}
    for floor, rooms in ROOMS.items():
        for room in rooms:
            inside = [p for p in files if p.rpartition("/")[0] == f"{floor}/{room}"]
            levels = max((depth(files, p, known) for p in inside), default=0)
            print(f"{floor}/{room:<22} {len(inside):3} files {levels:3} levels")


class Rooms(unittest.TestCase):
    def test_the_house(self):
        self.assertEqual(breaches(ROOT), [])

    def breach(self, changes):
        """The complaints about a small house with these files in it."""
        house = {"shaders/gpu_types.h": "", "shaders/math/a.h": '#include "shaders/gpu_types.h"\n',
                 "shaders/traversal/b.glsl": '#include "shaders/math/a.h"\n',
                 "host/base/c.h": "", "host/gpu/d.cpp": '#include "host/base/c.h"\n', **changes}
        with tempfile.TemporaryDirectory() as folder:
            for name, text in house.items():
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return "\n".join(breaches(Path(folder)))

    def test_what_breaks_it_is_named(self):
        self.assertEqual(self.breach({}), "")
        for changes, named in [
                ({"host/base/c.h": '#include "host/gpu/e.h"\n', "host/gpu/e.h": ""},
                 "host/base/c.h: includes host/gpu/e.h, which stands after it"),
                ({"shaders/math/a.h": '#include "shaders/traversal/b.glsl"\n'}, "stands after it"),
                ({"host/gpu/e.h": '#include "host/gpu/f.h"\n',
                  "host/gpu/f.h": '#include "host/gpu/e.h"\n'},
                 "host/gpu/e.h -> host/gpu/f.h -> host/gpu/e.h"),
                ({"host/loose.h": ""}, "host/loose.h: is in no room"),
                ({"host/attic/e.h": ""}, "host/attic/e.h: is in no room"),
                ({"shaders/math/a.h": '#include "host/base/c.h"\n'}, "a floor above"),
                ({"host/gpu/d.cpp": '#include "host/base/gone.h"\n'}, "which is not there")]:
            with self.subTest(named):
                self.assertIn(named, self.breach(changes))


if __name__ == "__main__":
    if sys.argv[1:] == ["--table"]:
        print_table(ROOT)
    elif len(sys.argv) == 2 and Path(sys.argv[1]).is_dir():
        found = breaches(Path(sys.argv[1]))
        print("\n".join(found))
        sys.exit(1 if found else 0)
    else:
        unittest.main()
