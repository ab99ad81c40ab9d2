"""Each room of host/, with the rooms before it and the engine, links whole and alone: no call goes up.

usage: links_test.py ROOMS COMPILER LIBRARY...

ROOMS: a line for each room in their order, its name and its objects between semicolons. Includes
alone do not show it, for a function may be declared in one room and defined in a later one.
"""

import pathlib
import re
import subprocess
import sys
import tempfile


def undefined(compiler: str, objects: list[str], libraries: list[str]) -> list[str]:
    """Names what no object defines; empty if they link."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([compiler, "-shared", "-Wl,-z,defs", "-Wl,--demangle", "-o", f"{folder}/rooms.so", *objects, *libraries],
                              capture_output=True, text=True)
    if done.returncode == 0:
        return []
    found = sorted(set(re.findall(r"undefined reference to [`']([^'\n]*)'", done.stderr)))
    return found or [done.stderr]


def main() -> int:
    rooms_file, compiler, *libraries = sys.argv[1:]
    rooms = [line.split(";") for line in pathlib.Path(rooms_file).read_text().splitlines()]
    wrong = 0
    objects: list[str] = []
    for name, *own in rooms:
        if not own:
            print(f"links_test: no objects of {name}")
            return 1
        objects += own
        for symbol in undefined(compiler, objects, libraries):
            print(f"{name}: calls what no room before it defines: {symbol}")
            wrong += 1
    name, *own = rooms[2]
    if not undefined(compiler, own, libraries):
        print(f"links_test: {name} links without the rooms before it, so that this test notices nothing")
        wrong += 1
    print(f"links_test: {len(rooms)} rooms, {wrong} calls upwards")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
