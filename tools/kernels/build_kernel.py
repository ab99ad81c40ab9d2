#!/usr/bin/env python3
"""Builds one kernel: GLSL in, checked SPIR-V as C++ out, all passes in this process.

  build_kernel.py SHADER OUT_DIR --root DIR --glslang G --spirv-val V [--spirv-opt O]

It writes OUT_DIR/NAME.h and NAME.cpp (embed_shaders.py), NAME.spv, and NAME.d, a depfile of NAME.cpp.
glslang compiles; every float operation is decorated (float_order.py) and every layout that is not a
buffer's removed (explicit_layout.py). With --spirv-opt a kernel is embedded flattened, and a second
time for devices that are not wide. Each has edits that give large buffers by address
(by_address.py). spirv-val accepts each module that is embedded, and what its edits make of it.
"""

import argparse
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import embed_shaders
import explicit_layout
import float_order
import spirv_module as spirv

# This omits -g0: reflection reads the debug names in the compiler's output, since the optimiser
# drops buffers that are not used.
TARGET = ("--target-env", "vulkan1.2")
LAYOUT = "--scalar-block-layout"

# lavapipe inlines and brings to SSA form at every start of a program, which takes longer than
# reading code already in that form (docs/log/startup.md). Nothing here may touch floating point: no
# -O, no --simplify-instructions, which reassociate everything that is not `precise`. That is left
# to the drivers, whose rounding is specified.
FLATTEN = """
  --merge-return --inline-entry-points-exhaustive --eliminate-dead-functions
  --private-to-local --eliminate-local-single-block --eliminate-local-single-store
  --eliminate-dead-code-aggressive --scalar-replacement=0 --convert-local-access-chains
  --eliminate-local-single-block --eliminate-local-single-store --eliminate-dead-code-aggressive
  --ssa-rewrite --eliminate-dead-code-aggressive --ccp --eliminate-dead-branches
  --redundancy-elimination --eliminate-dead-branches --vector-dce --eliminate-dead-inserts
  --eliminate-dead-code-aggressive --merge-blocks --compact-ids""".split()
# lavapipe also keeps the GPU profile's code until most of its passes are done, and unrolls loops at
# a third of its time for nothing that runs faster. So every kernel is built a second time, for the
# CPU profile, and its loops are marked to be left as they are.
PRUNE = ["--ccp", "--eliminate-dead-branches", "--eliminate-dead-functions"]


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}:\n{done.stdout}{done.stderr}")


class Builder:
    """The tools, and a folder for their intermediate files."""

    def __init__(self, options, folder):
        self.options = options
        self.folder = Path(folder)

    def compiled(self, spv):
        o = self.options
        depfile = spv.with_suffix(".d")
        run(o.glslang, "--quiet", *TARGET, f"-I{o.root}", "--depfile", depfile, "-o", spv, o.shader)
        # glslang names the module; the build waits for the source made of it.
        depfile.write_text(depfile.read_text().replace(f"{spv}:", f"{spv.with_suffix('.cpp')}:", 1))
        words = explicit_layout.without_layout(float_order.decorated(spirv.read_words(spv)))
        spirv.write_words(spv, words)
        self.validate(spv)
        return words

    def validate(self, spv):
        run(self.options.spirv_val, *TARGET, LAYOUT, spv)

    def validate_words(self, words):
        spv = self.folder / "words.spv"
        spirv.write_words(spv, words)
        self.validate(spv)

    def optimised(self, words, name, passes):
        before, after = self.folder / f"{name}.in.spv", self.folder / f"{name}.spv"
        spirv.write_words(before, words)
        run(self.options.spirv_opt, "--target-env=vulkan1.2", LAYOUT, *passes, "-o", after, before)
        self.validate(after)
        return spirv.read_words(after)

    def variants(self, words):
        """The words for the GPU profile and for the CPU profile."""
        if not self.options.spirv_opt:
            return words, words
        narrow = spirv.with_constant_false(words, embed_shaders.WIDE)
        with ThreadPoolExecutor(2) as pool:
            flat = pool.submit(self.optimised, words, "flat", FLATTEN)
            cpu = self.optimised(narrow, "cpu", PRUNE + FLATTEN)
            return flat.result(), spirv.with_loops_kept(cpu)


def build(options):
    spv = options.out / f"{options.shader.stem}.spv"
    with tempfile.TemporaryDirectory() as folder:
        builder = Builder(options, folder)
        words = builder.compiled(spv)
        embed_shaders.embed(spv.stem, options.out, words, builder.variants(words), builder.validate_words)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("shader", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--root", type=Path, required=True, help="where includes are looked for")
    parser.add_argument("--glslang", required=True)
    parser.add_argument("--spirv-val", required=True)
    parser.add_argument("--spirv-opt")
    build(parser.parse_args())


if __name__ == "__main__":
    main()
