"""Small pairs of meshes that are awkward to measure: lists of faces of three corners of three doubles."""

import struct


def point(rng, size=1.0):
    return tuple(rng.uniform(-size, size) for _ in range(3))


def soup(rng):
    return [tuple(point(rng) for _ in range(3)) for _ in range(rng.randrange(1, 5))]


def tetrahedron(rng):
    a, b, c, d = (point(rng) for _ in range(4))
    return [(a, b, c), (a, c, d), (a, d, b), (b, d, c)][:rng.randrange(1, 5)]


def lattice(rng):
    """Many equal distances, and faces that are edges or points."""
    return [tuple(tuple(float(rng.randrange(-1, 2)) for _ in range(3)) for _ in range(3)) for _ in range(rng.randrange(1, 5))]


def needles(rng):
    out = []
    for _ in range(rng.randrange(1, 4)):
        a, b = point(rng), point(rng)
        out.append((a, b, tuple((x + y) / 2 + rng.uniform(-1, 1) * 2.0 ** -rng.randrange(10, 60) for x, y in zip(a, b))))
    return out


def degenerate(rng):
    a, b = point(rng), point(rng)
    return [(a, a, a), (a, b, a), (a, b, tuple(2 * y - x for x, y in zip(a, b)))][:rng.randrange(1, 4)]


def flat(rng):
    return [tuple((rng.uniform(-1, 1), rng.uniform(-1, 1), 0.25) for _ in range(3)) for _ in range(rng.randrange(1, 4))]


def quad(rng):
    """A convex mesh of two triangles."""
    w, h, z = rng.uniform(0.2, 2), rng.uniform(0.2, 2), rng.uniform(-1, 1)
    a, b, c, d = (0.0, 0.0, z), (w, 0.0, z), (w, h, z), (0.0, h, z)
    return [(a, b, c), (a, c, d)] if rng.random() < 0.5 else [(b, c, d), (b, d, a)]


def grid(rng):
    n, z = rng.randrange(1, 3), rng.uniform(-0.1, 0.1)
    corners = [[(i / n, j / n, rng.uniform(-0.1, 0.1) + z) for j in range(n + 1)] for i in range(n + 1)]
    return [f for i in range(n) for j in range(n) for f in (
        (corners[i][j], corners[i + 1][j], corners[i + 1][j + 1]), (corners[i][j], corners[i + 1][j + 1], corners[i][j + 1]))]


def one(rng):
    return [tuple(point(rng) for _ in range(3))]


KINDS = [soup, tetrahedron, lattice, needles, degenerate, flat, quad, grid, one]
CONVEX = [quad, one]  # as a whole
SCALES = [1e-300, 1e300, 2.0 ** -1060, 1e-160, 1e160, 3e5, 2.0 ** 52]


def apart(mesh, shift, scale):
    return [tuple(tuple((x + s) * scale for x, s in zip(p, shift)) for p in face) for face in mesh]


def pair(rng):
    """A, B, whether A and whether B is convex, and the chosen kinds."""
    kinds = rng.choice(KINDS), rng.choice(KINDS)
    a, b = (kind(rng) for kind in kinds)
    if rng.random() < 0.1:
        b, kinds = list(a), (kinds[0], kinds[0])  # h is 0
    elif rng.random() < 0.2 and a and b:
        b = b + [(a[0][0], a[0][1], b[0][2])]  # shared corners
        kinds = kinds[0], soup
    scale = rng.choice(SCALES) if rng.random() < 0.15 else 1.0
    b = apart(b, (0.0, 0.0, rng.choice((0.0, 0.0, 0.5, 1e-9))), 1.0)
    a, b = apart(a, (0, 0, 0), scale), apart(b, (0, 0, 0), scale)
    if rng.random() < 0.3:
        b = [tuple(tuple(x or -x for x in p) for p in face) for face in b]  # -0
    # Rounding keeps a rectangle along the axes one, though it may get thinner.
    return a, b, kinds[0] in CONVEX, kinds[1] in CONVEX, f"{kinds[0].__name__}/{kinds[1].__name__} x {scale:g}"


def obj(mesh, shared=False):
    """Corners one by one, or as few as there are, counted from the end."""
    lines, index = [], {}
    for face in mesh:
        for p in face:
            if not shared or p not in index:
                index[p] = len(index) if shared else 0
                lines.append("v {!r} {!r} {!r}\n".format(*p))
    for i, face in enumerate(mesh):
        numbers = [index[p] - len(index) for p in face] if shared else range(3 * i + 1, 3 * i + 4)
        lines.append("f {}/1 {}//2 {}/1/3\n".format(*numbers))
    return "".join(lines).encode()


def off(mesh):
    lines = ["OFF # one per corner\n", f"{3 * len(mesh)} {len(mesh)} 0\n"]
    lines += ["{!r} {!r} {!r}\n".format(*p) for face in mesh for p in face]
    lines += [f"3 {3 * i} {3 * i + 1} {3 * i + 2}\n" for i in range(len(mesh))]
    return "".join(lines).encode()


def stl(mesh):
    rows = [struct.pack("<12f", 0, 0, 0, *(x for p in face for x in p)) + bytes(2) for face in mesh]
    return bytes(80) + struct.pack("<I", len(mesh)) + b"".join(rows)


def text_stl(mesh):
    lines = ["solid x\n"]
    for face in mesh:
        lines.append("facet normal 0 0 0\nouter loop\n")
        lines += ["vertex {!r} {!r} {!r}\n".format(*p) for p in face]
        lines.append("endloop\nendfacet\n")
    return "".join([*lines, "endsolid x\n"]).encode()
