#!/usr/bin/env python3
"""tools/kernels/embed_shaders.py on shaders that keep its convention and on shaders that break it.

A kernel that breaks it must stop the build with a message that names the shader and the block.
"""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools/kernels"
EMBED = TOOLS / "embed_shaders.py"
ORDER = TOOLS / "float_order.py"
LAYOUT = TOOLS / "explicit_layout.py"
sys.path.insert(0, str(TOOLS))

import by_address  # noqa: E402: found only now
import explicit_layout  # noqa: E402
import spirv_module  # noqa: E402

HEAD = """#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types : require
layout(local_size_x = 64) in;
struct Item { float a; uint b; };
"""
KEYS = "layout(scalar, set = 0, binding = 0) buffer KeysBlock { uint keys[]; };"
FLOATS = """#extension GL_KHR_shader_subgroup_arithmetic : require
layout(scalar, set = 0, binding = 0) buffer XBlock { float x[]; };
layout(scalar, set = 0, binding = 1) buffer VBlock { vec3 v[]; };
"""
MAIN = "void main() { %s }"

# The broken shaders: (declarations, main's body, the message's text).
BROKEN = {
    "two members": (
        "layout(scalar, set = 0, binding = 0) buffer TwoBlock { uint n; uint keys[]; };", "",
        "block TwoBlock: has 2 members (n, keys)"),
    "another set": (
        "layout(scalar, set = 1, binding = 0) buffer SetBlock { uint keys[]; };", "",
        "block SetBlock: is in set 1"),
    "a gap": (
        KEYS + "layout(scalar, set = 0, binding = 2) buffer GapBlock { uint far[]; };", "",
        "block GapBlock: far has binding 2 where 1 is next"),
    "one binding twice": (
        KEYS + "layout(scalar, set = 0, binding = 0) buffer AgainBlock { uint again[]; };", "",
        "block AgainBlock: again has binding 0 where 1 is next"),
    "one name twice": (
        KEYS + "layout(scalar, set = 0, binding = 1) buffer SameBlock { uint keys[]; } same;", "",
        "blocks share a member name"),
    "no buffers": ("", "", "has no buffers"),
    "std430 struct": (
        "struct Pad { float a; vec3 b; };"
        "layout(std430, set = 0, binding = 0) buffer PadBlock { Pad pads[]; };", "",
        "block PadBlock: gpu::Pad.b stands at 16, scalar layout has 4"),
    "std430 array": (
        "layout(std430, set = 0, binding = 0) buffer WideBlock { vec3 wide[]; };", "",
        "block WideBlock: array stride 16 of gpu::vec3, scalar layout has 12"),
    "a uniform block": (
        KEYS + "layout(scalar, set = 0, binding = 1) uniform UboBlock { Item item; };", "",
        "block UboBlock: is no storage buffer"),
    "an image": (
        KEYS + "layout(set = 0, binding = 1, r32ui) uniform uimage2D picture;", "",
        "block picture: is no storage buffer"),
    "an array of blocks": (
        "layout(scalar, set = 0, binding = 0) buffer ManyBlock { uint keys[]; } many[2];", "",
        "block many: an array of blocks"),
    "a matrix": (
        "struct Turn { mat3 m; };"
        "layout(scalar, set = 0, binding = 0) buffer TurnBlock { Turn turns[]; };", "",
        "block TurnBlock: gpu::Turn.m: a type (SPIR-V opcode 24)"),
    "a half": (
        "struct Half { float16_t h; };"
        "layout(scalar, set = 0, binding = 0) buffer HalfBlock { Half halves[]; };", "",
        "block HalfBlock: gpu::Half.h: a 16-bit scalar"),
    "a bool": (
        "struct Flag { uint n; bool on; };"
        "layout(scalar, set = 0, binding = 0) buffer FlagBlock { Flag flags[]; };",
        "Flag f = flags[0]; f.n = 1; flags[1] = f;",
        "block FlagBlock: gpu::Flag has a bool"),
    "an extent that is a specialisation constant": (
        "layout(constant_id = 1) const uint kExtent = 4; struct Row { uint cells[kExtent]; };"
        "layout(scalar, set = 0, binding = 0) buffer RowBlock { Row rows[]; };", "",
        "block RowBlock: gpu::Row.cells: an array whose extent is a specialisation constant"),
    "132 bytes of push constants": (
        KEYS + "struct Large { uint words[33]; };"
        "layout(scalar, push_constant) uniform LargeBlock { Large push; };", "",
        "block LargeBlock: has 132 bytes of push constants, over 128"),
    "push constants that are no struct": (
        KEYS + "layout(scalar, push_constant) uniform BareBlock { uint push; };", "",
        "block BareBlock: holds uint32_t; push one struct"),
    "push constants of two members": (
        KEYS + "layout(scalar, push_constant) uniform PairBlock { Item push; uint more; };", "",
        "block PairBlock: has 2 members (push, more)"),
}


# Bindings that become addresses, in a kernel that reads an element's part, and one as a whole.
LARGE = """struct Node { vec3 low; uint child; };
layout(scalar, set = 0, binding = 0) readonly buffer NodesBlock { Node nodes[]; };
layout(scalar, set = 0, binding = 1) buffer KeysBlock { uint keys[]; };
layout(scalar, set = 0, binding = 2) coherent buffer FacesBlock { uint faces[]; };
"""


def words_in(array):
    return [int(word, 16) for word in re.findall("0x[0-9a-f]{8}", array.split("}")[0])]


def loop_controls(words):
    """The loop control of each of the module's loops."""
    return [words[at + 3] for at, op in spirv_module.instructions(words)
            if op == spirv_module.OP_LOOP_MERGE]


class EmbedShaders(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.dir = Path(self.folder.name)

    def embed(self, declarations, body="", head=HEAD, flags=(), variants=(), order=False):
        """Compiles, decorates if `order`, and embeds try_it.comp: embed_shaders.py's result."""
        source, spv = self.dir / "try_it.comp", self.dir / "try_it.spv"
        source.write_text(head + declarations + MAIN % body)
        glslang = ["glslangValidator", "--quiet", "--target-env", "vulkan1.2", *flags]
        compiled = subprocess.run([*glslang, "-o", spv, source], capture_output=True, text=True)
        self.assertEqual(compiled.returncode, 0, compiled.stdout)
        if order:
            subprocess.run([sys.executable, "-B", ORDER, spv], check=True)
        command = [sys.executable, "-B", EMBED, "kernel", spv, self.dir, *variants]
        return subprocess.run(command, capture_output=True, text=True)

    def header(self, *args, **kwargs):
        result = self.embed(*args, **kwargs)
        self.assertEqual(result.returncode, 0, result.stderr)
        return (self.dir / "try_it.h").read_text()

    def test_every_breach_names_shader_and_block(self):
        for what, (declarations, body, message) in BROKEN.items():
            with self.subTest(what):
                result = self.embed(declarations, body)
                self.assertNotEqual(result.returncode, 0)
                self.assertIn(f"try_it.comp: {message}", result.stderr)
                self.assertFalse((self.dir / "try_it.h").exists())

    def test_stripped_names_are_an_error(self):
        result = self.embed(KEYS, flags=["-g0"])
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("stripped", result.stderr)

    def test_argument_types(self):
        kinds = {
            "Item items[]": "gpu::Item> items",
            "Item one": "gpu::Item> one",
            "uint keys[]": "uint32_t> keys",
            "int signs[16]": "int32_t> signs",
            "float heights[]": "float> heights",
            "double exact[]": "double> exact",
            "uint64_t codes[]": "uint64_t> codes",
            "uint16_t indices[]": "uint16_t> indices",
            "vec3 points[]": "gpu::vec3> points",
            "uvec4 corners[]": "gpu::uvec4> corners",
        }
        for declared, expected in kinds.items():
            with self.subTest(declared):
                block = "layout(scalar, set = 0, binding = 0) buffer Block { %s; };" % declared
                self.assertIn(f"Argument<{expected};", self.header(block))

    def test_read_only_and_binding_order(self):
        header = self.header(
            "layout(scalar, set = 0, binding = 1) readonly buffer BBlock { uint b[]; };"
            "layout(scalar, set = 0, binding = 0) writeonly buffer ABlock { uint a[]; };")
        self.assertIn('{0, "a", false},\n      {1, "b", true},', header)
        self.assertLess(header.index("> a;"), header.index("> b;"))

    def test_struct_layout(self):
        header = self.header(
            "struct Inner { vec3 p; uint n; };"
            "struct Outer {"
            "  uint first; Inner inner[2]; double exact; float grid[2][3]; uint8_t tail; };"
            "layout(scalar, set = 0, binding = 0) buffer Block { Outer outer; };")
        for name, offset, kind in [("first", 0, "uint32_t"), ("inner", 4, "gpu::Inner[2]"),
                                   ("exact", 40, "double"), ("grid", 48, "float[2][3]"),
                                   ("tail", 72, "uint8_t")]:
            self.assertIn(f"offsetof(gpu::Outer, {name}) == {offset},", header)
            self.assertIn(f"std::is_same_v<decltype(gpu::Outer::{name}), {kind}>", header)
        self.assertIn("sizeof(gpu::Outer) == 80,", header)  # rounded up to the double's alignment
        self.assertIn("sizeof(gpu::Inner) == 16,", header)

    def test_local_size(self):
        specialised = HEAD.replace("(local_size_x = 64)", "(local_size_x_id = 3, local_size_y = 2)")
        self.assertIn("kLocalSize[3] = {64, 1, 1}", self.header(KEYS))
        self.assertIn("kLocalSize[3] = {1, 2, 1}", self.header(KEYS, head=specialised))

    def test_push(self):
        push = "layout(scalar, push_constant) uniform PushBlock { Item push; };"
        self.assertIn("using Push = NoPush;", self.header(KEYS))
        self.assertIn("using Push = gpu::Item;", self.header(KEYS + push))

    def test_large_buffers_are_given_by_address(self):
        """The edits make a valid module of the words, which binds the other buffers alone."""
        push = "layout(scalar, push_constant) uniform PushBlock { Item push; };"
        for declarations, body in [(LARGE, "faces[2] = nodes[keys[0]].child;"), (LARGE, ""),
                                   (LARGE + push, "faces[int(keys[0])] = push.b; keys[1] = nodes[7].child;")]:
            with self.subTest(body):
                self.assertIn("kByAddress = 0x5;", self.header(declarations, body))
                source = (self.dir / "try_it.cpp").read_text()
                words, edits = (words_in(source.split(f"k{name}[] = {{")[1]) for name in ("Words", "Edits"))
                given = self.dir / "by_address.spv"
                spirv_module.write_words(given, by_address.applied(words, edits))
                subprocess.run(["spirv-val", "--target-env", "vulkan1.2", "--scalar-block-layout", given], check=True)
                bound = [d[spirv_module.BINDING] for d in spirv_module.Module(spirv_module.read_words(given)).decorations.values()
                         if spirv_module.BINDING in d]
                self.assertEqual(bound, [1])

    def test_a_kernel_of_no_large_buffer_has_no_edits(self):
        self.assertIn("kByAddress = 0x0;", self.header(KEYS, "keys[0] = 1;"))
        self.assertIn("edits() { return {}; }", (self.dir / "try_it.cpp").read_text())

    def test_addresses_that_do_not_fit_the_push_constants_stop_the_build(self):
        names = sorted(by_address.LARGE)[:9]
        many = "".join(f"layout(scalar, set = 0, binding = {i}) buffer B{i} {{ uint {name}[]; }};" for i, name in enumerate(names))
        push = ("struct Large { uint words[17]; };"
                "layout(scalar, push_constant) uniform LargeBlock { Large push; };")
        for declarations, message in [(many, "has 9 large buffers, over 8"),
                                      (LARGE + push, "has 68 bytes of push constants, over 64, before addresses")]:
            with self.subTest(message):
                result = self.embed(declarations)
                self.assertNotEqual(result.returncode, 0)
                self.assertIn(f"try_it.comp: {message}", result.stderr)

    def test_edits_say_what_was_kept_left_out_and_put(self):
        edits = by_address.Edits()
        edits.keep(2)
        edits.replace(1, [70, 71])
        edits.keep(1)
        edits.keep(1)
        edits.replace(0, [72])
        self.assertEqual(edits.words(), (2, 1, 2, 70, 71, 2, 0, 1, 72))
        self.assertEqual(by_address.applied(range(8), edits.words()), (0, 1, 70, 71, 3, 4, 72, 5, 6, 7))

    def test_cpu_devices_leave_loops_as_they_are(self):
        """The module marks each loop so, except those that the shader wants unrolled."""
        head = HEAD + "#extension GL_EXT_control_flow_attributes : require\n"
        loop = "for (uint i = 0; i < 4; ++i) keys[i] = i;"
        spv = self.dir / "try_it.spv"
        for body, controls in [("keys[0] = 1;", None), (loop, [2]),
                               ("[[unroll]] " + loop + loop, [1, 2])]:
            with self.subTest(body):
                self.header(KEYS, body, head=head, variants=(spv, spv))
                source = (self.dir / "try_it.cpp").read_text()
                given, *for_cpu = [words_in(part) for part in source.split("Words[] = {")[1:]]
                self.assertEqual(loop_controls(given), [c & 1 for c in controls or []])
                self.assertEqual([loop_controls(words) for words in for_cpu],
                                 [controls] if controls else [])

    def test_a_float_operation_that_may_be_rearranged_stops_the_build(self):
        """An operation that glslang leaves undecorated; once decorated, it passes."""
        for body, name in [("x[0] = x[1] + x[2];", "OpFAdd"), ("x[0] = x[1] - x[2];", "OpFSub"),
                           ("x[0] = x[1] * x[2];", "OpFMul"), ("x[0] = x[1] / x[2];", "OpFDiv"),
                           ("x[0] = -x[1];", "OpFNegate"),
                           ("v[0] = x[0] * v[1];", "OpVectorTimesScalar"),
                           ("v[0] = v[1] + v[2];", "OpFAdd")]:
            with self.subTest(body):
                result = self.embed(FLOATS, body)
                self.assertNotEqual(result.returncode, 0)
                self.assertRegex(result.stderr, f"{name} %[0-9]+ is not decorated NoContraction")
                self.header(FLOATS, body, order=True)

    def test_a_float_operation_of_no_fixed_order_stops_the_build(self):
        """Every operation that is a sum of products inside, or a sum over a subgroup."""
        for body in ["x[0] = dot(v[0], v[1]);", "v[0] = cross(v[1], v[2]);", "x[0] = length(v[0]);",
                     "x[0] = distance(v[0], v[1]);", "v[0] = normalize(v[1]);",
                     "x[0] = fma(x[1], x[2], x[3]);", "x[0] = mix(x[1], x[2], x[3]);",
                     "x[0] = mod(x[1], x[2]);", "x[0] = subgroupAdd(x[1]);",
                     "x[0] = exp2(x[1]);", "v[0] = mat3(v[0], v[1], v[2]) * v[3];"]:
            with self.subTest(body):
                result = self.embed(FLOATS, body, order=True)
                self.assertNotEqual(result.returncode, 0)
                self.assertIn("whose order is not fixed", result.stderr)

    def test_several_values_at_once_stop_the_build(self):
        result = self.embed(FLOATS, "int n; x[0] = frexp(x[1], n);", order=True)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("which gives several values", result.stderr)

    def test_the_doctors_header_stays_when_the_others_are_listed_again(self):
        for name in ("self_test", "of_a_shader_that_is_gone"):
            (self.dir / f"{name}.h").write_text("")
        subprocess.run([sys.executable, "-B", EMBED, "index", self.dir, "wave_plan"], check=True)
        self.assertTrue((self.dir / "self_test.h").exists())
        self.assertFalse((self.dir / "of_a_shader_that_is_gone.h").exists())

    def test_moved_and_chosen_floats_need_no_decoration(self):
        self.header(FLOATS, "uint i = gl_LocalInvocationID.x; v[0] = abs(v[1]).zyx;"
                            "x[0] = max(x[1], clamp(x[2], x[3], 1.0)); x[1] = sqrt(x[2]);"
                            "x[3] = uintBitsToFloat(7u); x[4] = float(i);"
                            "x[5] = mix(x[6], x[7], i > 3u); x[6] = subgroupMax(x[7]);")

    def test_every_variant_that_is_embedded_is_looked_at(self):
        body, spv = "x[0] = x[1] + x[2];", self.dir / "try_it.spv"
        self.embed(FLOATS, body)
        loose = self.dir / "loose.spv"
        loose.write_bytes(spv.read_bytes())
        for variants in [(loose, spv), (spv, loose)]:
            with self.subTest(variants):
                result = self.embed(FLOATS, body, variants=variants, order=True)
                self.assertIn("OpFAdd", result.stderr)

    def test_explicit_layout_is_for_buffers_alone(self):
        # glslang 12 gives `own` the buffer's type, with its stride; later ones do not.
        declarations = ("layout(scalar, set = 0, binding = 0) buffer Block { uint theirs[16]; };"
                        "uint own[16]; shared uint shared_own[16];")
        result = self.embed(declarations, "uint i = theirs[0]; own[i] = 1u; shared_own[i] = own[i + 1u];"
                                          "theirs[0] = own[i + 2u] + shared_own[i + 3u];")
        spv = self.dir / "try_it.spv"
        words = spirv_module.read_words(spv)
        if explicit_layout.breach(words) is None:
            self.skipTest("this glslang keeps them apart")
        self.assertIn("is no buffer", result.stderr)
        self.assertNotEqual(result.returncode, 0)
        subprocess.run([sys.executable, "-B", LAYOUT, spv], check=True)
        self.assertIsNone(explicit_layout.breach(spirv_module.read_words(spv)))
        subprocess.run(["spirv-val", "--target-env", "vulkan1.2", "--scalar-block-layout", spv], check=True)

    def test_an_equal_header_keeps_its_time(self):
        self.header(KEYS, "keys[0] = 1;")
        before = (self.dir / "try_it.h").stat().st_mtime_ns
        source = (self.dir / "try_it.cpp").read_text()
        self.header(KEYS, "keys[0] = 2;")
        self.assertEqual((self.dir / "try_it.h").stat().st_mtime_ns, before)
        self.assertNotEqual((self.dir / "try_it.cpp").read_text(), source)


if __name__ == "__main__":
    unittest.main()
