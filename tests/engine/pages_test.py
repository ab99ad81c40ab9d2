#!/usr/bin/env python3
"""Every .glsl file includes all that it needs, except for the buffers that its kernel declares; and
kernels declare a buffer in one way: one name, one block, one type, as structs or in the whole words
that traversals read.
"""

import re
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUFFER = re.compile(r"^layout\(scalar, binding = (\d+)\)([a-z ]*) buffer (\w+) \{ (\w+) (\w+)(\[\])?; \};$", re.M)
BESIDE = re.compile(r"^layout\([^)]*\b(binding|push_constant)\b.*$", re.M)
WORDS = {"uvec4", "vec2"}  # whole loads of a struct
DECLARES = re.compile(r"The kernel declares (.*)$", re.S)
# The files of which a kernel includes one or the other.
HOOKS = ["wave/centroid.glsl", "wave/unsorted.glsl"]
# Kernels of the doctor, which is no part of a run.
APART = {"self_test.comp"}


def kernels(root):
    return [p for p in sorted((root / "shaders").glob("*/*.comp")) if p.name not in APART]


def head_of(page):
    lines = []
    for line in page.read_text().splitlines():
        if not line.startswith("//"):
            break
        lines.append(line[2:].strip())
    return " ".join(lines)


def buffers_of(root):
    """name -> (block, {types}, is an array), and the declarations of another form."""
    found, others = {}, []
    for kernel in kernels(root):
        text = kernel.read_text()
        named = [m.group(5) for m in BUFFER.finditer(text)]
        push = len(re.findall(r"^layout\(scalar, push_constant\) uniform PushBlock \{ \w+ push; \};$", text, re.M))
        if len(named) + push != len(BESIDE.findall(text)):
            others.append(f"{kernel.name}: a buffer or push constant is declared in another way")
        for _, _, block, kind, name, array in BUFFER.findall(text):
            known = found.setdefault(name, (block, set(), array))
            known[1].add(kind)
            if (known[0], known[2]) != (block, array):
                others.append(f"{kernel.name}: {name} is {block} {array}, elsewhere {known[0]} {known[2]}")
    for name, (_, kinds, _) in found.items():
        if len(kinds - WORDS) > 1 or len(kinds) > 2:
            others.append(f"{name} is declared as {', '.join(sorted(kinds))}")
    return found, others


def needs(root, page, seen=()):
    """The text behind 'The kernel declares', with that of the files that it names."""
    match = DECLARES.search(head_of(page))
    text = match.group(1) if match else ""
    for name in re.findall(r"(\w+/\w+\.glsl)", text):
        if name not in seen:
            text += " " + needs(root, root / "shaders" / name, (*seen, name))
    return text


def kernel_around(root, page, found):
    text = needs(root, page)
    push = re.search(r"`push` \((\w+)\)", text)
    lines = ["#version 460", "#extension GL_EXT_scalar_block_layout : require",
             "#extension GL_GOOGLE_include_directive : require", '#include "shaders/base/switches.glsl"',
             "layout(local_size_x = 64) in;"]
    for number, (name, (block, kinds, array)) in enumerate(sorted(found.items())):
        words = "uvec4" in kinds and f"`{name}` (" not in text
        kind = "uvec4" if words else min(kinds - WORDS, default="uvec4")
        lines.append(f"layout(scalar, binding = {number}) buffer {block} {{ {kind} {name}{array}; }};")
    lines.append("layout(scalar, push_constant) uniform PushBlock { %s push; };" % (push.group(1) if push else "CountPush"))
    if "`plan_words`" in text:
        lines.append("shared uint plan_words[1024];")
    if "kKnowers" in text and page.name == "known.glsl":
        lines.append("const uint kKnowers = kGroupSize;")
    own = page.relative_to(root / "shaders").as_posix()
    lines += [f'#include "shaders/{hook}"' for hook in HOOKS if hook in text and hook != own]
    return "\n".join([*lines, f'#include "shaders/{own}"', "void main() {}", ""])


def complaint(root, page, found):
    """The compiler's message on a kernel that includes only this file; '' if there is none."""
    with tempfile.TemporaryDirectory() as folder:
        kernel = Path(folder) / "around.comp"
        kernel.write_text(kernel_around(root, page, found))
        done = subprocess.run(["glslangValidator", "--quiet", "--target-env", "vulkan1.2", f"-I{root}",
                               "-o", Path(folder) / "a.spv", kernel], capture_output=True, text=True, timeout=120)
    first = next((line for line in done.stdout.splitlines() if "ERROR" in line), "")
    return f"{page.relative_to(root)}: {first}" if done.returncode else ""


def complaints(root):
    found, others = buffers_of(root)
    pages = sorted((root / "shaders").glob("*/*.glsl"))
    with ThreadPoolExecutor() as pool:
        return [*others, *filter(None, pool.map(lambda page: complaint(root, page, found), pages))]


class Pages(unittest.TestCase):
    def test_the_house(self):
        self.assertGreater(len(buffers_of(ROOT)[0]), 20)
        self.assertEqual(complaints(ROOT), [])

    def said(self, page, kernel="layout(scalar, binding = 0) buffer Heights { float heights[]; };"):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for room in ("base", "traversal"):
                (root / "shaders" / room).mkdir(parents=True)
            (root / "shaders/base/switches.glsl").write_text("#ifndef S\n#define S\nstruct CountPush { uint count; };\n#endif\n")
            (root / "shaders/base/half.glsl").write_text("float half_of(float a) { return 0.5 * a; }\n")
            (root / "shaders/traversal/a.comp").write_text(kernel)
            (root / "shaders/traversal/b.comp").write_text("layout(scalar, binding = 0) buffer Heights { float heights[]; };")
            (root / "shaders/traversal/page.glsl").write_text(page)
            return "\n".join(complaints(root))

    def test_what_breaks_it_is_named(self):
        page = '#include "shaders/base/half.glsl"\nfloat f() { return half_of(heights[0]); }\n'
        self.assertEqual(self.said(page), "")
        self.assertIn("page.glsl", self.said(page.replace("#include", "//")))
        for kernel, named in [("layout(scalar, binding = 0) buffer Other { float heights[]; };", "elsewhere Other"),
                              ("layout(scalar, binding = 0) buffer Heights { uint heights[]; };", "declared as float, uint"),
                              ("layout(std430, binding = 0) buffer Heights { float heights[]; };", "in another way")]:
            with self.subTest(named):
                self.assertIn(named, self.said(page, kernel))


if __name__ == "__main__":
    unittest.main()
