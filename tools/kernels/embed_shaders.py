#!/usr/bin/env python3
"""SPIR-V in, C++ out: one header and one source per kernel, checked against shaders/gpu_types.h.

  embed_shaders.py kernel SPV OUT_DIR [FLAT CPU]
                                           OUT_DIR/NAME.h (only when it changes) and NAME.cpp;
                                           SPV tells of the buffers, and FLAT is embedded where it
                                           is given, and CPU too, its loops kept, if that differs
  embed_shaders.py index OUT_DIR NAME...   OUT_DIR/all_kernels.h and .cpp, and no other kernel's

The convention that a shader keeps: descriptor set 0, bindings 0, 1, 2, ... without a gap, storage
buffers only, one member a block, and that member's name is the argument's name in C++. Push
constants are one struct in a block of their own, 128 bytes at most. Everything is layout(scalar).
Float operations have one order, which no driver may change (float_order.py). Nothing but buffers has
an explicit layout (explicit_layout.py). Large buffers may also be given by address: the words of both
are embedded with the edits that make such a kernel of them (by_address.py).
"""

import struct
import sys
import zlib
from dataclasses import dataclass
from pathlib import Path

import by_address
import explicit_layout
import float_order
import shared_memory
import spirv_module as spirv
from kernel_templates import HEADER, SOURCE

MAX_PUSH_BYTES = 128  # guaranteed by every Vulkan device


class ContractError(Exception):
    """A shader breaks the convention at the top of this file."""


@dataclass
class Layout:
    """The C++ type of a block's type: `base` and the extents of an array (0: a runtime array)."""

    base: str
    size: int
    align: int
    extents: tuple = ()
    is_struct: bool = False

    def spelled(self):
        return self.base + "".join(f"[{n}]" for n in self.extents)


def round_up(value, multiple):
    return (value + multiple - 1) // multiple * multiple


class Layouts:
    """Traverses the types of the blocks and collects the shared structs, the inner ones first."""

    SCALARS = {
        (spirv.OP_TYPE_FLOAT, 32): "float",
        (spirv.OP_TYPE_FLOAT, 64): "double",
        (spirv.OP_TYPE_INT, 32, 0): "uint32_t",
        (spirv.OP_TYPE_INT, 32, 1): "int32_t",
        (spirv.OP_TYPE_INT, 64, 0): "uint64_t",
        (spirv.OP_TYPE_INT, 64, 1): "int64_t",
        (spirv.OP_TYPE_INT, 16, 0): "uint16_t",
        (spirv.OP_TYPE_INT, 16, 1): "int16_t",
        (spirv.OP_TYPE_INT, 8, 0): "uint8_t",
        (spirv.OP_TYPE_INT, 8, 1): "int8_t",
    }
    VECTORS = {"float": "vec", "double": "dvec", "uint32_t": "uvec", "int32_t": "ivec"}

    def __init__(self, module):
        self.module = module
        self.structs = {}  # C++ name -> (Layout, [(member name, offset, Layout)])
        self.vectors = {}  # C++ name -> Layout

    def of(self, type_id):
        op, args = self.module.types[type_id]
        if op in (spirv.OP_TYPE_INT, spirv.OP_TYPE_FLOAT):
            return self._scalar(op, args)
        if op == spirv.OP_TYPE_VECTOR:
            return self._vector(args)
        if op in (spirv.OP_TYPE_ARRAY, spirv.OP_TYPE_RUNTIME_ARRAY):
            return self._array(op, type_id, args)
        if op == spirv.OP_TYPE_STRUCT:
            return self._struct(type_id, args)
        raise ContractError(f"a type (SPIR-V opcode {op}) that C++ does not share")

    def _scalar(self, op, args):
        name = self.SCALARS.get((op, *args[:2]))
        if name is None:
            raise ContractError(f"a {args[0]}-bit scalar that C++ does not share")
        return Layout(name, args[0] // 8, args[0] // 8)

    def _vector(self, args):
        part = self.of(args[0])
        if part.base not in self.VECTORS:
            raise ContractError(f"a vector of {part.base} that C++ does not share")
        layout = Layout(f"gpu::{self.VECTORS[part.base]}{args[1]}", part.size * args[1], part.align)
        self.vectors[layout.base] = layout
        return layout

    def _array(self, op, type_id, args):
        item = self.of(args[0])
        stride = self.module.decorations[type_id].get(spirv.ARRAY_STRIDE)
        if stride != item.size:
            raise ContractError(
                f"array stride {stride} of {item.spelled()}, scalar layout has {item.size}: "
                "declare the block layout(scalar)"
            )
        extent = 0
        if op == spirv.OP_TYPE_ARRAY:
            extent, is_spec = self.module.constants.get(args[1], (0, True))
            if is_spec:
                raise ContractError("an array whose extent is a specialisation constant")
        extents = (extent, *item.extents)
        return Layout(item.base, item.size * extent, item.align, extents, item.is_struct)

    def _struct(self, type_id, members):
        name = "gpu::" + self.module.names.get(type_id, "")
        fields, end, align = [], 0, 1
        for index, member_type in enumerate(members):
            field = self.module.member_names[type_id].get(index, "")
            try:
                layout = self.of(member_type)
            except ContractError as error:
                raise ContractError(f"{name}.{field}: {error}") from None
            offset, scalar = self.module.offset(type_id, index), round_up(end, layout.align)
            if offset != scalar:
                raise ContractError(
                    f"{name}.{field} stands at {offset}, scalar layout has {scalar}: "
                    "declare the block layout(scalar)"
                )
            fields.append((field, offset, layout))
            end, align = offset + layout.size, max(align, layout.align)
        layout = Layout(name, round_up(end, align), align, is_struct=True)
        self._remember(name, layout, fields)
        return layout

    def _remember(self, name, layout, fields):
        if name == "gpu::" or not all(field for field, _, _ in fields):
            raise ContractError("a struct without names: was the SPIR-V stripped?")
        if self.structs.setdefault(name, (layout, fields))[1] != fields:
            raise ContractError(f"two different structs are called {name}")
        if self._has_bool(name.removeprefix("gpu::")):
            raise ContractError(f"{name} has a bool, whose size C++ does not promise: use uint")

    def _has_bool(self, name):
        """glslang stores a block's bool as a uint; the type that the functions use is still bool.

        If no function uses it, C++'s static_assert on the member's type finds it.
        """
        types, names = self.module.types, self.module.names
        structs = {i: args for i, (op, args) in types.items() if op == spirv.OP_TYPE_STRUCT}
        members = [m for i, args in structs.items() if names.get(i) == name for m in args]
        return any(types[m][0] == spirv.OP_TYPE_BOOL for m in members)


@dataclass
class Buffer:
    binding: int
    name: str
    read_only: bool
    item: str
    block: str


@dataclass
class Kernel:
    name: str
    local_size: list
    buffers: list
    push: str
    structs: dict
    vectors: dict
    shared_bytes: int
    by_address: int  # bindings, as bits

    @property
    def type_name(self):
        return pascal(self.name)


def pascal(name):
    return "".join(part.capitalize() for part in name.split("_"))


def block_member(module, block_id):
    """The one member of a block: its type and name."""
    op, members = module.types[block_id]
    if op != spirv.OP_TYPE_STRUCT:
        raise ContractError("an array of blocks; use one block a binding")
    if len(members) != 1:
        names = ", ".join(module.member_names[block_id].values())
        raise ContractError(f"has {len(members)} members ({names}); a block has exactly one")
    if module.offset(block_id, 0) != 0:
        raise ContractError("its member does not stand at offset 0")
    if not module.member_names[block_id].get(0):
        raise ContractError("its member has no name: was the SPIR-V stripped?")
    return members[0], module.member_names[block_id][0]


def reflect_buffer(module, layouts, variable, block_id):
    member, name = block_member(module, block_id)
    decorations = module.decorations[variable]
    if decorations.get(spirv.DESCRIPTOR_SET) != 0:
        raise ContractError(f"is in set {decorations.get(spirv.DESCRIPTOR_SET)}; use set 0")
    layout = layouts.of(member)
    if len(layout.extents) > 1:
        raise ContractError(f"{name} is an array of arrays ({layout.spelled()})")
    of_member = module.member_decorations[block_id, 0]
    read_only = spirv.NON_WRITABLE in of_member or spirv.NON_WRITABLE in decorations
    block = module.names.get(block_id, "?")
    return Buffer(decorations.get(spirv.BINDING), name, read_only, layout.base, block)


def reflect_push(module, layouts, block_id):
    layout = layouts.of(block_member(module, block_id)[0])
    if not layout.is_struct or layout.extents:
        raise ContractError(f"holds {layout.spelled()}; push one struct of gpu_types.h")
    if layout.size > MAX_PUSH_BYTES:
        raise ContractError(f"has {layout.size} bytes of push constants, over {MAX_PUSH_BYTES}")
    return layout.base


def check_buffers(buffers):
    for index, buffer in enumerate(buffers):
        if buffer.binding != index:
            raise ContractError(
                f"block {buffer.block}: {buffer.name} has binding {buffer.binding} where {index} "
                "is next; bindings count from 0 without a gap, one block each"
            )
    if not buffers:
        raise ContractError("has no buffers")
    if len({b.name for b in buffers}) != len(buffers):
        raise ContractError(f"blocks share a member name: {[b.name for b in buffers]}")


def addresses_of(buffers, push_bytes):
    """The bindings, as bits, that may become addresses."""
    bits = by_address.bindings_of((b.binding, b.name) for b in buffers)
    if bits.bit_count() > by_address.MOST:
        raise ContractError(f"has {bits.bit_count()} large buffers, over {by_address.MOST}, to be given by address")
    if bits and push_bytes > by_address.OFFSET:
        raise ContractError(f"has {push_bytes} bytes of push constants, over {by_address.OFFSET}, before addresses")
    return bits


def reflect(name, words):
    module = spirv.module_of(words)
    layouts, buffers, push = Layouts(module), [], "NoPush"
    for variable, pointer, storage in module.variables:
        if storage not in spirv.INTERFACE:
            continue
        block_id = module.types[pointer][1][1]
        try:
            if storage == spirv.STORAGE_BUFFER:
                buffers.append(reflect_buffer(module, layouts, variable, block_id))
            elif storage == spirv.PUSH_CONSTANT:
                push = reflect_push(module, layouts, block_id)
            else:
                raise ContractError("is no storage buffer; a kernel has nothing else")
        except ContractError as error:
            block = module.names.get(block_id) or module.names.get(variable, "?")
            raise ContractError(f"block {block}: {error}") from None
    buffers.sort(key=lambda b: b.binding)
    check_buffers(buffers)
    push_bytes = layouts.structs[push][0].size if push != "NoPush" else 0
    return Kernel(name, module.local_size, buffers, push, layouts.structs, layouts.vectors,
                  shared_memory.most_bytes(words), addresses_of(buffers, push_bytes))


def layout_asserts(kernel):
    """The C++ assertions on every shared struct that make the two languages agree on its bytes."""
    where = f"differs between C++ and {kernel.name}.comp"
    for name, layout in sorted(kernel.vectors.items()):
        yield f'static_assert(sizeof({name}) == {layout.size}, "{name} {where}");'
    for name, (layout, fields) in kernel.structs.items():
        for field, offset, kind in fields:
            message = f'"{name}::{field} {where}"'
            yield f"static_assert(offsetof({name}, {field}) == {offset}, {message});"
            same = f"std::is_same_v<decltype({name}::{field}), {kind.spelled()}>"
            yield f"static_assert({same}, {message});"
        yield f'static_assert(sizeof({name}) == {layout.size}, "{name} {where}");'


def binding_text(buffer):
    return f'      {{{buffer.binding}, "{buffer.name}", {str(buffer.read_only).lower()}}},'


def header_text(kernel):
    return HEADER.format(
        name=kernel.name,
        type=kernel.type_name,
        count=len(kernel.buffers),
        local_size=", ".join(str(n) for n in kernel.local_size),
        shared_bytes=kernel.shared_bytes,
        by_address=kernel.by_address,
        address_offset=by_address.OFFSET,
        most_addresses=by_address.MOST,
        args="\n".join(f"    Argument<{b.item}> {b.name};" for b in kernel.buffers),
        named="\n".join(f"        .{b.name} = from.{b.name}," for b in kernel.buffers),
        bindings="\n".join(binding_text(b) for b in kernel.buffers),
        push=kernel.push,
        descriptors="\n".join(f"        info(args.{b.name})," for b in kernel.buffers),
        asserts="\n".join(layout_asserts(kernel)),
    )


def words_text(words):
    rows = (words[i : i + 8] for i in range(0, len(words), 8))
    return "\n".join("    " + " ".join(f"{w:#010x}," for w in row) for row in rows)


def array_text(name, words):
    return f"constexpr uint32_t {name}[] = {{\n{words_text(words)}\n}};\n"


def source_text(kernel, forms):
    """`forms`: words and edits for the GPU profile, and for the CPU profile."""
    (words, edits), (cpu_words, cpu_edits) = forms
    has_cpu = cpu_words != words
    arrays = {"kEdits": edits, "kCpuEdits": cpu_edits if has_cpu else ()}
    return SOURCE.format(
        name=kernel.name,
        type=kernel.type_name,
        words=words_text(words),
        cpu_words=array_text("kCpuWords", cpu_words) if has_cpu else "",
        cpu_name="kCpuWords" if has_cpu else "kWords",
        edits="".join(array_text(name, edits) for name, edits in arrays.items() if edits),
        edits_name=f"of_{kernel.name}::kEdits" if edits else "{}",
        cpu_edits_name=f"of_{kernel.name}::{'kCpuEdits' if has_cpu else 'kEdits'}" if edits else "{}",
        fingerprint=zlib.crc32(struct.pack(f"<{len(words)}I", *words)),
    )


def index_text(names):
    includes = "\n".join(f'#include "kernels/{name}.h"' for name in names)
    entries = "".join(f" \\\n  X({pascal(name)})" for name in names)
    return (
        "// Made by tools/kernels/embed_shaders.py: every kernel of the build.\n#pragma once\n\n"
        f"{includes}\n\n#define VKH_KERNELS(X){entries}\n"
    )


def write_if_changed(path, text):
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def check_words(name, words):
    if breach := float_order.breach(words) or explicit_layout.breach(words):
        sys.exit(f"{name}.comp: {breach}")


def form_of(kernel, words, validate):
    """Words that are embedded, and the edits that give their large buffers by address."""
    check_words(kernel.name, words)
    edits = by_address.edits(words, kernel.by_address)
    if edits:
        addressed = by_address.applied(words, edits)
        check_words(f"by address, {kernel.name}", addressed)
        validate(addressed)
    return words, edits


def embed(name, out_dir, words, embedded, validate=lambda words: None):
    """Writes NAME.h and NAME.cpp: `words`, as the compiler wrote them, describe the buffers; the
    program holds the pair `embedded`, for the GPU profile and for the CPU profile, which are valid.
    `validate` sees what their edits make of them."""
    try:
        kernel = reflect(name, words)
    except (ContractError, ValueError) as error:
        sys.exit(f"{name}.comp: {error}")
    flat, cpu = embedded
    flat_form = form_of(kernel, flat, validate)
    forms = (flat_form, form_of(kernel, cpu, validate) if cpu != flat else flat_form)
    write_if_changed(out_dir / f"{name}.h", header_text(kernel))
    # Writes it always: from this output a Makefile knows that this ran.
    (out_dir / f"{name}.cpp").write_text(source_text(kernel, forms))


def embed_kernel(spv, out_dir, flat=None, cpu=None):
    words = spirv.read_words(spv)
    flat_words = spirv.read_words(flat) if flat else words
    cpu_words = spirv.with_loops_kept(spirv.read_words(cpu)) if cpu else flat_words
    embed(spv.stem, out_dir, words, (flat_words, cpu_words))


SHADERS = Path(__file__).resolve().parents[2] / "shaders"


def embed_index(out_dir, names):
    write_if_changed(out_dir / "all_kernels.h", index_text(names))
    write_if_changed(out_dir / "all_kernels.cpp", '#include "kernels/all_kernels.h"\n')
    for header in out_dir.glob("*.h"):  # left from a removed shader: including it must not compile
        # The doctor's is in no list, and a Makefile does not make it again.
        if header.stem not in ("all_kernels", *names) and not any(SHADERS.glob(f"*/{header.stem}.comp")):
            header.unlink()


WIDE = 1  # constant_id of kWide (shaders/base/switches.glsl)


def main(args):
    if len(args) in (3, 5) and args[0] == "kernel":
        embed_kernel(*map(Path, args[1:]))
    elif len(args) >= 2 and args[0] == "index":
        embed_index(Path(args[1]), sorted(args[2:]))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
