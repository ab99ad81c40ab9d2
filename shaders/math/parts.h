// Bounds on d(x, B) over a part P of a cell of A, and the closed forms of their figures.
//
// P is a triangle, its corners v as computed around an origin next to the cell, in plain floats.
// Its bounds hold for these corners; Part::slack is how far they lie from the exact ones. S is the
// triangle of B that P is measured against. A direction g serves as the normal of its plane: any
// with |g| <= 1 is right, and heights above it are h(x) = g.x - m, for any m.
//
// Above: d(., S) <= |x - q(x)| for the affine q that has any points of S at P's corners, since S is
// convex. With o = x - q(x), also affine, |o| <= |h| + t, t the largest |o - h g| at the corners:
// no foot has to lie inside of S, and P may cross the plane.
//
// Below: d(x, R) >= h(x) - max over R's corners r of h(r), for every triangle R of B, and
// >= min of h(r), less h(x). So |h| less the largest such excess of any R is not above d(., B). For
// S that is what rounding leaves of its plane; nothing rests on the plane's own error.
#ifndef VKH_SHADERS_MATH_PARTS_H
#define VKH_SHADERS_MATH_PARTS_H

#include "shaders/math/bounds.h"
#include "shaders/math/lower.h"

VKH_LIB_BEGIN

// ---- affine functions on a triangle, by their values at its corners ---------------------------

VKH_CONST float kThirdUp = 0.33333334f;       // 0x3eaaaaab, above 1/3
VKH_CONST float kThirdDown = 0.33333331f;     // 0x3eaaaaaa, below it
VKH_CONST float kSixthUp = 0.16666667f;       // 0x3e2aaaab, above 1/6
VKH_CONST float kSixthDown = 0.16666666f;     // 0x3e2aaaaa, below it
VKH_CONST float kTwelfthUp = 0.083333336f;    // 0x3daaaaab, above 1/12
VKH_CONST float kTwelfthDown = 0.083333328f;  // 0x3daaaaaa, below it

VKH_FN float least3(vec3 d) { return min(d.x, min(d.y, d.z)); }
VKH_FN float sum3(vec3 d) { return d.x + d.y + d.z; }
VKH_FN vec3 sizes(vec3 d) { return vec3(abs(d.x), abs(d.y), abs(d.z)); }

VKH_FN vec3 corner_of(Corners t, uint i) { return choose(i == 0u, t.a, choose(i == 1u, t.b, t.c)); }

// >= the mean of three lengths, and <= that of three numbers of any sign.
VKH_FN float mean_up(vec3 d) { return round_up((d.x + d.y + d.z) * kThirdUp, 4.0f); }
VKH_FN float mean_down(vec3 d) {
  float off = 2.0f * kUlp * (abs(d.x) + abs(d.y) + abs(d.z));
  return lowered((d.x + d.y + d.z) * kThirdDown - off);
}

// >= the mean square of the affine function with these values, none negative, at T's corners.
VKH_FN float mean_square_up(vec3 d) {
  float squares = d.x * d.x + d.y * d.y + d.z * d.z;
  float products = d.x * d.y + d.y * d.z + d.z * d.x;
  return round_up((squares + products) * kSixthUp, 8.0f);
}

// On an edge from a corner at which the one function is not over t: >= the other, none negative,
// as far as the one is not over t. Between the corners it is a mean of its values there, by a part
// that is off by 4 kUlp of itself.
VKH_FN float most_on_edge(float one, float other, float one_end, float other_end, float t) {
  if (one > t) return 0.0f;
  float to_end = choose(one_end > t, ratio(t - one, one_end - one), 1.0f);
  return round_up(max(other, other + to_end * (other_end - other)), 8.0f);
}

// >= the affine function `other`, none of its values negative, wherever on the triangle the affine
// function `one` is not over t; 0 if that is nowhere.
VKH_FN float most_within(vec3 one, vec3 other, float t) {
  float ab = max(most_on_edge(one.x, other.x, one.y, other.y, t),
                 most_on_edge(one.y, other.y, one.x, other.x, t));
  float bc = max(most_on_edge(one.y, other.y, one.z, other.z, t),
                 most_on_edge(one.z, other.z, one.y, other.y, t));
  float ca = max(most_on_edge(one.z, other.z, one.x, other.x, t),
                 most_on_edge(one.x, other.x, one.z, other.z, t));
  return max(ab, max(bc, ca));
}

// An affine function's zero cuts the triangle: one corner is alone on its side, `own` its size
// there. The triangle next to it has `corner` of the area; the rest are two triangles, with
// `rest` of the area and the sizes 0, `first` and `second`, and with `last` and 0, 0 and `second`.
struct ZeroCut {
  bool none;     // all corners have one sign
  bool is_over;  // the corner alone is not negative
  float own, first, second;
  float corner, rest, last;
};

// Shares are off by 8 kUlp of themselves: a quotient of sums of one sign by 3.5, a product of two
// such by one more. Where both sizes are under 2^-97, so that ratio gives 0, the cut is taken to be
// at the corner alone, which changes the function by no more than its size there.
VKH_FN ZeroCut zero_cut(vec3 s) {
  Cut cut = cut_by(s);
  ZeroCut z;
  z.none = cut.none;
  z.is_over = pick3(s, cut.alone) >= 0.0f;
  z.own = abs(pick3(s, cut.alone));
  z.first = abs(pick3(s, cut.first));
  z.second = abs(pick3(s, cut.second));
  float to_first = ratio(z.own, z.own + z.first);
  float to_second = ratio(z.own, z.own + z.second);
  z.corner = to_first * to_second;
  z.rest = choose(z.own + z.first > kSmallSquare, ratio(z.first, z.own + z.first), 1.0f);
  z.last =
      to_first * choose(z.own + z.second > kSmallSquare, ratio(z.second, z.own + z.second), 1.0f);
  return z;
}

// Three times the mean of the size: of the corner's triangle, and of the rest. All terms have one
// sign. Shares 8 kUlp, products one, sums one: 10 at most.
VKH_FN float corner_sum(ZeroCut z) { return z.corner * z.own; }
VKH_FN float rest_sum(ZeroCut z) { return z.rest * (z.first + z.second) + z.last * z.second; }

// Six times the mean square, in the same way: 11 kUlp at most.
VKH_FN float corner_squares(ZeroCut z) { return z.corner * (z.own * z.own); }
VKH_FN float rest_squares(ZeroCut z) {
  float squares = (z.first * z.first + z.first * z.second) + z.second * z.second;
  return z.rest * squares + z.last * (z.second * z.second);
}

// Three times the mean of |s|, off by 11 kUlp.
VKH_FN float thrice_mean_size(vec3 s) {
  ZeroCut z = zero_cut(s);
  return choose(z.none, abs(sum3(s)), corner_sum(z) + rest_sum(z));
}

// >= the mean of |s|, and <= it. The third and its product add 1.5 kUlp.
VKH_FN float mean_size_up(vec3 s) { return round_up(thrice_mean_size(s) * kThirdUp, 13.0f); }
VKH_FN float mean_size_down(vec3 s) { return round_down(thrice_mean_size(s) * kThirdDown, 13.0f); }

// Twelve times the mean square of s, off by 5 kUlp: squares of the sums of two, so that nothing
// cancels.
VKH_FN float twelve_squares(vec3 s) {
  float a = s.x + s.y;
  float b = s.y + s.z;
  float c = s.z + s.x;
  return (a * a + b * b) + c * c;
}
VKH_FN float square_down(vec3 s) { return round_down(twelve_squares(s) * kTwelfthDown, 7.0f); }

// <= the mean of max(s, 0), and <= that of its square.
VKH_FN float mean_over_down(vec3 s) {
  ZeroCut z = zero_cut(s);
  float cut = choose(z.is_over, corner_sum(z), rest_sum(z));
  float whole = max(choose(z.none, sum3(s), cut), 0.0f);
  return round_down(whole * kThirdDown, 12.0f);
}
VKH_FN float square_over_down(vec3 s) {
  ZeroCut z = zero_cut(s);
  float cut = choose(z.is_over, corner_squares(z), rest_squares(z)) * kSixthDown;
  float whole = choose(s.x >= 0.0f, twelve_squares(s) * kTwelfthDown, 0.0f);
  return round_down(choose(z.none, whole, cut), 13.0f);
}

// A number that is only known to lie between two.
struct Between {
  float down, up;
};

VKH_FN Between between(float down, float up) {
  Between b;
  b.down = down;
  b.up = up;
  return b;
}

// An affine function's values at the corners in order, and what its shares beyond any t have in
// common: 1 over the products of the differences of which they are quotients.
struct Spread {
  float least, middle, most;
  float low, high;  // for a t below the middle, and for one that is not
};

VKH_FN Spread spread_of(vec3 s) {
  Spread p;
  p.least = least3(s);
  p.most = max3(s);
  p.middle = max(min(s.x, s.y), min(max(s.x, s.y), s.z));
  float whole = p.most - p.least;
  p.low = ratio(1.0f, (p.middle - p.least) * whole);
  p.high = ratio(1.0f, (p.most - p.middle) * whole);
  return p;
}

// Values that lie within it of each other are not told apart: of others each product over
// kSmallSquare is one whose corner has more than 2^-48 of the triangle.
VKH_CONST float kLeastSpread = 5.9604645e-8f;  // 2^-24

// The share of the triangle on which s > t: a corner's, or what it leaves. The corner's is the
// square of a difference, off by 3 kUlp, times `low` or `high`, which are by 5.5, so by 9.5 in all,
// and 1 less it by one more.
VKH_FN Between share_beyond(Spread s, float t) {
  if (t >= s.most) return between(0.0f, 0.0f);
  if (t < s.least) return between(1.0f, 1.0f);
  if (s.most - s.least <= kLeastSpread) return between(0.0f, 1.0f);
  bool is_low = t < s.middle;
  float from = choose(is_low, t - s.least, s.most - t);
  float corner = min((from * from) * choose(is_low, s.low, s.high), 1.0f);
  float share = choose(is_low, 1.0f - corner, corner);
  return between(max(share - 12.0f * kUlp, 0.0f), min(share + 12.0f * kUlp, 1.0f));
}

// The share on which s <= t.
VKH_FN Between share_within(Spread s, float t) {
  if (t < s.least) return between(0.0f, 0.0f);
  Between over = share_beyond(s, t);
  return between(choose(over.up > 0.0f, max((1.0f - over.up) - 2.0f * kUlp, 0.0f), 1.0f),
                 choose(over.down > 0.0f, min((1.0f - over.down) + 2.0f * kUlp, 1.0f), 1.0f));
}

// The share on which s <= t, or |s| <= t: what is beyond t on either side is disjoint. The sums
// are of numbers up to 1: two roundings each.
VKH_FN Between share_of(vec3 s, float t, bool of_size) {
  Between over = share_beyond(spread_of(s), t);
  Between under = between(0.0f, 0.0f);
  if (of_size) under = share_beyond(spread_of(-s), t);
  if (of_size && t < 0.0f) return between(0.0f, 0.0f);
  float most = over.up + under.up;
  float least = over.down + under.down;
  return between(choose(most > 0.0f, max((1.0f - most) - 4.0f * kUlp, 0.0f), 1.0f),
                 choose(least > 0.0f, min((1.0f - least) + 4.0f * kUlp, 1.0f), 1.0f));
}

// ---- parts ------------------------------------------------------------------------------------

// A part of a cell. The exact parts tile it: a cut's ratios are the floats that they are.
struct Part {
  Corners at;   // around the origin
  float area;   // its share of the cell's, off by 3 kUlp of itself for each cut, or by 2^-126
  float slack;  // how far a computed point of it can lie from the exact one
};

VKH_FN Part whole_part(Corners at, float slack) {
  Part p;
  p.at = at;
  p.area = 1.0f;
  p.slack = slack;
  return p;
}

VKH_FN vec3 middle_of(Corners t) { return kThirdUp * ((t.a + t.b) + t.c); }

// Where a cut meets the two edges from the corner alone, by the part of the edge up to there.
struct PartCut {
  Cut cut;
  float to_first, to_second;
};

// `side` tells the corners' sides by its sign, `away` how far they are from the cut. Any cut is
// right.
VKH_FN PartCut part_cut(vec3 side, vec3 away) {
  PartCut c;
  c.cut = cut_by(side);
  float own = abs(pick3(away, c.cut.alone));
  c.to_first = min(ratio(own, own + abs(pick3(away, c.cut.first))), 1.0f);
  c.to_second = min(ratio(own, own + abs(pick3(away, c.cut.second))), 1.0f);
  return c;
}

// One of the three parts that a cut leaves, 0 next to the corner alone. With R the part's farthest
// corner, a cut point is off by 5 kUlp R more than its ends: the edge, up to 2 R long, by one of
// itself, the product by another, the sum by one of R. A mean of the ends is off by no more than
// the worse of them.
VKH_FN Part cut_part(Part p, PartCut c, uint which) {
  vec3 alone = corner_of(p.at, c.cut.alone);
  vec3 first = corner_of(p.at, c.cut.first);
  vec3 second = corner_of(p.at, c.cut.second);
  vec3 on_first = alone + c.to_first * (first - alone);
  vec3 on_second = alone + c.to_second * (second - alone);
  float left = c.to_first * (1.0f - c.to_second);
  Part q;
  q.at.a = choose(which == 0u, alone, on_first);
  q.at.b = choose(which == 0u, on_first, choose(which == 1u, first, second));
  q.at.c = choose(which == 1u, second, on_second);
  float share = choose(which == 0u, c.to_first * c.to_second, left);
  q.area = p.area * choose(which == 1u, 1.0f - c.to_first, share);
  q.slack = round_up(p.slack + 5.0f * kUlp * radius_up(p.at), 2.0f);
  return q;
}

// ---- planes -----------------------------------------------------------------------------------

// Heights h(x) = normal.x - middle around the origin.
struct Plane {
  Two3 normal;  // at most 1 long
  Two middle;
};

// The same number with a low part under an ulp of the high one, which a difference does not leave.
VKH_FN Two3 renormalised(Two3 a) { return two_sum(a.hi, a.lo); }

// a b - c d. Nothing rests on its error.
VKH_FN Two two_minor(Two a, Two b, Two c, Two d) {
  Two p = two_product(a.hi, b.hi);
  Two q = two_product(c.hi, d.hi);
  Two s = two_sum(p.hi, -q.hi);
  float cross = (a.hi * b.lo + a.lo * b.hi) - (c.hi * d.lo + c.lo * d.hi);
  return two_sum(s.hi, (s.lo + (p.lo - q.lo)) + cross);
}

VKH_FN Two two_of(float hi, float lo) {
  Two t;
  t.hi = hi;
  t.lo = lo;
  return t;
}

// The cross product, in the same way.
VKH_FN Two3 two_cross(Two3 a, Two3 b) {
  Two ax = two_of(a.hi.x, a.lo.x);
  Two ay = two_of(a.hi.y, a.lo.y);
  Two az = two_of(a.hi.z, a.lo.z);
  Two bx = two_of(b.hi.x, b.lo.x);
  Two by = two_of(b.hi.y, b.lo.y);
  Two bz = two_of(b.hi.z, b.lo.z);
  Two x = two_minor(ay, bz, az, by);
  Two y = two_minor(az, bx, ax, bz);
  Two z = two_minor(ax, by, ay, bx);
  Two3 n;
  n.hi = vec3(x.hi, y.hi, z.hi);
  n.lo = vec3(x.lo, y.lo, z.lo);
  return n;
}

// r shortened so that |g| <= 1 in exact arithmetic, by 8 kUlp: a quotient is off by 2.5, a product
// by one. 0 if r is no direction.
VKH_FN vec3 shortened(vec3 r) { return ratio(1.0f - 8.0f * kUlp, norm_up(r)) * r; }

// S's plane. The normal is at most 1 long: the factor's quotient is off by 2.5 kUlp, the product is
// exact but for kUlp2. Where edges are no longer than their rounding, n's low part need not be
// under an ulp of the high one: its length counts, too. 0 where S has no plane. S is not coarse.
VKH_FN Plane plane_of(Surface s) {
  Two3 ab = renormalised(two_difference(s.b, s.a));
  Two3 ac = renormalised(two_difference(s.c, s.a));
  Two3 n = scaled(two_cross(ab, ac));
  float factor = ratio(1.0f - 8.0f * kUlp, round_up(norm_up(n.hi) + norm_up(n.lo), 1.0f));
  Two3 product = two_product(factor, n.hi);
  product.lo = product.lo + factor * n.lo;
  Plane plane;
  plane.normal = renormalised(product);
  plane.middle = two_dot(plane.normal, renormalised(s.a));
  return plane;
}

// h(v) for v of 48 bits, its low part under an ulp: off by what height_off says.
VKH_FN float height_at(Plane plane, Two3 v) {
  Two d = two_dot(plane.normal, v);
  return (d.hi - plane.middle.hi) + (d.lo - plane.middle.lo);
}

// >= the error of heights of up to `height`, at points up to `radius` from the origin: the product
// 8 kUlp2 of the radius, the low parts' difference and what it adds to the high ones' one of
// radius and middle, the high parts' difference and the sum kUlp of the height each.
VKH_FN float height_off(Plane plane, float radius, float height) {
  float size = radius + abs(plane.middle.hi);
  return round_up(3.0f * kUlp * height + 10.0f * kUlp2 * size, 4.0f);
}

VKH_FN vec3 heights_of(Plane plane, Corners t) {
  return vec3(height_at(plane, two(t.a)), height_at(plane, two(t.b)), height_at(plane, two(t.c)));
}

// The heights between which a triangle lies, outward.
struct Span {
  float least, most;
};

// The corners around the origin are off by kUlp2 (2 reach + R), and by an eighth more for the new
// low part: the slack has 8 and 15.
VKH_FN Span span_over(Plane plane, Surface s) {
  vec3 h = vec3(0.0f, 0.0f, 0.0f);
  for (uint i = 0u; i < 3u; ++i) {  // as offsets_of
    Two3 corner = s.a;
    if (i == 1u) corner = s.b;
    if (i == 2u) corner = s.c;
    float height = height_at(plane, renormalised(corner));
    if (i == 0u) h.x = height;
    if (i == 1u) h.y = height;
    if (i == 2u) h.z = height;
  }
  float off = height_off(plane, radius_up(s.at), max3(sizes(h))) + s.slack;
  Span span;
  span.least = lowered(least3(h) - round_up(off, 1.0f));
  span.most = raised(max3(h) + round_up(off, 1.0f));
  return span;
}

// ---- above ------------------------------------------------------------------------------------

// A bound over a part: the affine function with the values `at`, or its size, and `off` more where
// it is from above, less where it is from below. d has the mean, the mean square and the least or
// greatest value that are said here, or is beyond them.
struct PartBound {
  vec3 at;
  bool is_size;
  float off;
  float mean, square, extreme;
};

// v - q for a point q of S next to v's foot, rounded to floats: off by kUlp of itself and S's
// slack.
VKH_FN vec3 offset_to(vec3 v, Surface s) {
  Closest c = closest_point(v, s.at);
  Two3 offset = offset_from(two(v), s, c);
  if (is_near(offset, s)) offset = nearer_offset(offset, s, c);
  return rounded(offset);
}

// >= |o - h normal| for the exact offset, but for S's slack: 2 kUlp of itself, of o's rounding and
// the difference; 3 of h, of o's rounding, the product and the normal's low part.
VKH_FN float beside(vec3 o, float h, Plane plane) {
  return round_up(norm_up(o - h * plane.normal.hi) + 3.5f * kUlp * abs(h), 3.0f);
}

// The offsets of P's corners, in a loop, since drivers inline each call.
struct PartOffsets {
  vec3 a, b, c;
};

VKH_FN PartOffsets offsets_of(Part p, Surface s) {
  PartOffsets o;
  for (uint i = 0u; i < 3u; ++i) {
    vec3 offset = offset_to(corner_of(p.at, i), s);
    if (i == 0u) o.a = offset;
    if (i == 1u) o.b = offset;
    if (i == 2u) o.c = offset;
  }
  return o;
}

// d(., S) from above at P's exact corners, but for both slacks.
VKH_FN vec3 lengths_of(PartOffsets o) {
  return vec3(round_up(norm_up(o.a), 1.0f), round_up(norm_up(o.b), 1.0f),
              round_up(norm_up(o.c), 1.0f));
}

// Twelve times the mean square of |o|: a sum of three squares.
VKH_FN float twelve_squares(PartOffsets o) {
  vec3 x = o.a + o.b;
  vec3 y = o.b + o.c;
  vec3 z = o.c + o.a;
  return (dot3(x, x) + dot3(y, y)) + dot3(z, z);
}

// d(., B) from above by S, `heights` those of P's corners over the plane, whatever their error, and
// `slack` that of both. The mean square is that of |o|, and Minkowski's inequality adds what o is
// off.
VKH_FN PartBound part_above(PartOffsets o, float slack, Plane plane, vec3 heights) {
  vec3 lengths = lengths_of(o);
  float tau = max(beside(o.a, heights.x, plane),
                  max(beside(o.b, heights.y, plane), beside(o.c, heights.z, plane)));
  float by_height = round_up(mean_size_up(heights) + tau, 1.0f);
  float by_length = mean_up(lengths);
  PartBound b;
  b.is_size = by_height < by_length;
  b.at = choose(b.is_size, heights, lengths);
  b.off = round_up(choose(b.is_size, tau, 0.0f) + slack, 1.0f);
  b.mean = round_up(min(by_height, by_length) + slack, 1.0f);
  b.extreme = round_up(max3(lengths) + slack, 1.0f);
  float root = sqrt_up(round_up(twelve_squares(o) * kTwelfthUp, 9.0f));
  root = round_up(root + (kUlp * max3(lengths) + slack), 3.0f);
  b.square = round_up(root * root, 1.0f);
  return b;
}

VKH_FN float slack_of(Part p, Surface s) { return round_up(p.slack + s.slack, 1.0f); }

// ---- below ------------------------------------------------------------------------------------

// The bounds from below over P, of the triangles that were seen.
struct PartBelow {
  vec3 heights;  // over S's plane
  float over;    // the size of the height less this is not above d, on the part over the plane,
  float under;   // and on the part under it
  vec3 at;       // an affine function that is not above d anywhere on P
};

// g.(x - r) at P's corners, r the corner of R where it is least, from below. Products of vectors
// are off by 3 kUlp of their lengths' product, R's corners by one, the difference by one.
VKH_FN vec3 part_minorant(Part p, Surface r, vec3 g) {
  float farthest = max(dot3(g, r.at.a), max(dot3(g, r.at.b), dot3(g, r.at.c)));
  float rounding = kUlp * (4.0f * radius_up(p.at) + 5.0f * radius_up(r.at));
  float off = round_up(round_up(rounding, 4.0f) + r.slack, 1.0f);
  return vec3(lowered((dot3(g, p.at.a) - farthest) - off),
              lowered((dot3(g, p.at.b) - farthest) - off),
              lowered((dot3(g, p.at.c) - farthest) - off));
}

// The same for all that is no nearer to the origin than `distance`.
VKH_FN vec3 rest_minorant(Part p, float distance) {
  return vec3(lowered(distance - norm_up(p.at.a)), lowered(distance - norm_up(p.at.b)),
              lowered(distance - norm_up(p.at.c)));
}

// Whether a triangle with this minorant is nowhere on P nearer than one that is no farther than `d`
// from the corners: the affine function is not under d(., S) there, which is convex. S itself must
// stay.
VKH_FN bool is_beyond(vec3 minorant, vec3 d) { return least3(minorant - d) >= 0.0f; }

// >= w where the edge from i to j crosses s = 0: the ratio is off by 3.5 kUlp, the two differences,
// the product and the sum by one each.
VKH_FN float at_crossing(float si, float sj, float wi, float wj) {
  bool crosses = either(both(si > 0.0f, sj < 0.0f), both(si<0.0f, sj> 0.0f));
  float gap = abs(si) + abs(sj);
  float z = wi + ratio(abs(si), gap) * (wj - wi);
  z = z + 8.0f * kUlp * (abs(wi) + abs(wj)) + kTiny;
  return choose(crosses, choose(gap > kSmallSquare, z, max(wi, wj)), -3.0e38f);
}

// >= the affine function w at every point of the triangle where s >= 0: at the corners there, and
// at the crossings of its edges.
VKH_FN float greatest_over(vec3 s, vec3 w) {
  float most = choose(s.x >= 0.0f, w.x, -3.0e38f);
  most = max(most, choose(s.y >= 0.0f, w.y, -3.0e38f));
  most = max(most, choose(s.z >= 0.0f, w.z, -3.0e38f));
  most = max(most, at_crossing(s.x, s.y, w.x, w.y));
  most = max(most, at_crossing(s.y, s.z, w.y, w.z));
  return max(most, at_crossing(s.z, s.x, w.z, w.x));
}

// >= x - y for x and y of any sign.
VKH_FN vec3 excess(vec3 x, vec3 y) {
  return vec3(raised(x.x - y.x), raised(x.y - y.y), raised(x.z - y.z));
}
// <= x less one number.
VKH_FN vec3 less(vec3 x, float y) {
  return vec3(lowered(x.x - y), lowered(x.y - y), lowered(x.z - y));
}

// The bound by one triangle, or by all that were not looked at: its excess, to be taken from |h| on
// either side, and an affine function.
struct Excess {
  float over, under;
  vec3 at;
};

// By its heights; heights_off is the error of P's.
VKH_FN Excess excess_of_span(vec3 heights, Span span, float heights_off) {
  Excess e;
  e.over = raised(span.most + heights_off);
  e.under = raised(heights_off - span.least);
  vec3 over = less(heights, e.over);
  vec3 under = less(-heights, e.under);
  e.at = choose(sum3(over) > sum3(under), over, under);
  return e;
}

// By a minorant too, where it is better. `kept`: the affine function that it is compared under.
VKH_FN Excess with_minorant(Excess e, vec3 heights, vec3 minorant, vec3 kept) {
  e.over = min(e.over, greatest_over(heights, excess(heights, minorant)));
  e.under = min(e.under, greatest_over(-heights, excess(-heights, minorant)));
  bool better = sum3(min(minorant, kept)) > sum3(min(e.at, kept));
  e.at = choose(better, minorant, e.at);
  return e;
}

VKH_FN PartBelow begin_below(vec3 heights) {
  PartBelow b;
  b.heights = heights;
  b.over = 0.0f;
  b.under = 0.0f;
  b.at = vec3(3.0e38f, 3.0e38f, 3.0e38f);
  return b;
}

VKH_FN PartBelow with_excess(PartBelow b, Excess e) {
  b.over = max(b.over, e.over);
  b.under = max(b.under, e.under);
  b.at = min(b.at, e.at);
  return b;
}

// d(., B) from below by all that was seen. With e the excess, (|h| - e)^2 >= h^2 - 2 e |h| where
// |h| is larger, and elsewhere that is negative.
VKH_FN PartBound part_below(Part p, PartBelow below) {
  vec3 h = below.heights;
  float over = choose(max3(h) > 0.0f, below.over, 0.0f);
  float under = choose(least3(h) < 0.0f, below.under, 0.0f);
  float off = round_up(max(over, under) + p.slack, 1.0f);
  vec3 at = less(below.at, p.slack);
  float by_height = max(lowered(mean_size_down(h) - off), 0.0f);
  float by_corners = mean_over_down(at);
  PartBound b;
  b.is_size = by_height > by_corners;
  b.at = choose(b.is_size, h, at);
  b.off = choose(b.is_size, off, 0.0f);
  b.mean = max(by_height, by_corners);
  float lost = round_up(2.0f * off * mean_size_up(h), 2.0f);
  float square = max(lowered(square_down(h) - lost), 0.0f);
  b.square = choose(b.is_size, square, square_over_down(at));
  bool crosses = both(max3(h) > 0.0f, least3(h) < 0.0f);
  float least = choose(!crosses, least3(sizes(h)), 0.0f);
  b.extreme = max(choose(b.is_size, lowered(least - off), least3(at)), 0.0f);
  return b;
}

// The share of P that is surely within t, by a bound from above, and perhaps, by one from below.
VKH_FN float surely_within(PartBound above, float t) {
  if (t >= above.extreme) return 1.0f;
  return share_of(above.at, lowered(t - above.off), above.is_size).down;
}
VKH_FN float perhaps_within(PartBound below, float t) {
  if (t < below.extreme) return 0.0f;
  return share_of(below.at, raised(t + below.off), below.is_size).up;
}

VKH_LIB_END
#endif
