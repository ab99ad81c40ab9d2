"""The truth about small meshes: exact squares of distances, and bounds of h, by another formulation than the checkers'."""

import heapq
import itertools
import math
from fractions import Fraction

SPARE = 120  # bits: with these, halvings, cuts and parts of witnesses stay integers


def scaled(*meshes):
    """The meshes with integers for doubles, and the factor."""
    numbers = [Fraction(x) for mesh in meshes for face in mesh for p in face for x in p]
    unit = max(x.denominator for x in numbers) << SPARE
    return [[tuple(tuple(int(Fraction(x) * unit) for x in p) for p in face) for face in mesh] for mesh in meshes], unit


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def square(p, triangle):
    """The square of the distance: the least of the projections to corners, edges and plane that are on the
    triangle."""
    from_corner = [tuple(x - y for x, y in zip(p, v)) for v in triangle]
    edges = [tuple(x - y for x, y in zip(triangle[(i + 1) % 3], triangle[i])) for i in range(3)]
    found = [Fraction(dot(f, f)) for f in from_corner]
    for f, e in zip(from_corner, edges):
        along, length = dot(f, e), dot(e, e)
        if 0 < along < length:
            found.append(dot(f, f) - Fraction(along * along, length))
    f, u, v = from_corner[0], edges[0], tuple(-x for x in edges[2])
    uu, uv, vv, fu, fv = dot(u, u), dot(u, v), dot(v, v), dot(f, u), dot(f, v)
    area = uu * vv - uv * uv
    s, t = vv * fu - uv * fv, uu * fv - uv * fu
    if area > 0 and s >= 0 and t >= 0 and s + t <= area:
        found.append(dot(f, f) - Fraction(s * fu + t * fv, area))
    return min(found)


def double_beyond(number, is_enough, up):
    """The nearest double on this side of a number that is enough; None if there is none. All beyond it are enough."""
    try:
        value = float(number)
    except OverflowError:
        return None
    away, back = (math.inf, 0.0) if up else (0.0, math.inf)
    while not is_enough(value):
        if value == away:
            return None
        value = math.nextafter(value, away)
        if math.isinf(value):
            return None
    while value != back and math.isfinite(math.nextafter(value, back)) and is_enough(math.nextafter(value, back)):
        value = math.nextafter(value, back)
    return value


def near_root(number):
    return Fraction(math.isqrt(int(number * (1 << 2600))), 1 << 1300)


def upper_double(number, delta=Fraction(0)):
    """The least double u with (u - delta)^2 not less than a number."""
    return double_beyond(near_root(number) + delta, lambda u: u >= delta and (Fraction(u) - delta) ** 2 >= number, True)


def lower_double(number, delta=Fraction(0)):
    """The largest double l with (l + delta)^2 not more than a number; 0 if there is none."""
    if delta * delta > number:
        return 0.0
    return double_beyond(max(near_root(number) - delta, 0), lambda l: (Fraction(l) + delta) ** 2 <= number, False) or 0.0


class Pair:
    """The bounds of h(X,Y), as squares. A convex Y has its farthest point of a triangle at a corner."""

    def __init__(self, x, y, is_convex, budget=400):
        (x, self.y), unit = scaled(x, y)
        self.unit, self.known = Fraction(unit) ** 2, {}
        self.low = max(min(self.of(p)) for face in x for p in face)
        counter = itertools.count()
        heap = []

        def push(face):
            bound = max(min(self.of(p)) for p in face) if is_convex else min(map(max, zip(*map(self.of, face))))
            heapq.heappush(heap, (-bound, next(counter), face))

        for face in x:
            push(face)
        while budget > 0 and -heap[0][0] > self.low:
            budget -= 1
            a, b, c = heapq.heappop(heap)[2]
            if any((i + j) % 2 for u, v in ((a, b), (b, c), (c, a)) for i, j in zip(u, v)):
                push((a, b, c))  # no more bits
                break
            ab, bc, ca = (tuple((i + j) // 2 for i, j in zip(u, v)) for u, v in ((a, b), (b, c), (c, a)))
            self.low = max(self.low, *(min(self.of(p)) for p in (ab, bc, ca)))
            for face in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)):
                push(face)
        self.low, self.high = self.low / self.unit, max(self.low, -heap[0][0]) / self.unit

    def of(self, p):
        if p not in self.known:
            self.known[p] = [square(p, face) for face in self.y]
        return self.known[p]

    def refutes(self, lower, upper):
        """Whether the claim is wrong for sure."""
        return Fraction(lower) ** 2 > self.high or Fraction(upper) ** 2 < self.low
