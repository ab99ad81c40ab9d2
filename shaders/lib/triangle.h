// A triangle in a local frame: closest point, distance upper and lower bounds, quality.
#ifndef VKH_SHADERS_LIB_TRIANGLE_H
#define VKH_SHADERS_LIB_TRIANGLE_H

#include "shaders/lib/certified.h"

VKH_LIB_BEGIN

struct Corners {
  vec3 a, b, c;
};

// Closest point of a triangle as an offset: offset = p - q for a q = a + v ab + w ac of the triangle with 0 <= v, w and
// v + w <= 1 exactly, so that |p - q| bounds the distance from above whatever rounding did to v and w.
struct Closest {
  vec3 offset;
  float distance2;
};

VKH_FN Closest closer(Closest x, Closest y) {
  if (y.distance2 < x.distance2) return y;
  return x;
}

VKH_FN Closest closest_on_segment(vec3 from_start, vec3 edge, float t) {
  Closest c;
  c.offset = from_start - clamp(t, 0.0f, 1.0f) * edge;
  c.distance2 = dot(c.offset, c.offset);
  return c;
}

// The closest point found. All three edges are tried, and the interior in the orthogonal frame (ab, h) with h the altitude
// from ab to c: Gram-Schmidt is backward stable, so a needle or a cap costs a few ulp of its longest edge, where the normal
// equations would lose a factor (longest edge / altitude)^2. Degenerate triangles fall to their edges or to a point.
VKH_FN Closest closest_point(vec3 p, Corners t) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  vec3 bc = t.c - t.b;
  vec3 ap = p - t.a;
  vec3 bp = p - t.b;
  float ee = dot(ab, ab);
  float s = ratio(dot(ac, ab), ee);
  vec3 h = ac - s * ab;
  float hh = dot(h, h);
  float x = ratio(dot(ap, ab), ee);
  float w = ratio(dot(ap, h), hh);
  float v = x - w * s;

  Closest best = closest_on_segment(ap, ab, x);
  best = closer(best, closest_on_segment(ap, ac, ratio(dot(ap, ac), dot(ac, ac))));
  best = closer(best, closest_on_segment(bp, bc, ratio(dot(bp, bc), dot(bc, bc))));
  // 4 kUlp under 1, so that v + w <= 1 holds for the exact sum too.
  if (hh > kSmallSquare && v >= 0.0f && w >= 0.0f && v + w <= 1.0f - 4.0f * kUlp) {
    Closest inner;
    inner.offset = (ap - v * ab) - w * ac;
    inner.distance2 = dot(inner.offset, inner.offset);
    best = closer(best, inner);
  }
  return best;
}

// Largest distance of a corner from the local origin.
VKH_FN float radius_up(Corners t) {
  return max(norm_up(t.a), max(norm_up(t.b), norm_up(t.c)));
}

// What |offset| can lack of the distance from p to the exact triangle, for |p| <= p_radius and corners within s_radius of
// the local origin, each off by one rounding (b - origin).
//   corners off by a rounding:                      1 s_radius
//   ap, bp = p - a:                                 1 (p_radius + s_radius)
//   ab, ac, bc, two roundings after weighting, the weights summing to at most 1, |ab| <= 2 s_radius:
//                                                   2 * 2 s_radius
//   the two subtractions of the offset:             (p_radius + 3 s_radius) + the result's own, which norm_up's margin takes
// Sum: 2 p_radius + 9 s_radius ulps; a little is added for second-order terms.
VKH_FN float distance_slack(float p_radius, float s_radius) {
  return round_up(kUlp * (2.25f * p_radius + 9.25f * s_radius), 4.0f);
}

// d(p, S) <= the result, without distance_slack.
VKH_FN float distance_up(Closest c) { return round_up(sqrt(c.distance2), 9.0f); }

// Altitude on the longest edge over the longest edge, eq. 3 of the paper. Steers subdivision only.
VKH_FN float quality(Corners t) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  vec3 bc = t.c - t.b;
  vec3 n = cross(ab, ac);
  float longest2 = max(dot(ab, ab), max(dot(ac, ac), dot(bc, bc)));
  return sqrt(ratio(dot(n, n), longest2 * longest2));  // uncertified: steers subdivision only
}

// Of a triangle's corners, the one opposite its longest edge; the first on a tie.
VKH_FN uint opposite_longest(Corners t) {
  vec3 ea = t.c - t.b;
  vec3 eb = t.a - t.c;
  vec3 ec = t.b - t.a;
  float la = dot(ea, ea);
  float lb = dot(eb, eb);
  float lc = dot(ec, ec);
  if (la >= lb && la >= lc) return 0u;
  return lb >= lc ? 1u : 2u;
}

// Radius of a ball that holds t, around the circumcentre of an acute triangle or the middle of the longest edge of another
// (paper eq. 8). The centre may be off: the radius is measured from it.
VKH_FN float enclosing_radius_up(Corners t) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  float bb = dot(ab, ab);
  float cc = dot(ac, ac);
  float bc = dot(ab, ac);
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
  // ab and ac are off by an ulp each of themselves, the differences by one of theirs, and |ab|, |ac| <= 2 r.
  return round_up(r, 6.0f);
}

VKH_LIB_END
#endif
