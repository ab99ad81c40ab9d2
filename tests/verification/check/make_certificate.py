"""Writes certificates (docs/certificate-file.md) of small meshes, in exact arithmetic, for tests.

A mesh is a list of faces: three corners of three doubles each. A certificate is a Model first, which tests can spoil.
"""

import hashlib
import heapq
import itertools
import struct
from fractions import Fraction

import truth


class Read:
    """The way that a mesh was read: from version 2 on. A polygon is [face, corners, axis,
    triangles]."""

    def __init__(self, polygons=()):
        self.points = self.bodies = self.face = self.matrix = 0
        self.ambiguity, self.over, self.under, self.polygons, self.count = 0.0, 1.0, 1.0, list(polygons), None

    def encode(self):
        count = len(self.polygons) if self.count is None else self.count
        out, after = struct.pack("<IIdQddQQ", self.points, self.bodies, self.ambiguity, self.face, self.over, self.under, self.matrix, count), 0
        for face, corners, axis, triangles in self.polygons:
            out += b"".join(counted(x) for x in (face - after, corners, axis, *itertools.chain(*triangles)))
            after = face + 1
        return out


class Model:
    """All contents of a file. A tree is [op, first, second], [3, S] or [4 + corner, S, R, s, t]."""

    def __init__(self, a, b, deltas=(0.0, 0.0), files=(None, None), version=2):
        self.magic, self.zero, self.deltas, self.directions = b"VHCERT0%d" % version, 0, list(deltas), []
        self.read = [Read(), Read()] if version > 1 else []
        self.cut_bits = 16 if version > 1 else 8
        self.count = None  # of directions, where it is not theirs
        self.faces = [len(a), len(b)]
        self.hashes = [bytes(32) if f is None else hashlib.sha256(f).digest() for f in files] + [corner_hash(a), corner_hash(b)]


class Direction:
    def __init__(self, lower, upper, witness, trees):
        self.lower, self.upper, self.witness, self.blocks = lower, upper, list(witness), [trees]


def corner_hash(mesh):
    return hashlib.sha256(struct.pack(f"<{9 * len(mesh)}d", *(x + 0.0 for face in mesh for p in face for x in p))).digest()


def number(difference, padding=0):
    return counted(2 * difference if difference >= 0 else -2 * difference - 1, padding)


def counted(code, padding=0):
    if code < 0:
        raise struct.error("not a number that the format has")
    out = bytearray()
    while True:
        out.append(code & 127)
        code >>= 7
        if not code:
            break
    out += bytes(padding)
    return bytes(x | 128 for x in out[:-1]) + out[-1:]


def encode_block(trees, padding=0, cut_bits=16):
    """The bytes; padding makes the first number longer than it needs to be."""
    out, before = bytearray(), 0
    waiting = list(reversed(trees))
    while waiting:
        op, *rest = waiting.pop()
        out.append(op & 255)
        if op <= 2:
            waiting += reversed(rest)
            continue
        for value in rest[:1 if op == 3 else 2]:
            out += number(value - before, padding)
            before, padding = value, 0
        out += b"".join(struct.pack("<B" if cut_bits == 8 else "<H", x) for x in rest[2:]) if op > 3 else b""
    return bytes(out)


def encode(model, padding=0):
    count = len(model.directions) if model.count is None else model.count
    out = struct.pack("<8sIIQQdd", model.magic, count, model.zero, *model.faces, *model.deltas)
    out += b"".join(model.hashes) + b"".join(read.encode() for read in model.read)
    for direction in model.directions:
        out += struct.pack("<ddIIQQ", direction.lower, direction.upper, *direction.witness)
        for trees in direction.blocks:
            body = encode_block(trees, padding, model.cut_bits)
            out += struct.pack("<II", len(trees), len(body)) + body
    return out


def middle(p, q):
    return tuple((x + y) // 2 if isinstance(x, int) else (x + y) / 2 for x, y in zip(p, q))


class Prover:
    """One direction: faces are halved, the worst part first, until it is good enough or there are enough parts."""

    def __init__(self, x, y, rng, slack, parts, cut_bits=16):
        self.whole = 2 ** cut_bits
        (self.x, self.y), unit = truth.scaled(x, y)
        self.unit, self.rng, self.slack, self.known = Fraction(unit) ** 2, rng, slack, {}
        self.low, self.witness = Fraction(-1), None
        self.trees, self.heap, self.leaves, self.counter = [], [], [], itertools.count()
        corners = [tuple(Fraction(i == j) for j in range(3)) for i in range(3)]
        for f, face in enumerate(self.x):
            self.trees.append([])
            self.add(self.trees[-1], f, list(zip(face, corners)))
        while self.heap and parts > 0:
            parts -= 1
            bound, _, tree, f, v = heapq.heappop(self.heap)
            if -bound <= self.enough():
                heapq.heappush(self.heap, (bound, next(self.counter), tree, f, v))
                break
            if not self.cut(tree, v, self.enough()):
                self.halve(tree, f, v)
        for bound, _, tree, _, v in self.heap:  # a few of them are cut, where one triangle would do, too
            if rng.random() < 0.7 or not self.cut(tree, v, -bound):
                tree[:] = [3, self.best([p for p, _ in v])[1]]
                self.leaves.append(-bound)
        self.high = max(self.leaves)

    def enough(self):
        return self.low * Fraction(1 + self.slack) ** 2

    def of(self, p):
        if p not in self.known:
            self.known[p] = [truth.square(p, face) for face in self.y]
        return self.known[p]

    def best(self, points):
        return min((largest, s) for s, largest in enumerate(map(max, zip(*map(self.of, points)))))

    def add(self, tree, f, v):
        for p, weights in v:
            if min(self.of(p)) > self.low:
                self.low, self.witness = min(self.of(p)), (f, weights)
        heapq.heappush(self.heap, (-self.best([p for p, _ in v])[0], next(self.counter), tree, f, v))

    def halve(self, tree, f, v):
        def length(i):
            return sum((a - b) ** 2 for a, b in zip(v[(i + 1) % 3][0], v[(i + 2) % 3][0]))
        i = self.rng.randrange(3) if self.rng.random() < 0.2 else max(range(3), key=length)
        j, k = (i + 1) % 3, (i + 2) % 3
        m = (middle(v[j][0], v[k][0]), middle(v[j][1], v[k][1]))
        tree[:] = [i, [], []]
        for half, replaced in ((tree[1], k), (tree[2], j)):
            self.add(half, f, [m if n == replaced else v[n] for n in range(3)])

    def cut(self, tree, v, enough):
        """Makes the part a leaf that is cut, if two triangles are good enough."""
        for o in self.rng.sample(range(3), 3):
            a, b, c = (v[(o + n) % 3][0] for n in range(3))
            whole = self.whole
            for s, t in ((whole // 2, whole // 2),
                         (self.rng.choice((0, 1, whole - 1, whole // 4)), self.rng.choice((0, 1, whole - 1, whole * 3 // 4))),
                         (self.rng.randrange(whole), self.rng.randrange(whole))):
                p = tuple(x + (y - x) * s // whole for x, y in zip(a, b))
                q = tuple(x + (y - x) * t // whole for x, y in zip(a, c))
                (first, one), (second, other) = self.best([a, p, q]), self.best([p, q, b, c])
                if max(first, second) <= enough:
                    tree[:] = [4 + o, one, other, s, t]
                    self.leaves.append(max(first, second))
                    return True
        return False

    def direction(self, delta):
        lower = truth.lower_double(self.low / self.unit, delta)
        upper = truth.upper_double(self.high / self.unit, delta)
        if upper is None:
            return None
        f, weights = self.witness
        e = max(w.denominator.bit_length() - 1 for w in weights)
        witness = [f, e, int(weights[1] * 2 ** e), int(weights[2] * 2 ** e)] if lower > 0 else [0, 0, 0, 0]
        return Direction(lower, upper, witness, self.trees)


def make(a, b, rng, both=False, slack=0.05, parts=60, deltas=(0.0, 0.0), files=(None, None), version=2):
    """A certificate's Model, as tight as its trees are; None if no double is an upper bound."""
    model = Model(a, b, deltas, files, version)
    for x, y in ((a, b), (b, a))[:1 + both]:
        model.directions.append(Prover(x, y, rng, slack, parts, model.cut_bits).direction(sum(map(Fraction, deltas))))
        if model.directions[-1] is None:
            return None
        if len(x) > 1 and rng.random() < 0.5:  # in two blocks
            trees, at = model.directions[-1].blocks[0], rng.randrange(1, len(x))
            model.directions[-1].blocks = [trees[:at], trees[at:]]
    return model
