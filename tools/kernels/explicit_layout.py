#!/usr/bin/env python3
"""Explicit layout (ArrayStride, Offset) of a SPIR-V module: on buffers alone.

  explicit_layout.py SPV    takes it off the arrays of variables that are no buffers

Vulkan allows it nowhere else (VUID-StandaloneSpirv-None-10684). glslang 12 gives a variable the
type of a buffer's array where both have the same elements and length.
breach() says what a module still has of it; embed_shaders.py embeds none that has any.
"""

import sys
from pathlib import Path

import spirv_module as spirv

WORKGROUP, PRIVATE, FUNCTION = 4, 6, 7
ARRAYS = (spirv.OP_TYPE_ARRAY, spirv.OP_TYPE_RUNTIME_ARRAY)


def has_layout(module, type_id):
    op, args = module.types[type_id]
    if op in ARRAYS:
        return spirv.ARRAY_STRIDE in module.decorations[type_id] or has_layout(module, args[0])
    if op == spirv.OP_TYPE_STRUCT:
        return any(module.offset(type_id, i) is not None or has_layout(module, member)
                   for i, member in enumerate(args))
    return False


def pointee(module, pointer):
    return module.types[pointer][1][1]


def laid_out_variables(module):
    """(id, pointer type) of the variables that are no buffers."""
    return [(variable, pointer) for variable, pointer, storage in module.variables
            if storage in (WORKGROUP, PRIVATE, FUNCTION) and has_layout(module, pointee(module, pointer))]


def without_layout(words):
    """The module, with array types of their own for such variables. spirv-val finds the cases that
    this leaves: arrays of types with a layout of their own, and variables that are loaded or stored
    whole."""
    module = spirv.module_of(words)
    found = laid_out_variables(module)
    bound = words[3]
    fresh, pointers = {}, {}  # by array type, by pointer type
    for _, pointer in found:
        fresh.setdefault(pointee(module, pointer), bound + len(fresh))
    for _, pointer in found:
        pointers.setdefault(pointer, bound + len(fresh) + len(pointers))
    variables = {variable for variable, _ in found}
    out = list(words[:5])
    out[3] = bound + len(fresh) + len(pointers)
    for at, op in spirv.instructions(words):
        text = list(words[at : at + (words[at] >> 16)])
        if op == spirv.OP_VARIABLE and text[2] in variables:
            text[1] = pointers[text[1]]
        out += text
        if op in spirv.TYPES and text[1] in fresh:
            out += [text[0], fresh[text[1]], *text[2:]]
        if op == spirv.OP_TYPE_POINTER and text[1] in pointers:
            out += [text[0], pointers[text[1]], text[2], fresh[text[3]]]
    return tuple(out)


def breach(words):
    """A variable that has a layout and should not, as text; None if there is none."""
    module = spirv.module_of(words)
    for variable, _ in laid_out_variables(module):
        return f"{module.names.get(variable, variable)} has an explicit layout and is no buffer"
    return None


def main(args):
    if len(args) != 1:
        sys.exit(__doc__)
    path = Path(args[0])
    spirv.write_words(path, without_layout(spirv.read_words(path)))


if __name__ == "__main__":
    main(sys.argv[1:])
