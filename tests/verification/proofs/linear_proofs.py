"""The theorems about two_float.h and its compositions, each an error analysis of statements of the
headers (linear.py).

A bound is in units of kUlp^2, a quarter of kUlp2. CLAIMS has the results that Gappa shows, as a
basis for the templates.
"""

from fractions import Fraction

from claims import CLAIMS, claim
from linear import FLUSH, LOW, ULP, Pair, Unit, both_sides, constant, exact_input, number, script, weight
from proof import Proof, Weakened

SQUARE = ULP * ULP
# The effect of flushes on results of two_difference, two_combination and two_dot of inputs up to 4: under the square of
# kTiny.
FLUSHED = FLUSH * 2**10

NOTHING = Pair(constant(0), constant(0))


def stored(unit, x):
    """A coordinate as host/mesh/frame.cpp stores it: both parts rounded to nearest."""
    if unit.flush or x == 0:
        return NOTHING
    m = unit.free("m", LOW / 2)
    return Pair(exact_input(f"((1 - {m}) * {number(x)})"), exact_input(f"({m} * {number(x)})"))


def shown(unit, out, ideal, bound, given=()):
    """The statement that a unit's error is within a bound."""
    result = unit.measure(out, ideal)
    return script([unit], [result], [*given, "nothing in [0, 0]"], [f"{result[0]} in {both_sides(bound)}"])


def difference(headers):
    limit = headers.constants["kUlp2"]
    headers.says("two_float.h", "a - b; off by kUlp2 (|a| + |b|)")
    out = {}
    for k, name in enumerate("ab"):
        unit = Unit(name, headers)
        out[name] = shown(unit, unit.run("two_difference", [unit.two(k == 0), unit.two(k == 1)]), 1 - 2 * k,
                          min(limit, claim(f"two_difference_{name}") * SQUARE))
    unit = Unit("flush", headers, flush=True)
    out["flush"] = shown(unit, unit.run("two_difference", [unit.two(0), unit.two(0)]), 0, FLUSHED)
    return out


def combination(headers):
    factor = headers.says("two_float.h", "off by {combination} kUlp2 (|base| + |x u| + |y v|)")["combination"]
    weights = ["x in [-1, 1]", "y in [-1, 1]"]
    out = {}
    for k, (name, ideal) in enumerate({"base": "1", "u": "x", "v": "y", "flush": "0"}.items()):
        unit = Unit(name, headers, flush=name == "flush")
        base, u, v = (unit.two(k == j) for j in range(3))
        bound = min(factor * headers.constants["kUlp2"], claim(f"two_combination_{name}") * SQUARE) if k < 3 else FLUSHED
        out[name] = shown(unit, unit.run("two_combination", [base, weight("x"), u, weight("y"), v]), ideal, bound, weights)
    return out


class Vector:
    def __init__(self, k, value):
        self.x, self.y, self.z = (value if k == j else constant(0) for j in range(3))


def dot(headers):
    """The factor of a_k b_k, for each axis: b's parts are weights. Low times low, which is left out, is one more."""
    factor = headers.says("two_float.h", "a . b; off by {dot} kUlp2 |a| |b|")["dot"]
    bound = min(factor * headers.constants["kUlp2"], (claim("two_dot") + 1) * SQUARE) - LOW * LOW
    out = {}
    for k, axis in enumerate("xyz"):
        unit = Unit(axis, headers)
        m = unit.free("m", LOW)
        a = Pair(Vector(k, exact_input(f"(1 - {m})")), Vector(k, exact_input(m)))
        b = Pair(Vector(k, weight("high")), Vector(k, weight("low")))
        out[axis] = shown(unit, unit.run("two_dot", [a, b]), f"high + low * (1 - {m})", bound,
                          [f"high in [{number(1 - LOW)}, {number(1 + LOW)}]", f"low in {both_sides(LOW)}"])
    return out


UNITS = {"o": (1, 0, 0), "ab": (0, 1, 0), "ac": (0, 0, 1)}
IDEALS = {"o": "1", "ab": "x", "ac": "y"}


def root_edges(unit, o, ab, ac):
    a, b, c = stored(unit, o), stored(unit, o + ab), stored(unit, o + ac)
    return a, unit.run("two_difference", [b, a]), unit.run("two_difference", [c, a])


def corners(headers):
    """A corner a + x (b - a) + y (c - a) of a face a, b, c as stored, and a step from one to another."""
    headers.quote("bary.h", "r.origin = a; r.ab = two_difference(b, a); r.ac = two_difference(c, a);")
    headers.quote("bary.h", "return two_combination(r.origin, float(point.x) * kBaryUnit, r.ab, float(point.y) * kBaryUnit, r.ac);")
    headers.quote("bary.h", "return two_combination(two(vec3(0.0f, 0.0f, 0.0f)), x, r.ab, y, r.ac);")
    factor = headers.says("bary.h", "off by {place} kUlp2 of the root's coordinates")["place"] * headers.constants["kUlp2"]
    out = {}
    for name, unit_of in UNITS.items():
        unit = Unit("position_" + name, headers)
        a, ab, ac = root_edges(unit, *unit_of)
        bound = min(claim(unit.name) * SQUARE, factor)
        out[unit.name] = shown(unit, unit.run("two_combination", [a, weight("x"), ab, weight("y"), ac]), IDEALS[name], bound,
                               ["x in [0, 1]", "y in [0, 1]"])
        unit = Unit("step_" + name, headers)
        _, ab, ac = root_edges(unit, *unit_of)
        bound = min(claim(unit.name) * SQUARE, factor)
        out[unit.name] = shown(unit, unit.run("two_combination", [NOTHING, weight("x"), ab, weight("y"), ac]),
                               IDEALS[name] if name != "o" else "0", bound,
                               ["x in [-1, 1]", "y in [-1, 1]"])
    return out


# For fixed t the error is affine in the weights: its size is largest at a corner of the triangle that they are in.
VERTICES = ((0, 0), (1, 0), (0, 1))


def cut(headers):
    """from + x (to - from), 0 <= x <= 1."""
    headers.quote("bounds.h", "return two_combination(from, at, two_difference(to, from), 0.0f, two(vec3(0.0f, 0.0f, 0.0f)));")
    out = {}
    for k, name in enumerate(("cut_from", "cut_to")):
        for x in (0, 1):
            unit = Unit(name, headers)
            start, end = unit.two(k == 0), unit.two(k == 1)
            edge = unit.run("two_difference", [end, start])
            out[f"{name}, x = {x}"] = shown(unit, unit.run("two_combination", [start, weight("x"), edge, constant(0), NOTHING]),
                                            ("1 - x", "x")[k], claim(name) * SQUARE, [f"x in [{x}, {x}]"])
    return out


# The factor of each corner, at each vertex; their sum at a vertex is offset_radius at most.
RADIUS = {(0, 0): {"a": "21.01"}, (1, 0): {"a": "30.51", "b": "26.51"}, (0, 1): {"a": "34.01", "c": "23.01"}}
OFFSETS = {"a": "v + w - 1", "b": "-v", "c": "-w"}
assert all(sum(map(Fraction, bounds.values())) <= Fraction(CLAIMS["offset_radius"]) for bounds in RADIUS.values())


def offset(unit, o, a, b, c, p):
    """offset_from of make_surface's corners: base a, end b, third corner c. Each is given from the origin."""
    origin = unit.two(o)
    base, end, third = (unit.run("two_difference", [stored(unit, o + x), origin]) for x in (a, b, c))
    edge, other = unit.run("two_difference", [end, base]), unit.run("two_difference", [third, base])
    from_base = unit.run("two_difference", [unit.two(p), base])
    return unit.run("two_combination", [from_base, -weight("v"), edge, -weight("w"), other])


def surface(headers):
    headers.quote("triangle.h", "s.a = two_difference(a, from.origin); s.b = two_difference(b, from.origin); "
                                "s.c = two_difference(c, from.origin);")
    headers.quote("triangle.h", "Two3 base = s.a; Two3 end = s.b; if (c.feature == kEdgeBc) base = s.b; "
                                "if (c.feature == kEdgeAc || c.feature == kEdgeBc) end = s.c;")
    headers.quote("triangle.h", "Two3 u = two_difference(end, base); Two3 v = two_difference(s.c, base); "
                                "Two3 from_base = two_difference(p, base); return two_combination(from_base, -c.v, u, -c.w, v);")
    out = {}
    for v, w in VERTICES:
        given = [f"v in [{v}, {v}]", f"w in [{w}, {w}]"]
        for name, values in {"offset_o": (1, 0, 0, 0, 0), "offset_p": (0, 0, 0, 0, 1)}.items():
            unit = Unit(name, headers)
            out[f"{name}, v = {v}, w = {w}"] = shown(unit, offset(unit, *values), values[4], claim(name) * SQUARE, given)
        for name, bound in RADIUS[v, w].items():
            unit = Unit(name, headers)
            values = (int(name == k) for k in "abc")
            out[f"corner {name}, v = {v}, w = {w}"] = shown(unit, offset(unit, 0, *values, 0), OFFSETS[name], claim(bound) * SQUARE, given)
    unit = Unit("flush", headers, flush=True)
    out["flush"] = shown(unit, offset(unit, 0, 0, 0, 0, 0), 0, FLUSHED, ["v in [0, 1]", "w in [0, 1]"])
    return out


def plain_inside(headers):
    """p - a - v (b - a) - w (c - a), in plain floats of floats: 3 of itself, 4 of the longest edge."""
    for text in ("vec3 ab = t.b - t.a; vec3 ac = t.c - t.a; vec3 bc = t.c - t.b; vec3 ap = p - t.a; vec3 bp = p - t.b;",
                 "vec3 normal = (ap - v * ab) - w * ac;", "vec3 to_ab = ap - clamp(x, 0.0f, 1.0f) * ab;", "vec3 to_bc = bp - clamp(",
                 "return choose(inside, dot3(normal, normal), at_edges);"):
        headers.quote("triangle.h", text)
    n = headers.says("triangle.h", "its root is off by kUlp ({distance} D + {edge} L) before its own rounding")
    out = {}
    for v, w in VERTICES:
        units = [Unit(name, headers) for name in ("n", "ab", "ac")]
        results = []
        for unit in units:
            normal, ab, ac = (unit.plain(int(unit.name == k)) for k in ("n", "ab", "ac"))
            ap = unit.rounded(f"{normal.text} + v * {ab.text} + w * {ac.text}",
                              f"({normal.text} + v * {ab.text} + w * {ac.text})", {})[0]
            first = unit.add(ap, unit.multiply(weight("v"), unit.add(ab, constant(0))), -1)
            results.append(unit.measure(unit.add(first, unit.multiply(weight("w"), unit.add(ac, constant(0))), -1), normal.text))
        more = ULP * ULP * 16  # terms of the second order
        out[f"v = {v}, w = {w}"] = script(units, results, [f"v in [{v}, {v}]", f"w in [{w}, {w}]"], [
            f"|{results[0][0]}| in [0, {number(n['distance'] * ULP + more)}]",
            f"|{results[1][0]}| + |{results[2][0]}| in [0, {number(n['edge'] * ULP + more)}]"])
    for t in (0, 1):  # an edge, from its start b: p - b = n + t bc
        units = [Unit(name, headers) for name in ("n", "bc")]
        results = []
        for unit in units:
            normal, bc = (unit.plain(int(unit.name == k)) for k in ("n", "bc"))
            bp = unit.rounded(f"{normal.text} + t * {bc.text}", f"({normal.text} + t * {bc.text})", {})[0]
            foot = unit.multiply(weight("t"), unit.add(bc, constant(0)))
            results.append(unit.measure(unit.add(bp, foot, -1), normal.text))
        out[f"an edge, t = {t}"] = script(units, results, [f"t in [{t}, {t}]"], [
            f"|{results[0][0]}| in [0, {number(n['distance'] * ULP)}]", f"|{results[1][0]}| in [0, {number(n['edge'] * ULP)}]"])
    return out


def coarse(headers):
    """a - origin in plain floats: 2 kUlp of itself, the rounding of low parts, and that of the exact high parts."""
    headers.quote("triangle.h", "return (a.hi - origin.hi) + (a.lo - origin.lo);")
    headers.says("triangle.h", "off by 2 kUlp of itself and kUlp2 of what both are")
    out = {}
    for name, o, a in (("origin", 1, 0), ("corner", 0, 1)):
        unit = Unit(name, headers)
        origin, corner = unit.two(o), stored(unit, o + a)
        high, low = unit.add(corner.hi, origin.hi, -1), unit.add(corner.lo, origin.lo, -1)
        out[name] = shown(unit, unit.add(high, low), a, {"origin": claim("coarse_origin") * SQUARE, "corner": 2 * ULP + 8 * SQUARE}[name])
    return out


def linear_proof(name, theorem, scripts, weakened):
    def constants(headers):
        scripts(headers)
        return {**headers.constants, **headers.seen}

    return Proof(name, theorem, scripts, [Weakened(n, Fraction(h), Fraction(f)) for n, h, f in weakened], constants)


PROOFS = [
    linear_proof("difference", "two_difference is off by at most kUlp2 (abs(a) + abs(b))", difference,
                 [("kUlp2", claim("two_difference_a") * SQUARE, Fraction("3.49") * SQUARE)]),
    linear_proof("combination", "two_combination is off by at most 4 kUlp2 (abs(base) + abs(x u) + abs(y v))", combination,
                 [("combination", "3.38", "3.37")]),
    linear_proof("dot", "two_dot is off by at most 8 kUlp2 abs(a) abs(b)", dot, [("dot", "5.63", "5.62")]),
    linear_proof("corners", "a corner, and a step between two, is off by at most 8 kUlp2 of the root's coordinates", corners,
                 [("place", "5.51", "4.4")]),
    linear_proof("cut", "a cut is off by at most 10 kUlp2 of T's radius", cut, []),
    linear_proof("surface", "p - q is off by at most 15 kUlp2 radius + 7.4 kUlp2 abs(origin) + 4.1 kUlp2 abs(p)", surface, []),
    linear_proof("plain", "plain_distance2's root is off by at most kUlp (3 D + 4 L)", plain_inside,
                 [("distance", "3", "2.9"), ("edge", "4", "3.9")]),
    linear_proof("coarse", "a coarse corner is off by at most 2 kUlp of itself and kUlp2 of the origin", coarse, []),
]
