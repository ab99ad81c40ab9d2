"""Triangulations of polygons in certificates: both checkers accept exactly the ones that tile the outline.

usage: polygons_test.py [--cases N] [--seed S] [unittest's own]
VKH_CHECK is the program; without it vkh_check.py alone is asked. What is so is found in another way than by the checkers:
triangles' areas in common by clipping, and winding numbers by a ray.
"""

import argparse
import os
import random
import sys
import tempfile
import unittest
from fractions import Fraction

import make_certificate
import pairs
from checkers import PROGRAM, Checkers

KEEP = os.environ.get("VKH_ATTACK_KEEP", os.path.join(tempfile.gettempdir(), "vkh_polygons"))
OPTIONS = argparse.Namespace(cases=400, seed=1)
OTHER = [((0.0, 0.0, 40.0), (1.0, 0.0, 40.0), (0.0, 1.0, 40.0))]


# ---- Outlines of integers.

def star(rng):
    """A simple outline, since angles rise; corners on a coarse grid may meet."""
    count, around = rng.randrange(4, 12), [(4, 0), (4, 2), (3, 3), (2, 4), (0, 4), (-2, 4), (-3, 3), (-4, 2), (-4, 0), (-4, -2), (-3, -3),
                                           (-2, -4), (0, -4), (2, -4), (3, -3), (4, -2)]
    return [tuple(x * rng.choice((1, 1, 2, 4)) for x in around[i]) for i in sorted(rng.sample(range(16), count))]


def anything(rng):
    return [(rng.randrange(-4, 5), rng.randrange(-4, 5)) for _ in range(rng.randrange(4, 8))]


def plate(rng):
    """An outline with a hole, to which an edge leads and back."""
    x, y = rng.randrange(2, 5), rng.randrange(2, 5)
    hole = [(x, y), (x, y + 2), (x + 2, y + 2), (x + 2, y)]
    return [(0, 0), (9, 0), (9, 9), (0, 9), (0, 0), *hole, hole[0]]


def spiral(rng):
    """An outline that overlaps itself if the last turn is wide."""
    wide = rng.choice((2, 5))
    return [(0, 0), (6, 0), (6, 6), (-2, 6), (-2, -2), (4, -2), (4, wide), (1, wide)][:rng.randrange(5, 9)]


def with_straight_corners(ring, rng):
    out = []
    for p, q in zip(ring, ring[1:] + ring[:1]):
        out.append(p)
        if rng.random() < 0.2:
            out.append(tuple(Fraction(a + b, 2) for a, b in zip(p, q)))
        if rng.random() < 0.1:
            out.append(p)
    return out


def outline(rng):
    ring = rng.choice((star, star, anything, plate, spiral))(rng)
    ring = with_straight_corners(ring, rng)
    return ring[::-1] if rng.random() < 0.5 else ring


# ---- Triangulations.

def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def area(ring):
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(ring, ring[1:] + ring[:1]))


def clipped(ring, rng):
    """Ears in any order that turn to the outline's side and have no corner strictly inside: often tiles, not always."""
    side, left, out = (area(ring) > 0) - (area(ring) < 0), list(range(len(ring))), []
    while len(left) > 3:
        ears = []
        for n in range(len(left)):
            t = left[n - 1], left[n], left[(n + 1) % len(left)]
            a, b, c = (ring[i] for i in t)
            inside = [i for i in left if i not in t and all(side * turn(p, q, ring[i]) > 0 for p, q in ((a, b), (b, c), (c, a)))]
            if side * turn(a, b, c) >= 0 and not inside:
                ears.append((side * turn(a, b, c) == 0, rng.random(), t))
        if not ears:
            return by_chance(ring, rng)
        t = min(ears)[2]
        out.append(t)
        left.remove(t[1])
    return [*out, tuple(left)]


def by_chance(ring, rng):
    """A triangulation whose edges add up, but which may cover anything."""
    left, out = list(range(len(ring))), []
    while len(left) > 3:
        n = rng.randrange(len(left))
        out.append((left[n - 1], left[n], left[(n + 1) % len(left)]))
        del left[n]
    return [*out, tuple(left)]


def spoiled(triangles, count, rng):
    triangles = [list(t) for t in triangles]
    how, t = rng.randrange(4), rng.choice(triangles)
    if how == 0:
        t[rng.randrange(3)] = rng.randrange(count)
    elif how == 1:
        t.reverse()
    elif how == 2:
        triangles[rng.randrange(len(triangles))] = list(rng.choice(triangles))
    else:
        n = rng.randrange(3)
        t[:] = t[n:] + t[:n]
    return [tuple(t) for t in triangles]


# ---- The truth.

def common_area(a, b):
    """The common area of two triangles that turn to the left: b, clipped by the edges of a."""
    ring = list(b)
    for p, q in zip(a, a[1:] + a[:1]):
        out = []
        for u, v in zip(ring, ring[1:] + ring[:1]):
            x, y = turn(p, q, u), turn(p, q, v)
            if x >= 0:
                out.append(u)
            if x * y < 0:
                out.append(tuple(s + (e - s) * Fraction(x) / (x - y) for s, e in zip(u, v)))
        ring = out
        if not ring:
            return 0
    return abs(area(ring))


def winding(ring, p):
    """The winding number of a point on no edge."""
    count = 0
    for a, b in zip(ring, ring[1:] + ring[:1]):
        if (a[1] <= p[1]) != (b[1] <= p[1]):
            side = turn(a, b, p)
            count += (side > 0) if b[1] > a[1] else -(side < 0)
    return count


def tiles(ring, triangles, rng):
    """Whether it tiles, exactly, except that random points are tried in place of all."""
    side = (area(ring) > 0) - (area(ring) < 0)
    if side == 0:
        return False
    turned = [[ring[i] for i in t][::side] for t in triangles]
    if any(turn(*t) < 0 for t in turned):
        return False
    solid = [t for t in turned if turn(*t) > 0]
    if sum(turn(*t) for t in solid) != abs(area(ring)) or any(common_area(a, b) for i, a in enumerate(solid) for b in solid[:i]):
        return False
    points = [tuple(sum(p[k] for p in t) / Fraction(3) + Fraction(1, 10 ** 6 + 3) for k in range(2)) for t in solid]
    points += [tuple(Fraction(rng.randrange(-10 ** 6, 10 ** 6), 99991) for _ in range(2)) for _ in range(40)]
    return all(abs(winding(ring, p)) == sum(all(turn(a, b, p) > 0 for a, b in zip(t, t[1:] + t[:1])) for t in solid) for p in points)


def do_edges_meet(count, triangles):
    """Whether each edge of the outline occurs once, and all others in both directions equally
    often."""
    edges = [(t[n - 1], t[n]) for t in triangles for n in range(3) if t[n - 1] != t[n]] + [((n + 1) % count, n) for n in range(count)]
    return all(edges.count(edge) == edges.count(edge[::-1]) for edge in edges)


class Case:
    """A polygon in space, whose corners may lie off its plane."""

    def __init__(self, rng):
        self.rng, self.ring, self.axis = rng, outline(rng), rng.randrange(3)
        heights = [rng.choice((0, 0, 1)) * Fraction(rng.randrange(-8, 9), 64) if rng.random() < 0.5 else 0 for _ in self.ring]
        self.corners = [self.placed(p, height) for p, height in zip(self.ring, heights)]
        self.triangles = rng.choice((clipped, clipped, clipped, by_chance))(self.ring, rng)
        if rng.random() < 0.3:
            self.triangles = spoiled(self.triangles, len(self.ring), rng)

    def placed(self, p, height):
        out = [0.0, 0.0, 0.0]
        out[(self.axis + 1) % 3], out[(self.axis + 2) % 3], out[self.axis] = float(p[0]), float(p[1]), float(height)
        return tuple(out)

    def obj(self):
        rows = ["v " + " ".join(map(repr, p)) for p in self.corners] + ["v 9 9 9", f"f 1 2 {len(self.corners) + 1}"]
        return "\n".join([*rows, "f " + " ".join(str(i + 1) for i in range(len(self.corners))), ""]).encode()

    def mesh(self, triangles):
        first = (self.corners[0], self.corners[1], (9.0, 9.0, 9.0))
        return [first] + [tuple(self.corners[i] for i in t) for t in triangles]

    def certificate(self, triangles, polygons):
        model = make_certificate.make(self.mesh(triangles), OTHER, self.rng, parts=3)
        model.read[0].polygons = polygons
        return make_certificate.encode(model)


class Cases(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.checkers = Checkers(folder.name, KEEP)

    def settle(self):
        self.assertEqual(self.checkers.faults[:5], [], f"{len(self.checkers.faults)} faults")

    def ask(self, case, triangles, polygons, expected, what):
        self.checkers.ask(case.certificate(triangles, polygons), expected, f"{what}: {case.ring}, {triangles}")

    def test_triangulations(self):
        good = 0
        for n in range(OPTIONS.cases):
            case = Case(random.Random(f"{OPTIONS.seed} {n}"))
            count, fan = len(case.ring), [(0, i - 1, i) for i in range(2, len(case.ring))]
            self.checkers.meshes(case.obj(), pairs.obj(OTHER))
            is_good = do_edges_meet(count, case.triangles) and tiles(case.ring, case.triangles, case.rng)
            good += is_good
            self.ask(case, case.triangles, [[1, count, case.axis, case.triangles]], {0} if is_good else {1}, "triangles")
            self.ask(case, fan, [[1, count, 3, []]], {0}, "only the fan")
            self.ask(case, case.triangles, [[0, count, case.axis, case.triangles]], {1}, "of a triangle")
            self.ask(case, case.triangles, [[1, count + 1, case.axis, [*case.triangles, (0, 0, 0)]]], {1}, "one too many")
            if not tiles(case.ring, fan, case.rng) and area(case.ring) != 0:
                self.ask(case, fan, [], {1}, "a fan that is not said")
        print(f"{OPTIONS.cases} polygons, {good} of them tiled; {self.checkers.count} certificates; {PROGRAM or 'vkh_check.py alone'}", flush=True)
        self.assertGreater(good, OPTIONS.cases // 5)
        self.settle()

    def test_convex_ones_need_not_be_said(self):
        rng = random.Random(3)
        for ring in ([(0, 0), (4, 0), (4, 4), (0, 4)], [(0, 0), (2, 0), (4, 0), (4, 4), (2, 4), (0, 4), (0, 2)], [(0, 0), (1, 1), (3, 3), (2, 2)],
                     [(0, 0), (4, 0), (4, 0), (4, 4), (0, 0)]):
            case = Case(rng)
            case.ring, case.corners = ring, [case.placed(p, 0) for p in ring]
            self.checkers.meshes(case.obj(), pairs.obj(OTHER))
            self.ask(case, [(0, i - 1, i) for i in range(2, len(ring))], [], {0}, "convex")
        self.settle()

    def test_along_the_surface(self):
        """Seen along itself a face is nearly nothing, and any triangles would tile that."""
        case = Case(random.Random(4))
        flat = [(0, 0), (8, 0), (8, 8), (0, 8), (0, 7), (7, 7), (7, 1), (0, 1)]
        case.ring, case.corners = flat, [(float(x), float(y), 0.0 if x + y < 16 else 0.125) for x, y in flat]
        case.corners[0] = (0.0, 0.0, 0.125)
        self.checkers.meshes(case.obj(), pairs.obj(OTHER))
        for axis in (0, 1):
            for triangles in [by_chance(flat, random.Random(n)) for n in range(200)]:
                self.ask(case, triangles, [[1, 8, axis, triangles]], {1}, "along the surface")
        self.settle()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--cases", type=int, default=OPTIONS.cases)
    parser.add_argument("--seed", type=int, default=OPTIONS.seed)
    OPTIONS, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest])
