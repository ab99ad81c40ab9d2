#!/usr/bin/env python3
"""Where the kernels divide floats and take roots: only math/certified.h may, for devices round both as they like.

  float_places.py [ROOT]    prints 'file:line: what' for each breach, and exits 1 if there is any

Elsewhere a line needs '// uncertified: why' on it or in the comment right above it. The compiled SPIR-V tells
a float's division from an integer's, and its debug lines say where it was written.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import float_order
import spirv_module as spirv

CERTIFIED = "shaders/math/certified.h"
OP_STRING, OP_LINE, OP_NO_LINE, OP_F_DIV = 7, 8, 317, 136
# Instructions of GLSL.std.450.
ROOTS = {31: "Sqrt", 32: "InverseSqrt", 66: "Length", 67: "Distance", 69: "Normalize"}
EXCUSE = re.compile(r"// *uncertified: *\S")


def places(words):
    """(file, line, what) of each float division and root of a module with debug lines."""
    files, here = {}, None
    for at, op in spirv.instructions(words):
        if op == OP_STRING:
            files[words[at + 1]] = spirv.literal_string(words[at + 2:at + (words[at] >> 16)])
        elif op == OP_LINE:
            here = (files[words[at + 1]].removeprefix("./"), words[at + 2])
        elif op == OP_NO_LINE:
            here = None
        elif op == OP_F_DIV:
            yield (*(here or ("?", 0)), "a division")
        elif op == float_order.OP_EXT_INST and words[at + 4] in ROOTS:
            yield (*(here or ("?", 0)), f"a root ({ROOTS[words[at + 4]]})")


def is_excused(lines, number):
    """Whether line `number`, of an expression that may have begun above it, gives the reason."""
    at = number - 1
    if EXCUSE.search(lines[at]):
        return True
    while at > 0 and lines[at - 1].lstrip().startswith("//"):
        at -= 1
        if EXCUSE.search(lines[at]):
            return True
    return False


def places_of(root, shader):
    with tempfile.TemporaryDirectory() as folder:
        spv = Path(folder) / "a.spv"
        done = subprocess.run(["glslangValidator", "--quiet", "--target-env", "vulkan1.2", "-I.", "-g", "-o", spv,
                               shader.relative_to(root)], cwd=root, capture_output=True, text=True, timeout=120)
        if done.returncode != 0:
            sys.exit(f"float_places: {shader} does not compile:\n{done.stdout}")
        return set(places(spirv.read_words(spv)))


def breaches(root):
    with ThreadPoolExecutor() as pool:
        found = set().union(*pool.map(lambda s: places_of(root, s), sorted((root / "shaders").glob("*/*.comp"))))
    for file, line, what in sorted(found):
        if file == CERTIFIED:
            continue
        path = root / file
        if not path.is_file():
            yield f"{file}:{line}: {what}, which no file has"
        elif not is_excused(path.read_text().splitlines(), line):
            yield f"{file}:{line}: {what} outside {CERTIFIED}"


def main(args):
    if len(args) > 1:
        sys.exit(__doc__)
    if shutil.which("glslangValidator") is None:
        sys.exit("float_places: no glslangValidator here")
    root = Path(args[0] if args else Path(__file__).parents[2]).resolve()
    found = list(breaches(root))
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main(sys.argv[1:])
