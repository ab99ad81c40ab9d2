"""Triangles and maps with coordinates that floats hold exactly, so that a mesh has one right answer."""

import struct

TURNS = [((1, 0, 0), (0, 1, 0), (0, 0, 1)), ((0, -1, 0), (1, 0, 0), (0, 0, 1)), ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
         ((-1, 0, 0), (0, -1, 0), (0, 0, 1))]


def random_triangles(random, count):
    return [tuple(tuple(random.randint(0, 18) / 2 for _ in range(3)) for _ in range(3)) for _ in range(count)]


def affine(random, turn=None):
    """(rows of a turn by right angles and a scale, translation): far enough that no two places are one."""
    scale = random.choice((0.5, 1, 1, 2))
    rows = tuple(tuple(scale * x for x in row) for row in (random.choice(TURNS) if turn is None else turn))
    return rows, tuple(float(random.randint(-400, 400)) for _ in range(3))


def compose(outer, inner):
    if outer is None or inner is None:
        return inner if outer is None else outer
    rows = tuple(tuple(sum(outer[0][r][k] * inner[0][k][c] for k in range(3)) for c in range(3)) for r in range(3))
    return rows, _point(outer, inner[1])


def moved(place, triangle):
    return triangle if place is None else tuple(_point(place, corner) for corner in triangle)


def stl(triangles):
    rows = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for corner in t for x in corner), 0) for t in triangles)
    return b"\0" * 80 + struct.pack("<I", len(triangles)) + rows


def _point(place, p):
    return tuple(sum(place[0][r][k] * p[k] for k in range(3)) + place[1][r] for r in range(3))
