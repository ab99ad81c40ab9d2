"""The declarations of a SPIR-V module, read straight from its words."""

import functools
import struct
from collections import defaultdict

# The few words of the SPIR-V 1.5 specification that reflection needs.
OP_NAME, OP_MEMBER_NAME, OP_EXECUTION_MODE, OP_EXECUTION_MODE_ID = 5, 6, 16, 331
OP_TYPE_BOOL, OP_TYPE_INT, OP_TYPE_FLOAT, OP_TYPE_VECTOR = 20, 21, 22, 23
OP_TYPE_ARRAY, OP_TYPE_RUNTIME_ARRAY, OP_TYPE_STRUCT, OP_TYPE_POINTER = 28, 29, 30, 32
OP_CONSTANT, OP_CONSTANT_COMPOSITE, OP_SPEC_CONSTANT, OP_SPEC_CONSTANT_COMPOSITE = 43, 44, 50, 51
OP_VARIABLE, OP_DECORATE, OP_MEMBER_DECORATE, OP_LOOP_MERGE = 59, 71, 72, 246
OP_TYPE_MATRIX = 24
TYPES = range(19, 40)
# Instructions whose first operand is their target, not the type of a result.
DECLARATIONS = {OP_NAME, OP_MEMBER_NAME, OP_DECORATE, OP_MEMBER_DECORATE, *TYPES}
MODE_LOCAL_SIZE, MODE_LOCAL_SIZE_ID = 17, 38
ARRAY_STRIDE, BUILT_IN, NON_WRITABLE, BINDING, DESCRIPTOR_SET, OFFSET = 6, 11, 24, 33, 34, 35
BUILT_IN_WORKGROUP_SIZE = 25
LOOP_UNROLL, LOOP_DONT_UNROLL = 1, 2
UNIFORM_CONSTANT, UNIFORM, PUSH_CONSTANT, STORAGE_BUFFER = 0, 2, 9, 12
INTERFACE = (UNIFORM_CONSTANT, UNIFORM, PUSH_CONSTANT, STORAGE_BUFFER)  # bound by the host


def literal_string(words):
    return struct.pack(f"<{len(words)}I", *words).split(b"\0", 1)[0].decode()


def read_words(path):
    data = path.read_bytes()
    return struct.unpack(f"<{len(data) // 4}I", data)


def write_words(path, words):
    path.write_bytes(struct.pack(f"<{len(words)}I", *words))


def instructions(words):
    """The place and the opcode of each instruction."""
    at = 5
    while at < len(words):
        yield at, words[at] & 0xFFFF
        at += words[at] >> 16


def with_loops_kept(words):
    """The module with its loops marked to be left alone, except those marked to be unrolled."""
    kept = list(words)
    for at, op in instructions(words):
        if op == OP_LOOP_MERGE and not words[at + 3] & LOOP_UNROLL:
            kept[at + 3] |= LOOP_DONT_UNROLL
    return tuple(kept)


OP_CONSTANT_TRUE, OP_CONSTANT_FALSE = 41, 42
OP_SPEC_CONSTANT_TRUE, OP_SPEC_CONSTANT_FALSE, OP_SPEC_CONSTANT_OP = 48, 49, 52
OP_LOGICAL_OR, OP_LOGICAL_AND, OP_LOGICAL_NOT = 166, 167, 168
SPEC_ID = 1


def with_constant_false(words, spec_id):
    """The module with its boolean specialisation constant `spec_id` fixed to false, and all that
    follows from that alone, which spirv-opt leaves if another operand is a constant of that kind.
    """
    ids = [words[at + 1] for at, op in instructions(words)
           if op == OP_DECORATE and words[at + 2] == SPEC_ID and words[at + 3] == spec_id]
    known, out = {}, list(words[:5])
    for at, op in instructions(words):
        text = words[at : at + (words[at] >> 16)]
        if op == OP_DECORATE and text[1] in ids and text[2] == SPEC_ID:
            continue
        value = None
        if op in (OP_SPEC_CONSTANT_TRUE, OP_SPEC_CONSTANT_FALSE) and text[2] in ids:
            value = False
        elif op == OP_SPEC_CONSTANT_OP:
            value = _logical(text[3], [known.get(i) for i in text[4:]])
        elif op in (OP_CONSTANT_TRUE, OP_CONSTANT_FALSE):
            known[text[2]] = op == OP_CONSTANT_TRUE
        if value is not None:
            known[text[2]] = value
            text = (3 << 16 | (OP_CONSTANT_TRUE if value else OP_CONSTANT_FALSE), text[1], text[2])
        out += text
    return tuple(out)


def _logical(op, operands):
    """The value of an operation on booleans of which some are not known; None if it is not."""
    if op == OP_LOGICAL_AND:
        return False if False in operands else True if operands == [True, True] else None
    if op == OP_LOGICAL_OR:
        return True if True in operands else False if operands == [False, False] else None
    if op == OP_LOGICAL_NOT and operands[0] is not None:
        return not operands[0]
    return None


class Module:
    """The declarations of one SPIR-V module, by id."""

    def __init__(self, words):
        if len(words) < 5 or words[0] != 0x07230203:
            raise ValueError("not a SPIR-V module of this machine's byte order")
        self.names, self.member_names = {}, defaultdict(dict)
        self.decorations, self.member_decorations = defaultdict(dict), defaultdict(dict)
        self.types, self.constants, self.composites = {}, {}, {}
        self.operations = {}  # of specialisation constants: opcode and operands
        self.variables, self.local_size = [], None
        for at, op in instructions(words):
            self._declare(op, words[at + 1 : at + (words[at] >> 16)])
        self._find_local_size()

    def _declare(self, op, args):
        if op == OP_NAME:
            self.names[args[0]] = literal_string(args[1:])
        elif op == OP_MEMBER_NAME:
            self.member_names[args[0]][args[1]] = literal_string(args[2:])
        elif op == OP_DECORATE:
            self.decorations[args[0]][args[1]] = args[2] if len(args) > 2 else True
        elif op == OP_MEMBER_DECORATE:
            value = args[3] if len(args) > 3 else True
            self.member_decorations[args[0], args[1]][args[2]] = value
        elif op in TYPES:
            self.types[args[0]] = (op, args[1:])
        elif op in (OP_CONSTANT, OP_SPEC_CONSTANT):
            self.constants[args[1]] = (args[2], op == OP_SPEC_CONSTANT)
        elif op == OP_SPEC_CONSTANT_OP:
            self.operations[args[1]] = (args[2], args[3:])
        elif op in (OP_CONSTANT_TRUE, OP_SPEC_CONSTANT_TRUE, OP_CONSTANT_FALSE, OP_SPEC_CONSTANT_FALSE):
            true = op in (OP_CONSTANT_TRUE, OP_SPEC_CONSTANT_TRUE)
            self.constants[args[1]] = (int(true), op in (OP_SPEC_CONSTANT_TRUE, OP_SPEC_CONSTANT_FALSE))
        elif op in (OP_CONSTANT_COMPOSITE, OP_SPEC_CONSTANT_COMPOSITE):
            self.composites[args[1]] = args[2:]
        elif op == OP_VARIABLE:
            self.variables.append((args[1], args[0], args[2]))  # id, pointer type, storage class
        elif op in (OP_EXECUTION_MODE, OP_EXECUTION_MODE_ID):
            if args[1] == MODE_LOCAL_SIZE:
                self.local_size = [("value", n) for n in args[2:5]]
            elif args[1] == MODE_LOCAL_SIZE_ID:
                self.local_size = [("id", i) for i in args[2:5]]

    def offset(self, struct_id, index):
        return self.member_decorations[struct_id, index].get(OFFSET)

    def _find_local_size(self):
        """glslang writes local_size_x_id as the constant WorkgroupSize, which wins."""
        for i, members in self.composites.items():
            if self.decorations[i].get(BUILT_IN) == BUILT_IN_WORKGROUP_SIZE:
                self.local_size = [("id", m) for m in members]
        if self.local_size is None:
            raise ValueError("no local size: is this a compute shader?")
        resolve = {"id": lambda n: self.constants[n][0], "value": lambda n: n}
        self.local_size = [resolve[kind](n) for kind, n in self.local_size]


@functools.lru_cache(maxsize=4)
def module_of(words):
    """The declarations of a tuple of words: several passes need those of the same module."""
    return Module(words)
