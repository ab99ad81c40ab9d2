"""Kernels whose large buffers are given by address, as edits of the words that bind them.

A device binds maxStorageBufferRange bytes of a buffer, often no more than 128 MiB. A context of
VKH_CONTEXT_BY_ADDRESS gives its kernels the addresses of the buffers that hold a mesh or its BVH,
behind the push constants, so that a shader is written once. The words are of SPIR-V 1.5 and keep
the convention of embed_shaders.py.

Both forms of a kernel have nearly the same words, so the second one is embedded as edits of the
first: numbers, again and again, of words kept, of words left out and of words put there, and the
latter. applied() here and engine/by_address.cpp apply them.
"""

import math

import spirv_module as spirv

# The bindings that become addresses: those of more than 4 bytes per face of a mesh.
LARGE = {"vertex_words", "index_words", "low_words", "vertices", "indices", "faces", "b_vertices",
         "b_faces", "triangles", "triangle_lows", "nodes", "branches", "boxes"}
OFFSET = 64  # of the addresses among the push constants, in the order of the bindings, 8 bytes each
MOST = 8  # 128 bytes of push constants are on every device

# The few words of the specification that this file needs beside spirv_module's.
OP_MEMORY_MODEL, OP_ENTRY_POINT, OP_CAPABILITY = 14, 15, 17
OP_FUNCTION, OP_LOAD, OP_STORE = 54, 61, 62
CHAINS = (65, 66)  # OpAccessChain, OpInBoundsAccessChain
OP_COMPOSITE_CONSTRUCT, OP_COMPOSITE_EXTRACT, OP_BITCAST = 80, 81, 124
OP_I_ADD, OP_I_ADD_CARRY, OP_U_MUL_EXTENDED = 128, 149, 151
PHYSICAL, PHYSICAL_ADDRESSES, PHYSICAL_64 = 5349, 5347, 5348  # storage, capability, addressing
BLOCK, ALIGNED = 2, 2  # a decoration; of a memory access
ARRAYS = (spirv.OP_TYPE_ARRAY, spirv.OP_TYPE_RUNTIME_ARRAY)
DECLARED = range(19, 43)  # types; the decorations of new ones stand before them
HEADER_WORDS, BOUND_AT = 5, 3
# The alignment of every buffer that is given by address, and the most that a component's access can
# use.
BASE_ALIGNMENT, WORD_BYTES = 16, 4


def bindings_of(buffers):
    """The bindings, as bits, that become addresses, of (binding, name)."""
    return sum(1 << binding for binding, name in buffers if name in LARGE)


class Declarations:
    """The module's declarations, as far as they concern the buffers that are given by address."""

    def __init__(self, words, wanted):
        self.bindings, self.blocks = {}, {}  # of their variables
        self.pointers = {}  # storage class and pointee
        self.moved = {}  # pointers into them: pointee, alignment in bytes
        self.word_type = self.pair_type = None  # uint; uvec2, if there is one
        self.push = self.push_member = None  # variable of the push constants; the type that they have
        self.structs, self.single = {}, {}  # types of members; decorations of structs of one member
        self.elements, self.strides, self.constants, self.offsets = {}, {}, {}, {}
        self._wanted = wanted
        for at, op in spirv.instructions(words):
            self._see(op, words[at + 1 : at + (words[at] >> 16)])

    def array_in(self, variable):
        """The element type of a binding's array, and its stride in bytes."""
        array = self.structs[self.blocks[variable]][0]
        return self.elements[array], self.strides[array]

    def single_of(self, variable):
        """The decorations of a block's member besides its offset: that others see writes
        (Coherent), that nothing is written."""
        return self.single.get(self.blocks[variable], ())

    def _see(self, op, a):
        if op in CHAINS:
            if a[2] in self.bindings or a[2] in self.moved:
                self.moved[a[1]] = (self.pointers[a[0]][1], self._alignment_of(a))
        elif op in spirv.TYPES:
            self._see_type(op, a)
        elif op in (spirv.OP_DECORATE, spirv.OP_MEMBER_DECORATE):
            self._see_decoration(op, a)
        elif op == spirv.OP_CONSTANT:
            self.constants[a[1]] = a[2]
        elif op == spirv.OP_VARIABLE:
            self._see_variable(a)

    def _see_type(self, op, a):
        if op == spirv.OP_TYPE_INT and a[1] == 32 and a[2] == 0:
            self.word_type = a[0]
        elif op == spirv.OP_TYPE_VECTOR and a[1] == self.word_type and a[2] == 2:
            self.pair_type = a[0]
        elif op == spirv.OP_TYPE_POINTER:
            self.pointers[a[0]] = (a[1], a[2])
        elif op == spirv.OP_TYPE_STRUCT:
            self.structs[a[0]] = a[1:]
        elif op in ARRAYS:
            self.elements[a[0]] = a[1]

    def _see_decoration(self, op, a):
        if op == spirv.OP_DECORATE:
            if a[1] == spirv.BINDING and self._wanted >> a[2] & 1:
                self.bindings[a[0]] = a[2]
            if a[1] == spirv.ARRAY_STRIDE:
                self.strides[a[0]] = a[2]
        elif a[2] == spirv.OFFSET:
            self.offsets[a[0], a[1]] = a[3]
        elif len(a) == 3:
            self.single.setdefault(a[0], []).append(a[2])

    def _see_variable(self, a):
        pointee = self.pointers[a[0]][1]
        if a[1] in self.bindings:
            self.blocks[a[1]] = pointee
        if a[2] == spirv.PUSH_CONSTANT:
            self.push, self.push_member = a[1], self.structs[pointee][0]

    def _alignment_of(self, chain):
        """The alignment that a chain of indices reaches: the greatest common divisor of its start
        and of each step. Drivers load 16 bytes at once only if that alignment is known."""
        base = chain[2]
        kind, alignment = self.moved.get(base) or (self.blocks[base], BASE_ALIGNMENT)
        for index in chain[3:]:
            if kind in self.elements:
                alignment = math.gcd(alignment, self.strides[kind])
                kind = self.elements[kind]
            elif kind in self.structs:
                member = self.constants[index]
                alignment = math.gcd(alignment, self.offsets[kind, member])
                kind = self.structs[kind][member]
            else:  # a component
                alignment = math.gcd(alignment, WORD_BYTES)
        return alignment


class Edits:
    """Numbers of words kept and left out, and the words put in their place."""

    def __init__(self):
        self.runs = []  # [kept, left out, words]

    def keep(self, count):
        if not self.runs or self.runs[-1][1] > 0 or self.runs[-1][2]:
            self.runs.append([0, 0, []])
        self.runs[-1][0] += count

    def replace(self, count, words):
        if not self.runs:
            self.runs.append([0, 0, []])
        self.runs[-1][1] += count
        self.runs[-1][2] += words

    def words(self):
        return tuple(w for kept, left_out, words in self.runs for w in (kept, left_out, len(words), *words))


def applied(words, edits):
    """The words after the edits."""
    out, at, edit = [], 0, 0
    while edit < len(edits):
        kept, left_out, count = edits[edit : edit + 3]
        out += words[at : at + kept]
        out += edits[edit + 3 : edit + 3 + count]
        at += kept + left_out
        edit += 3 + count
    return (*out, *words[at:])


class Rewriter:
    """The edits that turn `bindings`, as bits, into addresses."""

    def __init__(self, words, bindings):
        self.words, self.d, self.bound = words, Declarations(words, bindings), words[BOUND_AT]
        self.new = []  # words that stand before the present instruction, or in its place
        wanted = [b for b in range(bindings.bit_length()) if bindings >> b & 1]
        self.places = {binding: place for place, binding in enumerate(wanted)}
        self._name_ids()

    def edits(self):
        edits, has_decorations, has_types = Edits(), False, False
        edits.keep(BOUND_AT)
        edits.replace(1, [0])
        bound = edits.runs[-1][2]
        edits.keep(HEADER_WORDS - BOUND_AT - 1)
        self._put(OP_CAPABILITY, PHYSICAL_ADDRESSES)
        for at, op in spirv.instructions(self.words):
            length = self.words[at] >> 16
            if op in DECLARED and not has_decorations:
                self._put_decorations()
                has_decorations = True
            if op == OP_FUNCTION and not has_types:
                self._put_types()
                has_types = True
            is_kept = self._keeps(op, self.words[at + 1 : at + length])
            if self.new or not is_kept:
                edits.replace(0 if is_kept else length, self.new)
                self.new = []
            if is_kept:
                edits.keep(length)
        bound[0] = self.bound
        return edits.words()

    def _fresh(self):
        self.bound += 1
        return self.bound - 1

    def _put(self, op, *args):
        self.new += (len(args) + 1 << 16 | op, *args)

    def _name_ids(self):
        d = self.d
        self.new_push, self.new_pair = d.push is None, d.pair_type is None
        self.new_word = d.word_type is None
        self.push = self._fresh() if self.new_push else d.push
        self.pair = self._fresh() if self.new_pair else d.pair_type
        self.push_block, self.push_pointer, self.pair_pointer = (self._fresh() for _ in range(3))
        self.two_words, self.zero = self._fresh(), self._fresh()
        self.word_type = self._fresh() if self.new_word else d.word_type
        self.physical, self.strides, self.members, self.holders = {}, {}, {}, {}
        for _, (pointee, _) in sorted(d.moved.items()):
            if pointee not in self.physical:
                self.physical[pointee] = self._fresh()
        self.variables = sorted(d.bindings)
        for variable in self.variables:
            stride = d.array_in(variable)[1]
            if stride not in self.strides:
                self.strides[stride] = self._fresh()
            self.members[variable] = self._fresh()
            # A block of one element, with the decorations of the array, and a pointer to it.
            self.holders[variable] = (self._fresh(), self._fresh())

    def _put_decorations(self):
        for variable in self.variables:
            block = self.holders[variable][0]
            self._put(spirv.OP_DECORATE, block, BLOCK)
            self._put(spirv.OP_MEMBER_DECORATE, block, 0, spirv.OFFSET, 0)
            for decoration in self.d.single_of(variable):
                self._put(spirv.OP_MEMBER_DECORATE, block, 0, decoration)
        self._put(spirv.OP_DECORATE, self.push_block, BLOCK)
        # The block of push constants has the struct that they were, if any, then the addresses.
        if not self.new_push:
            self._put(spirv.OP_MEMBER_DECORATE, self.push_block, 0, spirv.OFFSET, 0)
        for member, variable in enumerate(self.variables, 0 if self.new_push else 1):
            offset = OFFSET + 8 * self.places[self.d.bindings[variable]]
            self._put(spirv.OP_MEMBER_DECORATE, self.push_block, member, spirv.OFFSET, offset)

    def _put_types(self):
        word = self.word_type
        if self.new_word:
            self._put(spirv.OP_TYPE_INT, word, 32, 0)
        for kind, pointer in sorted(self.physical.items()):
            self._put(spirv.OP_TYPE_POINTER, pointer, PHYSICAL, kind)
        for variable in self.variables:
            block, pointer = self.holders[variable]
            self._put(spirv.OP_TYPE_STRUCT, block, self.d.array_in(variable)[0])
            self._put(spirv.OP_TYPE_POINTER, pointer, PHYSICAL, block)
        if self.new_pair:
            self._put(spirv.OP_TYPE_VECTOR, self.pair, word, 2)
        self._put(spirv.OP_TYPE_POINTER, self.pair_pointer, spirv.PUSH_CONSTANT, self.pair)
        self._put(spirv.OP_TYPE_STRUCT, self.two_words, word, word)
        self._put(spirv.OP_CONSTANT, word, self.zero, 0)
        for stride, constant in sorted(self.strides.items()):
            self._put(spirv.OP_CONSTANT, word, constant, stride)
        members = [] if self.new_push else [self.d.push_member]
        for variable in self.variables:
            self._put(spirv.OP_CONSTANT, word, self.members[variable], len(members))
            members.append(self.pair)
        self._put(spirv.OP_TYPE_STRUCT, self.push_block, *members)
        self._put(spirv.OP_TYPE_POINTER, self.push_pointer, spirv.PUSH_CONSTANT, self.push_block)
        self._put(spirv.OP_VARIABLE, self.push_pointer, self.push, spirv.PUSH_CONSTANT)

    def _keeps(self, op, a):
        """Whether an instruction stays as it is; what replaces it is put."""
        d = self.d
        if op in (spirv.OP_NAME, spirv.OP_DECORATE) and a[0] in d.bindings:
            return False
        if op == spirv.OP_VARIABLE and (a[1] in d.bindings or a[1] == d.push):
            return False
        if op == OP_MEMORY_MODEL:
            self._put(OP_MEMORY_MODEL, PHYSICAL_64, a[1])
        elif op == OP_ENTRY_POINT:
            self._put_entry_point(a)
        elif op in CHAINS and a[1] in d.moved:
            self._put_chain(op, list(a))
        elif op == OP_LOAD and a[2] in d.moved:
            self._put_access(op, list(a), 3, d.moved[a[2]][1])
        elif op == OP_STORE and a[0] in d.moved:
            self._put_access(op, list(a), 2, d.moved[a[0]][1])
        else:
            return True
        return False

    def _put_entry_point(self, a):
        """The entry point's name, in words that end with a zero byte, and then all variables that
        it uses."""
        end = next(i for i in range(2, len(a)) if a[i] >> 24 == 0) + 1
        used = [i for i in a[end:] if i not in self.d.bindings]
        self._put(OP_ENTRY_POINT, *a[:end], *used, *([self.push] if self.new_push else []))

    def _value(self, op, kind, *operands):
        value = self._fresh()
        self._put(op, kind, value, *operands)
        return value

    def _word(self, op, *operands):
        return self._value(op, self.word_type, *operands)

    def _address(self, variable, index):
        """The address of an element, in 64 bits. If the driver adds the offset, an H200's (580.159)
        reaches something else 4 GiB and more behind an address."""
        at = self._value(CHAINS[0], self.pair_pointer, self.push, self.members[variable])
        start = self._value(OP_LOAD, self.pair, at)
        number = self._word(OP_I_ADD, index, self.zero)  # as uint, if it is an int
        stride = self.strides[self.d.array_in(variable)[1]]
        offset = self._value(OP_U_MUL_EXTENDED, self.two_words, number, stride)
        low = [self._word(OP_COMPOSITE_EXTRACT, pair, 0) for pair in (start, offset)]
        total = self._value(OP_I_ADD_CARRY, self.two_words, *low)
        high = self._word(OP_I_ADD, *[self._word(OP_COMPOSITE_EXTRACT, pair, 1) for pair in (start, offset)])
        carried = self._word(OP_I_ADD, high, self._word(OP_COMPOSITE_EXTRACT, total, 1))
        return self._value(OP_COMPOSITE_CONSTRUCT, self.pair, self._word(OP_COMPOSITE_EXTRACT, total, 0), carried)

    def _put_chain(self, op, args):
        """A chain into a binding names the block's one member, an element, and the part of it."""
        args[0] = self.physical[self.d.pointers[args[0]][1]]
        if args[2] in self.d.bindings:
            address = self._address(args[2], args[4])
            args[2] = self._value(OP_BITCAST, self.holders[args[2]][1], address)
            args[3] = self.zero
            del args[4]
        self._put(op, *args)

    def _put_access(self, op, args, operands, alignment):
        """An access by address states its alignment: behind `operands` arguments, and before any of
        a higher bit."""
        if len(args) == operands:
            args.append(0)
        args[operands] |= ALIGNED
        args.insert(operands + 1, alignment)
        self._put(op, *args)


def edits(words, bindings):
    """The edits of a module, a tuple of words; none if no binding becomes an address."""
    return Rewriter(words, bindings).edits() if bindings else ()
