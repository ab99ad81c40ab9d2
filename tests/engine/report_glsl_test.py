#!/usr/bin/env python3
"""engine/vkhausdorff_report.glsl has VkhReport as the C header has it: every member, at its offset, in both layouts.

usage: report_glsl_test.py CC INCLUDE...
"""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/kernels"))
import spirv_module as spirv  # noqa: E402

KERNEL = """#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "engine/vkhausdorff_report.glsl"
layout(local_size_x = 1) in;
layout(%s, binding = 0) buffer Block { VkhReport report; VkhStatistics statistics; };
void main() {
  report.waves = statistics.waveRecords[1].queries;
  if (report.status == VKH_STATUS_MEMORY) report.upper = report.lower; }
"""
STRUCTS = ("VkhReport", "VkhStatistics", "VkhWaveRecord")


def glsl_offsets(layout, text):
    with tempfile.TemporaryDirectory() as folder:
        kernel, spv = Path(folder) / "a.comp", Path(folder) / "a.spv"
        (Path(folder) / "engine").mkdir()
        (Path(folder) / "engine/vkhausdorff_report.glsl").write_text(text)
        kernel.write_text(KERNEL % layout)
        subprocess.run(["glslangValidator", "--quiet", "--target-env", "vulkan1.2", f"-I{folder}", "-o", spv, kernel],
                       check=True, timeout=60)
        module = spirv.Module(spirv.read_words(spv))
    # glslang has a struct of each name that functions use, too, without offsets.
    return {(module.names[i], name): module.offset(i, index)
            for i, members in module.member_names.items() if module.names.get(i) in STRUCTS
            for index, name in members.items() if module.offset(i, index) is not None}


def c_offsets(names):
    lines = "".join(f'  printf("{s} {m} %zu\\n", offsetof({s}, {m}));\n' for s, m in names)
    source = f"#include <stddef.h>\n#include <stdio.h>\n#include \"engine/vkhausdorff.h\"\nint main(void) {{\n{lines}}}\n"
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "a"
        subprocess.run([*COMPILER, f"-I{ROOT}", "-x", "c", "-", "-o", program], input=source, text=True, check=True,
                       timeout=60)
        out = subprocess.run([program], capture_output=True, text=True, check=True, timeout=60).stdout
    return {(s, m): int(n) for s, m, n in (line.split() for line in out.splitlines())}


def members_of_header():
    text = re.sub(r"/\*.*?\*/", "", (ROOT / "engine/vkhausdorff.h").read_text(), flags=re.S)
    for struct in STRUCTS:
        body = re.search(r"typedef struct %s \{(.*?)\}" % struct, text, re.S).group(1)
        for declaration in filter(str.strip, body.split(";")):
            for name in declaration.strip().split(" ", 1)[1].split(","):
                yield struct, re.sub(r"\[.*", "", name).strip()


class ReportGlsl(unittest.TestCase):
    TEXT = (ROOT / "engine/vkhausdorff_report.glsl").read_text()

    def test_every_member_has_its_offset(self):
        expected = c_offsets(list(members_of_header()))
        self.assertGreater(len(expected), 20)
        for layout in ("scalar", "std430"):
            with self.subTest(layout):
                self.assertEqual(glsl_offsets(layout, self.TEXT), expected)

    def test_the_constants_are_the_header_s(self):
        header = (ROOT / "engine/vkhausdorff.h").read_text()
        for name, value in re.findall(r"#define (VKH_\w+) (\d+)u?$", self.TEXT, re.M):
            self.assertRegex(header, rf"\b{name} = {value}\b")

    def test_another_order_is_noticed(self):
        other = self.TEXT.replace("  float lower;\n  float upper;\n", "  float upper;\n  float lower;\n")
        self.assertNotEqual(glsl_offsets("scalar", other), c_offsets(list(members_of_header())))


if __name__ == "__main__":
    COMPILER = sys.argv[1:]
    unittest.main(argv=sys.argv[:1])
