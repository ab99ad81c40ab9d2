// A triangle in a local frame: closest point, distance upper and lower bounds, quality.
#ifndef VKH_SHADERS_MATH_TRIANGLE_H
#define VKH_SHADERS_MATH_TRIANGLE_H

#include "shaders/math/certified.h"

VKH_LIB_BEGIN

struct Corners {
  vec3 a, b, c;
};

// The closest point found on a triangle, as base + v (end - base) + w (c - base): base is a, or b
// on edge bc; end is b, or c on edges ac and bc; w is 0 on an edge. 0 <= v, w and v + w <= 1 hold
// exactly, so the point lies in the triangle whatever rounding did to v and w, and its distance
// bounds d(p, S) from above.
struct Closest {
  vec3 offset;  // from the point to p, in plain floats: steers
  float distance2;
  float rank;    // squared distance within the triangle's plane: see closest_point
  uint feature;  // kEdgeAb, kEdgeAc, kEdgeBc, kInside
  float v, w;
};

VKH_CONST uint kEdgeAb = 0u;
VKH_CONST uint kEdgeAc = 1u;
VKH_CONST uint kEdgeBc = 2u;
VKH_CONST uint kInside = 3u;

// Takes the smaller distance if plain floats tell them apart, otherwise the smaller rank.
VKH_FN Closest closer(Closest x, Closest y) {
  bool surely = y.distance2 < (1.0f - 8.0f * kUlp) * x.distance2;
  bool perhaps = y.distance2 <= (1.0f + 8.0f * kUlp) * x.distance2;
  if (either(surely, both(perhaps, y.rank < x.rank))) return y;
  return x;
}

// `normal`: from the triangle's plane to p.
VKH_FN Closest closest_on_edge(vec3 from_start, vec3 edge, float t, uint feature, vec3 normal) {
  Closest c;
  c.v = clamp(t, 0.0f, 1.0f);
  c.w = 0.0f;
  c.feature = feature;
  c.offset = from_start - c.v * edge;
  c.distance2 = dot3(c.offset, c.offset);
  c.rank = dot3(c.offset - normal, c.offset - normal);
  return c;
}

// All three edges are tried, and the interior in the orthogonal frame (ab, h) with h the altitude
// from ab to c: Gram-Schmidt is backward stable, so a needle or a cap costs a few ulp of its
// longest edge, where the normal equations would lose a factor (longest edge / altitude)^2.
// Degenerate triangles fall to their edges or to a point. Next to a corner, closest points on two
// features that are sqrt(ulp) d apart are equally far in plain floats, which would cost half an ulp
// of d: features are told apart within the plane.
VKH_FN Closest closest_point(vec3 p, Corners t) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  vec3 bc = t.c - t.b;
  vec3 ap = p - t.a;
  vec3 bp = p - t.b;
  float ee = dot3(ab, ab);
  float s = ratio(dot3(ac, ab), ee);
  vec3 h = ac - s * ab;
  float hh = dot3(h, h);
  float x = ratio(dot3(ap, ab), ee);
  float w =
      ratio(dot3(ap - x * ab, h), hh);  // not ap: h is only orthogonal to ab up to an ulp of ac
  float v = x - w * s;

  bool has_inside = hh > kSmallSquare;
  vec3 normal = choose(has_inside, (ap - v * ab) - w * ac, vec3(0.0f, 0.0f, 0.0f));

  Closest best = closest_on_edge(ap, ab, x, kEdgeAb, normal);
  float along_ac = ratio(dot3(ap, ac), dot3(ac, ac));
  best = closer(best, closest_on_edge(ap, ac, along_ac, kEdgeAc, normal));
  float along_bc = ratio(dot3(bp, bc), dot3(bc, bc));
  best = closer(best, closest_on_edge(bp, bc, along_bc, kEdgeBc, normal));
  // 4 kUlp under 1, so that v + w <= 1 holds for the exact sum too.
  bool in_halves = both(v >= 0.0f, both(w >= 0.0f, v + w <= 1.0f - 4.0f * kUlp));
  if (both(has_inside, in_halves)) {
    Closest inner;
    inner.offset = normal;
    inner.distance2 = dot3(inner.offset, inner.offset);
    inner.rank = 0.0f;
    inner.feature = kInside;
    inner.v = v;
    inner.w = w;
    best = closer(best, inner);
  }
  return best;
}

// The squared distance from p to some point of T, in plain floats: nearly that of closest_point, at
// half its cost. With L the longest edge, D the distance of the point that it is the distance of,
// and both in exact arithmetic for p and T as given, its root is off by kUlp (3 D + 4 L) before its
// own rounding: inside, where 0 <= v, w and v + w <= 1 hold exactly as in closest_point, ap, which
// is under D + L, is off by one kUlp of itself, v ab and w ac by two, the differences by one; on an
// edge it is less. `inside`: whether that point is on none of the edges.
VKH_FN float plain_distance2(vec3 p, Corners t, VKH_OUT(bool) inside) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  vec3 bc = t.c - t.b;
  vec3 ap = p - t.a;
  vec3 bp = p - t.b;
  float per_ab = ratio(1.0f, dot3(ab, ab));
  float s = per_ab * dot3(ac, ab);
  vec3 h = ac - s * ab;
  float hh = dot3(h, h);
  float x = per_ab * dot3(ap, ab);
  float w = ratio(dot3(ap - x * ab, h), hh);
  float v = x - w * s;
  vec3 normal = (ap - v * ab) - w * ac;
  bool in_halves = both(v >= 0.0f, both(w >= 0.0f, v + w <= 1.0f - 4.0f * kUlp));
  inside = both(hh > kSmallSquare, in_halves);
  vec3 to_ab = ap - clamp(x, 0.0f, 1.0f) * ab;
  vec3 to_ac = ap - clamp(ratio(dot3(ap, ac), dot3(ac, ac)), 0.0f, 1.0f) * ac;
  vec3 to_bc = bp - clamp(ratio(dot3(bp, bc), dot3(bc, bc)), 0.0f, 1.0f) * bc;
  float at_edges = min(dot3(to_ab, to_ab), min(dot3(to_ac, to_ac), dot3(to_bc, to_bc)));
  return choose(inside, dot3(normal, normal), at_edges);
}

VKH_FN float plain_distance2(vec3 p, Corners t) {
  bool inside;
  return plain_distance2(p, t, inside);
}

// Largest distance of a corner from the local origin.
VKH_FN float radius_up(Corners t) {
  return length_up(max(dot3(t.a, t.a), max(dot3(t.b, t.b), dot3(t.c, t.c))));
}

// The point from which a surface is measured, and the precision.
struct View {
  Two3 origin;   // near the points; they are given relative to it
  float reach;   // >= |origin|, and >= |p| for every p whose distance will be asked
  float base;    // >= 0; distances are given as what they are above it, which may be negative
  bool sharp;    // a distance's own rounding matters: it is taken to 48 bits instead of 20
  bool plain;    // nothing is certified: plain floats, to measure what the certificate costs
  float enough;  // a surface may be coarse if its slack is no more than this; 0: none may
  bool fine;     // a point next to a triangle is measured to 48 bits of its size: see is_near
};

// A triangle of B around a local origin. `a`, `b` and `c` hold its corners to 48 bits, unless it is
// coarse or plain; `at` holds them rounded to floats, and serves to find the closest point.
struct Surface {
  Two3 a, b, c;
  Corners at;
  float base;   // as View::base
  bool sharp;   // as View::sharp
  bool plain;   // as View::plain
  bool fine;    // as View::fine
  bool coarse;  // it is `at` alone, and distances are taken in plain floats: they err by the slack
  float slack;  // what distances leave out: see make_surface and coarse_slack
};

// a - origin in plain floats: off by 2 kUlp of itself and kUlp2 of what both are.
VKH_FN vec3 coarse_difference(Two3 a, Two3 origin) {
  return (a.hi - origin.hi) + (a.lo - origin.lo);
}

// The error of a coarse surface's distances, R its radius: its corners are off by 2 kUlp R; p, no
// farther away than D + R, is rounded by kUlp; plain_distance2 leaves 3 D + 4 L, and L <= 2 R. So
// 11 kUlp R, and 4 kUlp D that surface_distance_up takes.
VKH_FN float coarse_slack(Corners at, float reach) {
  return round_up(12.0f * kUlp * radius_up(at) + 8.0f * kUlp2 * reach, 4.0f);
}

// In units of kUlp2, R the surface's radius: p - q is off by 14.3 R, 7.4 |origin| and 4.1 |p|, most
// of the last two by the rounding of low parts, which are an ulp of them. Where p is not the origin
// that may be more than 8 reach: LocalCorners::slack has as much left (docs/proofs.md).
VKH_FN Surface make_surface(Two3 a, Two3 b, Two3 c, View from) {
  Surface s;
  s.base = from.base;
  s.sharp = from.sharp;
  s.plain = from.plain;
  s.fine = from.fine;
  s.coarse = false;
  if (from.plain) {
    s.at.a = a.hi - from.origin.hi;
    s.at.b = b.hi - from.origin.hi;
    s.at.c = c.hi - from.origin.hi;
    s.slack = 0.0f;
    return s;
  }
  if (from.enough > 0.0f) {
    s.at.a = coarse_difference(a, from.origin);
    s.at.b = coarse_difference(b, from.origin);
    s.at.c = coarse_difference(c, from.origin);
    s.slack = coarse_slack(s.at, from.reach);
    s.coarse = s.slack <= from.enough;
    if (s.coarse) return s;
  }
  s.a = two_difference(a, from.origin);
  s.b = two_difference(b, from.origin);
  s.c = two_difference(c, from.origin);
  s.at.a = rounded(s.a);
  s.at.b = rounded(s.b);
  s.at.c = rounded(s.c);
  s.slack = round_up(kUlp2 * (8.0f * from.reach + 15.0f * radius_up(s.at)), 4.0f);
  return s;
}

// p - q for the point q that `c` names, in 48 bits.
VKH_FN Two3 offset_from(Two3 p, Surface s, Closest c) {
  Two3 base = s.a;
  Two3 end = s.b;
  if (c.feature == kEdgeBc) base = s.b;
  if (c.feature == kEdgeAc || c.feature == kEdgeBc) end = s.c;
  Two3 u = two_difference(end, base);
  Two3 v = two_difference(s.c, base);
  Two3 from_base = two_difference(p, base);
  return two_combination(from_base, -c.v, u, -c.w, v);
}

// A step of the point that a Closest names: along its edge, and towards the corner off that edge.
struct Step {
  float v, w;
};

// The longest step: longer ones would cost digits, and are never due.
VKH_CONST float kLongestStep = 0.00390625f;  // 2^-8

// <= 1 - (v + w), the weight of the base. Where that is under a half, 1 less the sum's high part is
// exact, and what follows rounds it once. The low part is 0 on an edge; inside, where 4 kUlp and
// more are left, it is off by kUlp2 / 8, a quarter of a rounding.
VKH_FN float base_weight_down(Closest c) {
  Two sum = two_sum(c.v, c.w);
  return lowered((1.0f - sum.hi) - sum.lo);
}

// The step that takes the point of `c` to the foot of `offset`, which is p less that point, or to
// the edge that it would cross; u and v are edges_from_base(). It stays in the triangle, whatever
// rounding did to it: v and w remain >= 0 exactly, and v + w <= 1 holds for their floats' exact
// sum, since it does not grow, or by what the base's weight leaves of it. Next to a corner that is
// not the base that weight is all that is left, and has all its bits: a guard of a few kUlp there
// would hold the point as far off. If no step is short enough, there is none.
VKH_FN Step step_to_foot(vec3 offset, vec3 u, vec3 v, Closest c) {
  float uu = dot3(u, u);
  float x = ratio(dot3(offset, u), uu);
  float s = ratio(dot3(v, u), uu);
  vec3 h = v - s * u;
  float w = ratio(dot3(offset - x * u, h), dot3(h, h));
  Step step;
  step.w = clamp(w, -min(c.w, kLongestStep), kLongestStep);
  step.v = clamp(x - step.w * s, -min(c.v, kLongestStep), kLongestStep);
  bool shrinks = step.v + step.w <= 0.0f;
  float most = lowered(base_weight_down(c) - step.w);
  bool stays = either(shrinks, most >= -min(c.v, kLongestStep));
  step.v = choose(shrinks, step.v, min(step.v, most));
  step.v = choose(stays, step.v, 0.0f);
  step.w = choose(stays, step.w, 0.0f);
  return step;
}

// The edges of S from the base of `c`: to its end, and to the third corner.
struct Edges {
  Two3 to_end, to_third;
};

VKH_FN Edges edges_from_base(Surface s, Closest c) {
  Two3 base = s.a;
  Two3 end = s.b;
  Two3 third = s.c;
  if (c.feature == kEdgeBc) {
    base = s.b;
    third = s.a;
  }
  if (c.feature == kEdgeAc) third = s.b;
  if (c.feature == kEdgeAc || c.feature == kEdgeBc) end = s.c;
  Edges e;
  e.to_end = two_difference(end, base);
  e.to_third = two_difference(third, base);
  return e;
}

VKH_FN Two3 stepped_offset(Two3 offset, Edges e, Step step) {
  return two_combination(offset, -step.v, e.to_end, -step.w, e.to_third);
}

// p - q for a point q of S that is nearer than the one `c` names, which is off the foot of p by
// some kUlp R, since v and w are plain floats: `offset` is p less that point. It is off by another
// 4 kUlp2 of the offset and of both steps along their edges: with steps of up to 2^-8, and an
// offset under 2^-17 R, less than 0.1 kUlp2 R, which Surface::slack has left. On slivers a step may
// lead away: there `offset` remains.
VKH_FN Two3 nearer_offset(Two3 offset, Surface s, Closest c) {
  Edges e = edges_from_base(s, c);
  Step step = step_to_foot(rounded(offset), e.to_end.hi, e.to_third.hi, c);
  Two3 stepped = stepped_offset(offset, e, step);
  if (dot3(stepped.hi, stepped.hi) < dot3(offset.hi, offset.hi)) return stepped;
  return offset;
}

// Whether p is so near, under some 2^-17 R, that a foot that is off by some kUlp R lengthens its
// distance by much: a distance d becomes sqrt(d^2 + (4 kUlp R)^2), 2^-8 of itself more at 2^-17 R.
VKH_FN bool is_near(Two3 offset, Surface s) {
  float near = 8388608.0f * s.slack;  // 2^23: the slack is 15 kUlp2 R and more
  return dot3(offset.hi, offset.hi) < near * near;
}

// >= d(p, S) - base, for p taken as it is and the point of S that `c` names.
VKH_FN float distance_to_up(Two3 p, Surface s, Closest c) {
  if (s.plain) return root(c.distance2) - s.base;  // uncertified: View::plain is set
  Two3 offset = offset_from(p, s, c);
  if (s.fine && is_near(offset, s)) offset = nearer_offset(offset, s, c);
  if (s.sharp) return raised(sharp_norm_above_up(offset, s.base) + s.slack);
  return raised(round_up(norm_up(rounded(offset)) + s.slack, 1.0f) - s.base);
}

// >= d(p, S) - base, for p taken as it is. `inside`: whether the point of S at that distance is on
// none of its edges, which only steers.
VKH_FN float surface_distance_up(Two3 p, Surface s, VKH_OUT(bool) inside) {
  if (s.coarse) {
    float d = length_up(plain_distance2(rounded(p), s.at, inside));
    return raised(round_up(d + s.slack, 3.0f) - s.base);
  }
  Closest c = closest_point(rounded(p), s.at);
  inside = c.feature == kInside;
  return distance_to_up(p, s, c);
}

VKH_FN float surface_distance_up(Two3 p, Surface s) {
  bool inside;
  return surface_distance_up(p, s, inside);
}

// Altitude on the longest edge over the longest edge: docs/method.md, eq. 3. Steers subdivision
// only.
VKH_FN float quality(Corners t) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  vec3 bc = t.c - t.b;
  vec3 n = cross3(ab, ac);
  float longest2 = max(dot3(ab, ab), max(dot3(ac, ac), dot3(bc, bc)));
  return root(ratio(dot3(n, n), longest2 * longest2));  // uncertified: steers subdivision only
}

// The corner opposite a triangle's longest edge; the first on a tie.
VKH_FN uint opposite_longest(Corners t) {
  vec3 ea = t.c - t.b;
  vec3 eb = t.a - t.c;
  vec3 ec = t.b - t.a;
  float la = dot3(ea, ea);
  float lb = dot3(eb, eb);
  float lc = dot3(ec, ec);
  if (la >= lb && la >= lc) return 0u;
  return lb >= lc ? 1u : 2u;
}

// Radius of a ball that holds t, around the circumcentre of an acute triangle or the middle of the
// longest edge of another (docs/method.md, eq. 8). The centre may be off: the radius is measured
// from it.
VKH_FN float enclosing_radius_up(Corners t) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  float bb = dot3(ab, ab);
  float cc = dot3(ac, ac);
  float bc = dot3(ab, ac);
  // Circumcentre a + v ab + w ac; it lies inside where t is acute.
  float det = 2.0f * (bb * cc - bc * bc);
  float v = ratio(cc * (bb - bc), det);
  float w = ratio(bb * (cc - bc), det);
  bool acute = v > 0.0f && w > 0.0f && v + w < 1.0f;
  vec3 centre = v * ab + w * ac;
  if (!acute) {
    uint opposite = opposite_longest(t);
    centre = opposite == 0u ? 0.5f * (ab + ac) : (opposite == 1u ? 0.5f * ac : 0.5f * ab);
  }
  float r = max(norm_up(centre), max(norm_up(ab - centre), norm_up(ac - centre)));
  // Corners are off by an ulp of themselves, differences by one of theirs, and |ab|, |ac| <= 2 r:
  // 3 ulp, of which norm_up leaves 1.5.
  return round_up(r, 1.0f);
}

VKH_LIB_END
#endif
