// A lower bound on the distance from a point to a triangle that holds in exact arithmetic.
//
// For any direction r, d(p, S) >= min over the corners s of S of (p - s).r / |r|: the plane through
// the corner that is farthest along r separates p from S. So directions may come from anywhere;
// only this quotient is rounded with care.
#ifndef VKH_SHADERS_MATH_LOWER_H
#define VKH_SHADERS_MATH_LOWER_H

#include "shaders/math/triangle.h"

VKH_LIB_BEGIN

// The bound in plain floats, p at the origin: off by 3 ulp of |s| |r| and an ulp of |s| for its own
// rounding. Good to 1e-6 of S's size.
VKH_FN float coarse_distance_down(Surface s, vec3 r) {
  float farthest = min(dot3(-s.at.a, r), min(dot3(-s.at.b, r), dot3(-s.at.c, r)));
  float off = round_up(4.25f * kUlp * radius_up(s.at) * norm_up(r) + s.slack * norm_up(r), 8.0f);
  float reach = round_down(farthest, 1.0f) - off;
  float length = norm_up(r);
  if (!(reach > 0.0f) || length < 1e-15f) return lowered(-s.base);
  return lowered(quotient_down(reach, length) - s.base);
}

// The correction to subtract from r so that it is orthogonal to u, and to v too if `to_both`.
VKH_FN vec3 orthogonal_correction(Two3 r, Two3 u, Two3 v, bool to_both) {
  float uu = dot3(u.hi, u.hi);
  float x = rounded(two_dot(r, u));
  vec3 correction = ratio(x, uu) * u.hi;
  if (to_both) {
    float along = ratio(dot3(v.hi, u.hi), uu);
    vec3 h = v.hi - along * u.hi;
    float y = rounded(two_dot(r, v)) - along * x;
    correction = correction + ratio(y, dot3(h, h)) * h;
  }
  return correction;
}

// The offset made orthogonal, to 48 bits: the second correction is of the order of an ulp of r, so
// that its own rounding does not matter.
VKH_FN Two3 orthogonal(vec3 offset, Two3 u, Two3 v, bool to_both) {
  Two3 r = two(offset);
  for (uint k = 0u; k < 2u; ++k) {  // a loop for the same reason as in fine_distance_down
    vec3 correction = orthogonal_correction(r, u, v, to_both);
    if (k == 0u) {
      r.hi = r.hi - correction;
    } else {
      r.lo = -correction;
    }
  }
  return two_sum(r.hi, r.lo);  // on a sliver the second correction is not small
}

// r times a power of two, so that its largest component is in [1, 2) and no square underflows; 0 if
// it is too short to be a direction.
VKH_FN Two3 scaled(Two3 r) {
  float largest = max(abs(r.hi.x), max(abs(r.hi.y), abs(r.hi.z)));
  uint exponent = floatBitsToUint(largest) >> 23;
  float factor = exponent > 27u ? uintBitsToFloat((254u - exponent) << 23) : 0.0f;
  r.hi = factor * r.hi;
  r.lo = factor * r.lo;
  return r;
}

VKH_FN Two smaller(Two x, Two y) {
  Two m;
  m.hi = min(x.hi, y.hi);
  m.lo = min((x.hi - m.hi) + x.lo, (y.hi - m.hi) + y.lo);
  return m;
}

// The bound for a direction of 48 bits, to 48 bits of S's size and of the distance.
VKH_FN float fine_separation_down(Surface s, Two3 direction) {
  Two3 r = scaled(direction);
  Two3 back = two_difference(two(vec3(0.0f, 0.0f, 0.0f)), r);
  Two reach = smaller(two_dot(s.a, back), smaller(two_dot(s.b, back), two_dot(s.c, back)));
  // The slack has 15 kUlp2 of the radius: corners and products are off by 8 (docs/proofs.md).
  float off = s.slack * norm_up(r.hi);
  return quotient_above_down(reach, off, r, s.base);
}

// <= d(origin, S) - base. A corner is separated along the offset, an edge by what is orthogonal to
// it, the inside by the normal; where the closest point lies next to a border, rounding may have
// named the wrong one, so all are tried.
VKH_FN float fine_distance_down(Surface s, Closest c) {
  vec3 offset = rounded(offset_from(two(vec3(0.0f, 0.0f, 0.0f)), s, c));
  Two3 ab = two_difference(s.b, s.a);
  Two3 ac = two_difference(s.c, s.a);
  Two3 bc = two_difference(s.c, s.b);
  // This is a loop, not five calls: drivers inline each call, and this is most of their work on the
  // kernels that compute lower bounds.
  float best = lowered(-s.base);
  for (uint k = 0u; k < 5u; ++k) {
    Two3 direction = two(offset);
    if (k > 0u) {
      Two3 u = ab;  // k = 1: the inside
      if (k == 3u) u = ac;
      if (k == 4u) u = bc;
      direction = orthogonal(offset, u, ac, k == 1u);
    }
    best = max(best, fine_separation_down(s, direction));
  }
  return best;
}

// <= d(origin, S) - base, `c` the closest point found. It is precise only if it has to be: a
// triangle that is farther than base + `enough` by plain floats stays at that.
VKH_FN float distance_down(Surface s, Closest c, float enough) {
  float coarse = coarse_distance_down(s, c.offset);
  if (coarse >= enough) return coarse;
  return max(coarse, fine_distance_down(s, c));
}

VKH_FN float triangle_distance_down(Surface s, float enough) {
  return distance_down(s, closest_point(vec3(0.0f, 0.0f, 0.0f), s.at), enough);
}

VKH_LIB_END
#endif
