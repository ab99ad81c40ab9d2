"""The shared memory of a kernel's workgroup, from its SPIR-V, for all switches."""

import itertools

import spirv_module as spirv

WORKGROUP = 4  # storage class
SWITCHES = 0  # constant_id of kSwitches (shaders/base/switches.glsl)
MASK = 0xFFFFFFFF
BITWISE_AND = 199
OPERATIONS = {128: lambda a, b: a + b, 130: lambda a, b: a - b, 132: lambda a, b: a * b,
              134: lambda a, b: a // b, 137: lambda a, b: a % b, 166: lambda a, b: a or b,
              167: lambda a, b: a and b, 168: lambda a: not a, 169: lambda c, a, b: a if c else b,
              170: lambda a, b: a == b, 171: lambda a, b: a != b, 172: lambda a, b: a > b,
              174: lambda a, b: a >= b, 176: lambda a, b: a < b, 178: lambda a, b: a <= b,
              194: lambda a, b: a >> b, 196: lambda a, b: a << b, 197: lambda a, b: a | b,
              BITWISE_AND: lambda a, b: a & b}


class Sizes:
    """Sizes of types if kSwitches has the value `switches`."""

    def __init__(self, module, switches):
        self.module = module
        self.switches = switches
        self.asked = set()  # the bits that a size depends on

    def constant(self, i):
        if i in self.module.operations:
            op, operands = self.module.operations[i]
            if op not in OPERATIONS:
                raise ValueError(f"a size by SPIR-V opcode {op}, which shared_memory.py does not know")
            values = [self.constant(o) for o in operands]
            if op == BITWISE_AND and any(self.is_switches(o) for o in operands):
                self.asked |= {v for o, v in zip(operands, values) if not self.is_switches(o)}
            return int(OPERATIONS[op](*values)) & MASK
        return self.switches if self.is_switches(i) else self.module.constants[i][0]

    def is_switches(self, i):
        return self.module.decorations[i].get(spirv.SPEC_ID) == SWITCHES

    def of(self, type_id):
        op, args = self.module.types[type_id]
        if op in (spirv.OP_TYPE_INT, spirv.OP_TYPE_FLOAT):
            return args[0] // 8
        if op == spirv.OP_TYPE_BOOL:
            return 4
        if op == spirv.OP_TYPE_VECTOR:
            # Drivers lay shared memory out as they like; this takes the size in std430.
            return self.of(args[0]) * (4 if args[1] == 3 else args[1])
        if op == spirv.OP_TYPE_ARRAY:
            return self.of(args[0]) * self.constant(args[1])
        if op == spirv.OP_TYPE_STRUCT:
            return (sum(map(self.of, args)) + 15) // 16 * 16
        raise ValueError(f"shared memory of a type (SPIR-V opcode {op}) that shared_memory.py does not know")

    def total(self):
        return sum(self.of(self.module.types[pointer][1][1])
                   for _, pointer, storage in self.module.variables if storage == WORKGROUP)


def most_bytes(words):
    """The largest total over all values of the switches that any size depends on."""
    module = spirv.Module(words)
    first = Sizes(module, 0)
    most = first.total()
    bits = sorted({1 << b for mask in first.asked for b in range(32) if mask >> b & 1})
    for chosen in itertools.product((0, 1), repeat=len(bits)):
        most = max(most, Sizes(module, sum(b for b, on in zip(bits, chosen) if on)).total())
    return most
