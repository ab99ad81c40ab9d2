"""Ways to spoil a certificate. Each changes a Model, and returns the answers that a checker may give."""

import math
import struct

from make_certificate import encode, encode_block

ANY, BROKEN, PROVEN, NOT_PROVEN = {0, 1, 4}, {4}, {0}, {1, 4}


def nodes(tree):
    yield tree
    if tree[0] <= 2:
        yield from nodes(tree[1])
        yield from nodes(tree[2])


def some_node(rng, model, wanted=lambda node: True):
    """A node of any tree that is as wanted, or None."""
    found = [n for d in model.directions for trees in d.blocks for tree in trees for n in nodes(tree) if wanted(n)]
    return rng.choice(found) if found else None


def leaf(node):
    return node[0] >= 3


def others(model, node):
    """The number of triangles that a leaf chooses from."""
    for d, count in zip(model.directions, reversed(model.faces)):
        if any(n is node for trees in d.blocks for tree in trees for n in nodes(tree)):
            return count
    return 1


# ---- Trees. Each returns the possible answers, or None if there is nothing to spoil.

def drop_leaf(rng, model):
    node = some_node(rng, model, lambda n: n[0] <= 2 and (leaf(n[1]) or leaf(n[2])))
    if node:
        del node[1 if leaf(node[1]) else 2]
        return BROKEN


def drop_half(rng, model):
    """The tree ends if a half suffices for the whole."""
    node = some_node(rng, model, lambda n: n[0] <= 2)
    if node:
        node[:] = node[rng.randrange(1, 3)]
        return ANY


def swap_halves(rng, model):
    node = some_node(rng, model, lambda n: n[0] <= 2)
    if node:
        node[1], node[2] = node[2], node[1]
        return ANY


def turn_halving(rng, model):
    node = some_node(rng, model, lambda n: n[0] <= 2)
    if node:
        node[0] = (node[0] + rng.randrange(1, 3)) % 3
        return ANY


def other_op(rng, model):
    node = some_node(rng, model)
    triangle = node[1] if leaf(node) else 0
    node[0] = rng.choice([op for op in (*range(8), 127, 128, 131, 255) if op != node[0]])
    node[1:] = [[3, 0], [3, 0]] if node[0] <= 2 else [triangle] if node[0] == 3 else [triangle, triangle, 128, 128]
    return BROKEN if node[0] > 6 else ANY


def other_triangle(rng, model):
    node = some_node(rng, model, leaf)
    node[rng.randrange(1, 2 if node[0] == 3 else 3)] = rng.randrange(others(model, node))
    return ANY


def no_triangle(rng, model):
    node = some_node(rng, model, leaf)
    place = rng.randrange(1, 2 if node[0] == 3 else 3)
    near = node[place]
    node[place] = rng.choice([-1, others(model, node), others(model, node) + 1, near + 2 ** 32, near - 2 ** 32, near + 2 ** 31,
                              near - 2 ** 31, near + 2 ** 33, near - 2 ** 33, 2 ** 34 - 1, -2 ** 34])
    return BROKEN


def long_number(rng, model):
    """The number takes six bytes or more."""
    node = some_node(rng, model, leaf)
    node[1] = rng.choice([2 ** 40, -2 ** 35, 2 ** 63, 2 ** 64, 2 ** 70 + node[1]])
    return BROKEN


def some_cut(rng, model):
    whole = 2 ** model.cut_bits
    return rng.choice([0, 1, whole // 2 - 1, whole // 2, whole - 2, whole - 1, rng.randrange(whole)])


def swap_triangles(rng, model):
    node = some_node(rng, model, lambda n: n[0] > 3)
    if node:
        node[1], node[2] = node[2], node[1]
        return ANY


def move_cut(rng, model):
    node = some_node(rng, model, lambda n: n[0] > 3)
    if node:
        node[rng.randrange(3, 5)] = some_cut(rng, model)
        return ANY


def turn_cut(rng, model):
    node = some_node(rng, model, lambda n: n[0] > 3)
    if node:
        node[0] = 4 + (node[0] - 4 + rng.randrange(1, 3)) % 3
        return ANY


def uncut(rng, model):
    node = some_node(rng, model, lambda n: n[0] > 3)
    if node:
        node[:] = [3, node[rng.randrange(1, 3)]]
        return ANY


def cut_whole(rng, model):
    """If one triangle suffices, it does for both pieces of any cut."""
    node = some_node(rng, model, lambda n: n[0] == 3)
    if node:
        node[:] = [4 + rng.randrange(3), node[1], node[1], some_cut(rng, model), some_cut(rng, model)]
        return PROVEN


def depth_of(model, node):
    def find(tree, depth):
        if tree is node:
            return depth
        return tree[0] <= 2 and (find(tree[1], depth + 1) or find(tree[2], depth + 1))
    return next((d for x in model.directions for trees in x.blocks for tree in trees for d in [find(tree, 1)] if d), 1) - 1


def deep(rng, model):
    """A leaf of one triangle halved on and on: proven at depth 100, broken at 101."""
    node = some_node(rng, model, lambda n: n[0] == 3)
    if node:
        triangle, to = node[1], rng.choice((99, 100, 101, 102, 500, 20000))
        for _ in range(to - depth_of(model, node)):
            side = rng.randrange(1, 3)
            node[:] = [rng.randrange(3), [3, triangle], [3, triangle]]
            node = node[side]
        return PROVEN if to <= 100 else BROKEN


def chain(rng, model):
    """Adds halvings that no leaf follows."""
    direction = rng.choice(model.directions)
    direction.blocks[-1][-1] = [3, 0]
    tree = direction.blocks[-1][-1]
    for _ in range(rng.choice((1, 99, 100, 101, 5000, 1000000))):
        tree[:] = [rng.randrange(3), []]
        tree = tree[1]
    tree[:] = [3, 0]
    return BROKEN


# ---- Bounds and witnesses.

def nudge(value, toward, steps=1):
    for _ in range(steps):
        value = math.nextafter(value, toward)
    return value


def lower_upper(rng, model):
    d = rng.choice(model.directions)
    if d.upper == 0:
        return None
    d.upper = min(nudge(d.upper, 0.0), rng.choice([d.upper, nudge(d.upper, 0.0, 3), d.upper * 0.999, d.upper / 2, 0.0]))
    if rng.random() < 0.5 and d.lower > d.upper:
        d.lower, d.witness = 0.0, [0, 0, 0, 0]
    return NOT_PROVEN


def raise_upper(rng, model):
    d = rng.choice(model.directions)
    d.upper = rng.choice([nudge(d.upper, math.inf), d.upper * 1.5, 1.7976931348623157e308])
    return PROVEN if math.isfinite(d.upper) else BROKEN


def raise_lower(rng, model):
    """Raises lower, which was the largest double that its witness proves."""
    d = rng.choice(model.directions)
    d.lower = rng.choice([nudge(d.lower, math.inf), nudge(d.lower, math.inf, 3), d.lower * 1.001 + 5e-324, d.upper,
                          2 * d.upper + 5e-324])
    d.upper = max(d.upper, rng.choice((d.upper, d.lower)))
    return NOT_PROVEN if d.lower > d.before else None


def lower_lower(rng, model):
    d = rng.choice(model.directions)
    if d.lower == 0:
        return None
    d.lower = rng.choice([nudge(d.lower, 0.0), d.lower / 2, 5e-324, 0.0])
    if d.lower == 0 and rng.random() < 0.5:
        d.witness = [0, 0, 0, 0]
    return PROVEN if d.lower > 0 or not any(d.witness) else BROKEN


def no_number(rng, model):
    d = rng.choice(model.directions)
    value = rng.choice([math.nan, math.inf, -math.inf, -1.0, -5e-324, -0.0, struct.unpack("<d", b"\1\0\0\0\0\0\xf0\xff")[0]])
    which = rng.randrange(4)
    if which < 2:
        setattr(d, ("lower", "upper")[which], value)
    else:
        model.deltas[which - 2] = value
    return BROKEN


def move_witness(rng, model):
    d = rng.choice(model.directions)
    place = rng.randrange(4)
    f, e, j, k = d.witness
    if rng.random() < 0.5:
        d.witness = rng.choice([[f, 62, 2 ** 62, 0], [f, 62, 0, 2 ** 62], [f, 61, 2 ** 60, 2 ** 60], [f, e, k, j], [f, 0, 0, 0],
                                [f, 0, 1, 0]])
    else:
        d.witness[place] = rng.choice([d.witness[place] + 1, d.witness[place] ^ 1 << rng.randrange(32), 0])
    return ANY


def no_witness(rng, model):
    d = rng.choice(model.directions)
    f, e, j, k = d.witness
    count = model.faces[model.directions.index(d)]
    d.witness = rng.choice([[count, e, j, k], [2 ** 32 - 1, e, j, k], [f, 63, j, k], [f, 64, j, k], [f, 2 ** 32 - 1, j, k], [f, e, 2 ** e, 1],
                            [f, e, 2 ** e - k + 1, k], [f, e, 2 ** 63, 2 ** 63], [f, e, 2 ** 64 - 1, 2], [f, 62, 2 ** 62, 2 ** 62],
                            [f, e, 1, 2 ** 64 - 1], [f, 62, 2 ** 63, 0]])
    return BROKEN


# ---- Headers and blocks.

def flip_hash(rng, model):
    which = rng.randrange(4)
    old = bytearray(model.hashes[which])
    old[rng.randrange(32)] ^= 1 << rng.randrange(8)
    model.hashes[which] = bytes(old)
    return {1}


def swap_hashes(rng, model):
    h = model.hashes
    model.hashes = [h[2], h[3], h[0], h[1]] if rng.random() < 0.5 else [h[1], h[0], h[3], h[2]]
    return ANY


def header(rng, model):
    which = rng.randrange(4)
    if which == 0:
        model.magic = rng.choice([b"VHCERT01" if model.read else b"VHCERT02", b"VHCERT03", b"VHCERT00", b"vhcert01", bytes(8)])
    elif which == 1:
        model.zero = rng.choice([1, 2 ** 31, 2 ** 32 - 1])
    elif which == 2:
        model.count = rng.choice([n for n in (0, 3, 2 ** 32 - 1, 3 - len(model.directions)) if n != len(model.directions)])
    else:
        model.faces[rng.randrange(2)] = rng.choice([0, 2 ** 28 + 1, 2 ** 32 + 1, 2 ** 64 - 1])
    return BROKEN


def description(rng, model):
    """An unknown value is broken, and a polygon that is not there is of another mesh."""
    if not model.read:
        return None
    one = rng.choice(model.read)
    how = rng.choice(["points", "bodies", "over", "under", "matrix", "count", "ambiguity", "face", "polygon", "polygon"])
    if how == "ambiguity":
        one.ambiguity, one.face = rng.choice([(1e-9, 0), (5e-324, 2 ** 64 - 1), (1e308, 7)])
        return PROVEN
    if how == "polygon":
        corners = rng.choice([4, 5, 9])
        axis = rng.randrange(4)
        triangles = [[0, i - 1, i] for i in range(2, corners)] if axis < 3 else []
        one.polygons = [[rng.choice([0, 1, 2 ** 34]), corners, axis, triangles]]
        if rng.random() < 0.3:
            one.polygons.append([one.polygons[0][0] + 1, 4, 3, []])
        return {1}
    if how == "bodies" and rng.random() < 0.5:
        one.bodies = 1  # which these files do not have
        return PROVEN
    if how == "points" and rng.random() < 0.5:
        one.points = 1  # which files of faces are not
        return BROKEN
    setattr(one, how, rng.choice([2, 3, 2 ** 31]) if how in ("points", "bodies", "matrix", "face") else
            rng.choice([0.0, -1.0, 25.4, math.nan, math.inf]) if how != "count" else rng.choice([1, 2 ** 40, 2 ** 64 - 1]))
    return BROKEN


def polygon_of_bytes(rng, model):
    """Numbers that a polygon cannot have."""
    if not model.read:
        return None
    polygon = rng.choice([[0, 3, 3, []], [0, 0, 3, []], [0, 2 ** 32, 3, []], [0, 4, 4, []], [0, 4, 0, [[0, 1, 2]]],
                          [0, 4, 1, [[0, 1, 4], [0, 2, 3]]], [2 ** 35, 4, 3, []], [0, 2 ** 31, 2, [[0, 1, 2]]]])
    rng.choice(model.read).polygons = [polygon]
    return BROKEN


def face_counts(rng, model):
    x = rng.randrange(2)
    model.faces[x] = max(1, model.faces[x] + rng.choice([-1, 1, 2, 2 ** 27]))
    return NOT_PROVEN if model.faces[x] != model.counts[x] else None


def delta(rng, model):
    """upper was tight, or nearly; no delta of the least size is let through for nothing where the bounds are exact."""
    x = rng.randrange(2)
    old = model.deltas[x]
    model.deltas[x] = rng.choice([0.0, old / 2, nudge(old, math.inf), old * 2, 1.0, 1e308, 5e-324])
    if model.deltas[x] <= old:
        return PROVEN
    return NOT_PROVEN if any(d.upper < sum(model.deltas) for d in model.directions) else ANY


def swap_directions(rng, model):
    if len(model.directions) == 2:
        a, b = model.directions
        model.directions = rng.choice([[b, a], [a, a], [b, b]])
        return ANY


def regroup(rng, model):
    """Other blocks of the same faces."""
    d = rng.choice(model.directions)
    trees, d.blocks = sum(d.blocks, []), []
    while trees:
        count = rng.randrange(1, len(trees) + 1)
        d.blocks.append(trees[:count])
        trees = trees[count:]
    return PROVEN


def lose_face(rng, model):
    trees = rng.choice(rng.choice(model.directions).blocks)
    if rng.random() < 0.5:
        del trees[rng.randrange(len(trees))]
    else:
        trees.append([3, 0])
    return BROKEN


MODELS = [drop_leaf, drop_half, swap_halves, turn_halving, other_op, other_triangle, other_triangle, no_triangle, long_number,
          swap_triangles, move_cut, move_cut, turn_cut, uncut, cut_whole, deep, chain, lower_upper, lower_upper, raise_upper, raise_lower, raise_lower,
          lower_lower, no_number, move_witness, move_witness, no_witness, flip_hash, swap_hashes, header, description, description,
          polygon_of_bytes, face_counts, delta, swap_directions, regroup, lose_face]


# ---- Bytes.

def block_places(model):
    """The starts of blocks."""
    at = 176 + sum(len(read.encode()) for read in model.read)
    for d in model.directions:
        at += 40
        for trees in d.blocks:
            yield at
            at += 8 + len(encode_block(trees, 0, model.cut_bits))


def block_head(rng, model):
    data, at = bytearray(encode(model)), rng.choice(list(block_places(model)))
    faces, size = struct.unpack_from("<II", data, at)
    faces, size = rng.choice([(0, size), (faces + 1, size), (faces - 1, size), (2 ** 32 - 1, size), (faces, size + 1), (faces, size - 1),
                              (faces, 0), (faces, 2 ** 32 - 1), (faces, 2 ** 31), (faces, 2 ** 32 - at - 8), (2 ** 28, 2 ** 32 - 1)])
    struct.pack_into("<II", data, at, faces, size)
    return bytes(data), BROKEN


def empty_block(rng, model):
    data, at = encode(model), rng.choice(list(block_places(model)))
    return data[:at] + bytes(8) + data[at:], BROKEN


def cut_off(rng, model):
    data = encode(model)
    return data[:rng.randrange(len(data))], BROKEN


def more_bytes(rng, model):
    return encode(model) + rng.choice([b"\0", b"\n", bytes(100), rng.randbytes(7), encode(model)[176:]]), BROKEN


def padded(rng, model):
    """A number that is longer than it needs to be."""
    return encode(model, rng.randrange(1, 9)), BROKEN


def flip(rng, model):
    data = bytearray(encode(model))
    for _ in range(rng.choice((1, 1, 1, 2, 5))):
        data[rng.randrange(8, len(data))] ^= 1 << rng.randrange(8)
    return bytes(data), ANY


def flip_late(rng, model):
    """Spoils bytes beyond the header, where the hashes do not show it."""
    data = bytearray(encode(model))
    for _ in range(rng.choice((1, 1, 1, 2, 5))):
        at = rng.randrange(176, len(data))
        data[at] = rng.choice([data[at] ^ 1 << rng.randrange(8), rng.randrange(256), 0, 255, data[at] + 1 & 255])
    return bytes(data), ANY


def shuffle(rng, model):
    """A piece repeated, removed or moved."""
    data = encode(model)
    a, b, c = sorted(rng.randrange(176, len(data) + 1) for _ in range(3))
    return rng.choice([data[:a] + data[b:], data[:b] + data[a:], data[:a] + data[b:c] + data[a:b] + data[c:]]), ANY


BYTES = [block_head, block_head, empty_block, cut_off, more_bytes, padded, flip, flip_late, flip_late, flip_late, shuffle]
