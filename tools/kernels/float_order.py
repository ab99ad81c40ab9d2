#!/usr/bin/env python3
"""Float operations of a SPIR-V module: decorated so that no driver may rearrange them.

  float_order.py SPV    decorates every float operation of the file NoContraction

Without that decoration Vulkan lets a driver use associativity and distributivity ("Evaluation of
Expressions", appendix "Vulkan Environment for SPIR-V"). docs/certificate.md has the quotation.
breach() says what a module still leaves open; embed_shaders.py embeds none that has one.
"""

import sys
from pathlib import Path

import spirv_module as spirv

NO_CONTRACTION = 42

# Operations that round, each once, and so may be decorated: then only one order is left.
ROUNDED = {127: "OpFNegate", 129: "OpFAdd", 131: "OpFSub", 133: "OpFMul", 136: "OpFDiv",
           142: "OpVectorTimesScalar"}

# Float results that nothing is rounded for: moved, chosen, or converted from an integer at once.
MOVED = {1: "OpUndef", 12: "OpExtInst", 43: "OpConstant", 44: "OpConstantComposite",
         46: "OpConstantNull", 50: "OpSpecConstant", 51: "OpSpecConstantComposite",
         54: "OpFunction", 55: "OpFunctionParameter", 57: "OpFunctionCall", 61: "OpLoad",
         77: "OpVectorExtractDynamic", 78: "OpVectorInsertDynamic", 79: "OpVectorShuffle",
         80: "OpCompositeConstruct", 81: "OpCompositeExtract", 82: "OpCompositeInsert",
         83: "OpCopyObject", 111: "OpConvertSToF", 112: "OpConvertUToF", 124: "OpBitcast",
         169: "OpSelect", 245: "OpPhi", 337: "OpGroupNonUniformBroadcast",
         338: "OpGroupNonUniformBroadcastFirst", 345: "OpGroupNonUniformShuffle",
         355: "OpGroupNonUniformFMin", 358: "OpGroupNonUniformFMax"}
OP_EXT_INST_IMPORT, OP_EXT_INST, OP_SPEC_CONSTANT_OP = 11, 12, 52

# Instructions of GLSL.std.450: exact ones, and the root, a formula of one operation. It leaves out
# Fma, FMix, Length, Distance, Normalize, Cross: like OpDot they are sums of products, whose inner
# order no decoration fixes.
EXTENDED = {4: "FAbs", 31: "Sqrt", 37: "FMin", 40: "FMax", 43: "FClamp"}


def float_types(module):
    """The ids of floats and of vectors of them; matrices are not used."""
    floats = {i for i, (op, _) in module.types.items() if op == spirv.OP_TYPE_FLOAT}
    vectors = {i for i, (op, args) in module.types.items()
               if op == spirv.OP_TYPE_VECTOR and args[0] in floats}
    matrices = {i for i, (op, _) in module.types.items() if op == spirv.OP_TYPE_MATRIX}
    return floats | vectors | matrices


def float_results(words):
    """(opcode, result id, extended instruction or None) of every instruction that gives floats."""
    types = float_types(spirv.module_of(words))
    for at, op in spirv.instructions(words):
        has_type = words[at] >> 16 > 2 and op not in spirv.DECLARATIONS
        if has_type and words[at + 1] in types:
            op = words[at + 3] if op == OP_SPEC_CONSTANT_OP else op
            yield op, words[at + 2], words[at + 4] if op == OP_EXT_INST else None


def decorated(words):
    """The module with each of its float operations decorated."""
    known = no_contraction(words)
    added = [word for op, result, _ in float_results(words)
             if op in ROUNDED and result not in known
             for word in (3 << 16 | spirv.OP_DECORATE, result, NO_CONTRACTION)]
    at = next(at for at, op in spirv.instructions(words) if op in spirv.TYPES)
    return (*words[:at], *added, *words[at:])


def no_contraction(words):
    return {words[at + 1] for at, op in spirv.instructions(words)
            if op == spirv.OP_DECORATE and words[at + 2] == NO_CONTRACTION}


def other_instructions(words):
    """Extended instructions of other sets than GLSL.std.450, and ones that give several values."""
    types = spirv.module_of(words).types
    for at, op in spirv.instructions(words):
        if op == OP_EXT_INST_IMPORT:
            name = spirv.literal_string(words[at + 2:at + (words[at] >> 16)])
            if name != "GLSL.std.450":
                return f"imports {name}, whose instructions are not known"
        if op == OP_EXT_INST and types[words[at + 1]][0] == spirv.OP_TYPE_STRUCT:
            return f"uses GLSL.std.450 instruction {words[at + 4]}, which gives several values"
    return None


def breach(words):
    """The operation that a driver may still rearrange, as text; None if there is none."""
    known = no_contraction(words)
    if breach := other_instructions(words):
        return breach
    for op, result, extended in float_results(words):
        if op in ROUNDED and result not in known:
            return f"{ROUNDED[op]} %{result} is not decorated NoContraction"
        if op == OP_EXT_INST and extended not in EXTENDED:
            return f"uses GLSL.std.450 instruction {extended} on floats, whose order is not fixed"
        if op not in ROUNDED and op not in MOVED:
            return f"uses SPIR-V opcode {op} on floats, whose order is not fixed: write it out"
    return None


def main(args):
    if len(args) != 1:
        sys.exit(__doc__)
    path = Path(args[0])
    spirv.write_words(path, decorated(spirv.read_words(path)))


if __name__ == "__main__":
    main(sys.argv[1:])
