#!/usr/bin/env python3
"""Checks a certificate of a Hausdorff distance: docs/certificate-file.md has the bytes and the argument.

usage: vkh_check.py CERTIFICATE A B
A and B: OBJ, OFF or STL, by the file's ending. They are read as given, so that any delta is good enough.
Exit codes: 0 proven, 1 refused, 2 usage, 4 broken. Arithmetic is of integers and fractions; what is printed is rounded outwards.
"""
import decimal
import hashlib
import math
import pathlib
import struct
import sys
from fractions import Fraction

DEEPEST = 100  # halvings; a cut takes 16 more bits, the witness at most 62 instead


def along(corners, axis):
    return [(p[axis - 2], p[axis - 1]) for p in corners]


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])


def area(ring):
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(ring, ring[1:] + ring[:1]))


def is_across(corners, axis):
    """Whether Newell's normal is at most about 70 degrees off the axis."""
    normal = [abs(area(along(corners, k))) for k in range(3)]
    return 2 * normal[axis] >= max(normal) > 0 < normal[axis]


def is_convex(ring):
    ring = [p for p, before in zip(ring, ring[-1:] + ring[:-1]) if p != before]
    triples = list(zip(ring, ring[1:] + ring[:1], ring[2:] + ring[:2]))
    turns = [turn(*triple) for triple in triples]
    changes = [(a < b) != (b < c) for a, b, c in triples]
    return (any(turns) and not min(turns) < 0 < max(turns) and sum(changes) == 2
            and not any(change and t == 0 for change, t in zip(changes, turns)))


def is_line(corners):
    along_it = next((d for d in (minus(p, corners[0]) for p in corners) if any(d)), (0, 0, 0))
    return not any(any(cross(along_it, minus(p, corners[0]))) for p in corners)


def do_overlap(triangles):
    """Whether two triangles that turn to the left have an inner point in common."""
    def is_outside(a, b):  # b on the outer side of an edge of a
        return any(all(turn(a[i - 1], a[i], p) <= 0 for p in b) for i in range(3))
    order = sorted(triangles, key=lambda t: min(p[0] for p in t))
    for i, a in enumerate(order):
        for b in order[i + 1:]:
            if min(p[0] for p in b) >= max(p[0] for p in a):
                break
            if not is_outside(a, b) and not is_outside(b, a):
                return True
    return False


def do_tile(ring, triangles):
    """Triangles that turn to one side, whose edges add up to the outline, cover a point as often as that winds round it."""
    side, count, edges = (area(ring) > 0) - (area(ring) < 0), len(ring), {}
    for corners, sign in [*((t, 1) for t in triangles), (range(count), -1)]:
        for a, b in zip(corners, [*corners[1:], corners[0]]):
            edges[min(a, b), max(a, b)] = edges.get((min(a, b), max(a, b)), 0) + (sign if a < b else -sign if a > b else 0)
    turns = [side * turn(*(ring[i] for i in t)) for t in triangles]
    solid = [[ring[i] for i in t][::side] for t, turned in zip(triangles, turns) if turned > 0]
    return side != 0 and min(turns) >= 0 and not any(edges.values()) and not do_overlap(solid)


class Other(ValueError):
    """Well formed, but not of these files."""


class Points(dict):
    """Stated triangles of a mesh that was read as points alone: there should be none."""


def triangles_of(points, polygons, given):
    """The triangles of each face; `given` states those of faces that are not the fan of a convex
    one; None states no face's. Points are triangles whose three corners are one."""
    if isinstance(given, Points) == bool(polygons):
        raise ValueError("points have faces" if polygons else "there is no face")
    if isinstance(given, Points):
        if given:
            raise Other("there are no such polygons")
        return [(p, p, p) for p in points]
    if any(len(polygon) < 3 or min(polygon) < 0 for polygon in polygons):
        raise ValueError("a face has fewer than three corners, or a corner that is not there")
    out, left = [], dict(given or {})
    for face, polygon in enumerate(polygons):
        fan = [(0, n - 1, n) for n in range(2, len(polygon))]
        if len(polygon) > 3:
            corners = [tuple(map(Fraction, points[i])) for i in polygon]
            count, axis, listed = left.pop(face, (len(polygon), None, fan))
            if count != len(polygon):
                raise Other(f"face {face} has another number of corners")
            if axis is None and not any(is_across(corners, k) and is_convex(along(corners, k)) for k in range(3)) and not is_line(corners):
                raise ValueError(f"face {face} is not convex: this certificate does not say its triangles") if given is None else Other(
                    f"face {face} is not convex, and its triangles are not said")
            if axis in (0, 1, 2) and not (is_across(corners, axis) and do_tile(along(corners, axis), listed)):
                raise Other(f"face {face} is not tiled by its triangles")
            fan = fan if axis == 3 else listed
        out += [tuple(points[polygon[i]] for i in t) for t in fan]
    if left:
        raise Other("there are no such polygons")
    return out


def read_obj(data):
    points, polygons = [], []
    for line in data.decode("ascii", "replace").replace("\\\n", " ").replace("\\\r\n", " ").split("\n"):
        words = line.split("#")[0].split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            polygons.append([n - 1 if n >= 0 else n + len(points) for n in (int(word.split("/")[0]) for word in words[1:])])
    return points, polygons


def read_off(data):
    rows = list(filter(None, (line.split("#")[0].split() for line in data.decode("ascii", "replace").split("\n"))))
    if rows[0].pop(0) != "OFF":
        raise ValueError("not an OFF file of plain vertices")
    rows = list(filter(None, rows))
    vertices, faces = int(rows[0][0]), int(rows[0][1])
    polygons = [list(map(int, rows[1 + vertices + i])) for i in range(faces)]
    return [tuple(map(float, row[:3])) for row in rows[1:1 + vertices]], [row[1:1 + row[0]] for row in polygons]


def read_stl(data):
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        points = [p for f in struct.iter_unpack("<12x9f2x", data[84:]) for p in (f[0:3], f[3:6], f[6:9])]
        return points, [(i, i + 1, i + 2) for i in range(0, len(points), 3)]
    words = data.decode("ascii", "replace").split()
    points = [tuple(map(float, words[i + 1:i + 4])) for i, word in enumerate(words) if word == "vertex"]
    return points, [(i, i + 1, i + 2) for i in range(0, len(points), 3)]


def read_mesh(path, given):
    try:
        data = pathlib.Path(path).read_bytes()
        faces = triangles_of(*{"obj": read_obj, "off": read_off, "stl": read_stl}[path.rsplit(".", 1)[-1].lower()](data), given)
        corners = [Fraction(p[i]) for face in faces for p in face for i in range(3)]  # raises if it is NaN or infinity
    except Other as other:
        raise Other(f"{path}: {other}") from None
    except Exception as error:
        raise ValueError(f"{path}: cannot be read: {error!r}") from None
    flat = struct.pack(f"<{len(corners)}d", *corners)  # -0 has become 0
    return faces, max((x.denominator for x in corners), default=1), hashlib.sha256(data).digest(), hashlib.sha256(flat).digest()


def placed(mesh, place):
    """A mesh's faces where a certificate puts them, x at M (p / q x), and a common denominator of their coordinates."""
    faces, denominator = mesh[:2]
    if place in (None, (1, None)):
        return faces, denominator
    factor, rows = place
    rows = [list(map(Fraction, row)) for row in rows or ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0))]
    def put(p):
        x = [factor * Fraction(c) for c in p]
        return tuple(row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3] for row in rows)
    faces = [tuple(map(put, face)) for face in faces]
    return faces, math.lcm(*{c.denominator for face in faces for p in face for c in p})


def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def from_segment(p, a, b):
    ab, ap, bp = minus(b, a), minus(p, a), minus(p, b)
    along, square = dot(ap, ab), dot(ab, ab)
    return Fraction(dot(ap, ap) if along <= 0 else dot(bp, bp) if along >= square else dot(ap, ap) - Fraction(along * along, square))


def from_triangle(p, triangle):
    """The square of the distance of a point from a triangle, all of integers: a fraction."""
    a, b, c = triangle
    normal = cross(minus(b, a), minus(c, a))
    edges = (a, b), (b, c), (c, a)
    if any(normal) and all(dot(cross(normal, minus(v, u)), minus(p, u)) >= 0 for u, v in edges):
        return Fraction(dot(normal, minus(p, a)) ** 2, dot(normal, normal))
    return min(from_segment(p, u, v) for u, v in edges)  # without a normal these are all of it


def digits(value, up):
    """A fraction as a decimal: not less than it where up, else not more."""
    context = decimal.Context(18, decimal.ROUND_CEILING if up else decimal.ROUND_FLOOR)
    return context.divide(decimal.Decimal(value.numerator), decimal.Decimal(value.denominator))


def root(square, up):
    return Fraction(math.isqrt(square * 4 ** 1300 // 1) + up, 2 ** 1300)


class Certificate:
    def __init__(self, data, paths, reader=read_mesh):
        self.data, self.at, self.refusal, self.said = data, 0, "", []
        magic, directions, zero, *counts = self.take("<8sIIQQdd")
        self.faces, deltas, hashes = counts[:2], counts[2:], self.take("<32s32s32s32s")
        self.cut_bits = {b"VHCERT01": 8, b"VHCERT02": 16}.get(magic)
        self.need(self.cut_bits and directions in (1, 2) and zero == 0 and all(1 <= n <= 1 << 28 for n in self.faces)
                  and all(0 <= d < math.inf and math.copysign(1, d) == 1 for d in deltas), "the header")
        self.delta = sum(map(Fraction, deltas))
        given, places = zip(*[self.description() if self.cut_bits == 16 else (None, None) for _ in paths])
        fans = [sum(axis == 3 for _, axis, _ in (one or {}).values()) for one in given]
        meshes = [self.read(reader, path, one) for path, one in zip(paths, given)]
        for (faces, _, of_file, of_corners), count, file_hash, corner_hash in zip(meshes, self.faces, hashes, hashes[2:]):
            self.hold(len(faces) == count and corner_hash == of_corners and file_hash in (bytes(32), of_file), "it is of another mesh")
        meshes = [placed(mesh, place) for mesh, place in zip(meshes, places)]
        self.scale = math.lcm(*(denominator for _, denominator in meshes)) << DEEPEST + 16  # all points become integers
        self.scaled = [[[tuple(int(Fraction(x) * self.scale) for x in p) for p in face] for face in faces] for faces, _ in meshes]
        for x in range(directions):
            self.direction(x, 1 - x)
        self.need(self.at == len(data), "bytes after the end")
        self.said += [f"  {name}: {count} polygon{'s' * (count > 1)} as a fan of corners, whatever that covers" for name, count in zip("AB", fans) if count]

    def need(self, holds, what):
        if not holds:
            raise ValueError(f"not well formed at byte {self.at}: {what}")

    def hold(self, holds, what):
        self.refusal = self.refusal or ("" if holds else what)

    def take(self, form):
        self.at += struct.calcsize(form)
        self.need(self.at <= len(self.data), "it ends early")
        return struct.unpack_from(form, self.data, self.at - struct.calcsize(form))

    def description(self):
        """The reading of a mesh: the triangles of its polygons, by their faces."""
        points, bodies, ambiguity, at, over, under, matrix = self.take("<IIdQddQ")
        self.need(points < 2 and matrix < 2 and bodies < 2, "points, bodies or a matrix of no kind")
        self.need(all(1 <= n <= 1 << 53 and n == int(n) for n in (over, under)), "a unit")
        self.need(0 <= ambiguity < math.inf and math.copysign(1, ambiguity) == 1 and (ambiguity or not at), "an ambiguity")
        rows = [self.take("<4d") for _ in range(3)] if matrix else None
        self.need(all(math.isfinite(x) and (x or math.copysign(1, x) == 1) for row in rows or () for x in row), "a matrix")
        given, face, (count,) = Points() if points else {}, -1, self.take("<Q")
        for _ in range(count):
            face += 1 + self.count()
            corners, axis = self.count(), self.count()
            self.need(4 <= corners < 1 << 32 and axis <= 3, "a polygon")
            self.need(axis == 3 or 3 * (corners - 2) <= len(self.data) - self.at, "a triangulation that ends early")
            places = [] if axis == 3 else [self.count() for _ in range(3 * (corners - 2))]
            self.need(all(i < corners for i in places), "a corner that is not there")
            given[face] = corners, axis, list(zip(places[0::3], places[1::3], places[2::3]))
        return given, (Fraction(over) / Fraction(under), rows)

    def read(self, reader, path, given):
        try:
            return reader(path, given)
        except Other as other:
            self.hold(False, str(other))
            return [], 1, b"", b""

    def direction(self, x, y):
        lower, upper, face, e, j, k = self.take("<ddIIQQ")
        self.need(0 <= lower <= upper < math.inf and math.copysign(1, lower) == math.copysign(1, upper) == 1, "the bounds")
        self.need(face < self.faces[x] and e <= 62 and j + k <= 1 << e and (lower > 0 or face == e == j == k == 0), "the witness")
        self.hold(upper >= self.delta, "upper is less than the deltas")
        self.reach, self.farthest = ((Fraction(upper) - self.delta) * self.scale) ** 2, Fraction(0)
        done = 0
        while done < self.faces[x]:
            count, size = self.take("<II")
            end, self.number_before = self.at + size, 0
            self.need(1 <= count <= self.faces[x] - done and end <= len(self.data), "a block")
            for i in range(done, done + count):
                self.part([(0, 0, 0)] * 3 if self.refusal else self.scaled[x][i], 0, y)
            self.need(self.at == end, "a block's length")
            done += count
        self.nearest = Fraction(0)
        if lower > 0 and not self.refusal:
            witness = [((1 << e) - j - k) * a + j * b + k * c >> e for a, b, c in zip(*self.scaled[x][face])]
            self.nearest = min(from_triangle(witness, triangle) for triangle in self.scaled[y])
            self.hold(self.nearest >= ((Fraction(lower) + self.delta) * self.scale) ** 2, "the witness is too near")
        name, bounds = "h(B,A)" if x else "h(A,B)", (Fraction(lower), Fraction(upper))
        best = root(self.nearest / self.scale ** 2, False) - self.delta, root(self.farthest / self.scale ** 2, True) + self.delta
        self.said += [f"{word}: {digits(max(low, Fraction(0)), False)} <= {name} <= {digits(high, True)}"
                      for word, (low, high) in (("proven", bounds), ("  at best", best))]

    def number(self, y):
        code = self.count()
        self.number_before += -(code // 2) - 1 if code % 2 else code // 2
        self.need(0 <= self.number_before < self.faces[y], "a triangle that is not there")
        return self.number_before

    def count(self):
        code, shift, byte = 0, 0, 128
        while byte >= 128:
            byte, = self.take("<B")
            self.need(shift < 35 and (byte or not shift), "a number of more than five bytes, or of more than it takes")
            code, shift = code | (byte & 127) << shift, shift + 7
        return code

    def part(self, v, depth, y):
        op, = self.take("<B")
        self.need(op <= 6 and (op >= 3 or depth < DEEPEST), "a part")
        i, j, k = ((op - 4 * (op > 3) + n) % 3 for n in range(3))
        if op < 3:
            middle = tuple((a + b) // 2 for a, b in zip(v[j], v[k]))
            for replaced in (k, j):
                self.part([middle if n == replaced else v[n] for n in range(3)], depth + 1, y)
        elif op == 3:
            self.near(v, y, self.number(y))
        else:
            first, second, (s, t) = self.number(y), self.number(y), self.take("<BB" if self.cut_bits == 8 else "<HH")
            p = tuple(a + s * (b - a) // 2 ** self.cut_bits for a, b in zip(v[i], v[j]))
            q = tuple(a + t * (b - a) // 2 ** self.cut_bits for a, b in zip(v[i], v[k]))
            self.near([v[i], p, q], y, first)
            self.near([p, q, v[j], v[k]], y, second)

    def near(self, points, y, number):
        for p in [] if self.refusal else points:
            self.farthest = max(self.farthest, from_triangle(p, self.scaled[y][number]))
            self.hold(self.farthest <= self.reach, f"byte {self.at}: a corner is too far from triangle {number}")


def checked(path, path_a, path_b):
    try:
        certificate = Certificate(pathlib.Path(path).read_bytes(), (path_a, path_b))
    except (ValueError, OSError) as error:
        return 4, f"broken: {error}"
    return (1, f"refused: {certificate.refusal}") if certificate.refusal else (0, "\n".join(certificate.said))


if __name__ == "__main__":
    exit_code, answer = checked(*sys.argv[1:]) if len(sys.argv) == 4 else (2, __doc__)
    print(answer, file=sys.stderr if exit_code else sys.stdout)
    sys.exit(exit_code)
