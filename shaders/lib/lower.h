// A lower bound on the distance from a point to a triangle that holds in exact arithmetic.
//
// For any direction r, d(p, S) >= min over the corners s of S of (p - s).r / |r|: the plane through the corner that is
// farthest along r separates p from S. So directions may come from anywhere; only this quotient is rounded with care.
#ifndef VKH_SHADERS_LIB_LOWER_H
#define VKH_SHADERS_LIB_LOWER_H

#include "shaders/lib/triangle.h"

VKH_LIB_BEGIN

// The bound for direction r, p at the origin; the corners are off by one rounding each, `radius` >= |corner|.
// A product s.r is off by 3 ulp of |s| |r|, the rounded corner by one more.
VKH_FN float separation_down(Corners s, float radius, vec3 r) {
  float reach = min(dot(-s.a, r), min(dot(-s.b, r), dot(-s.c, r)));
  float length_up = norm_up(r);
  float exact_at_least = reach - round_up(4.25f * kUlp * radius * length_up, 4.0f);
  if (!(exact_at_least > 0.0f) || length_up < 1e-16f) return 0.0f;
  return round_down(exact_at_least / length_up, 4.0f);
}

// r without its component along e. Done on an offset that is already nearly orthogonal to e, it leaves an error relative to
// |r|, where the offset's own was relative to |e|.
VKH_FN vec3 without(vec3 r, vec3 e) { return r - ratio(dot(r, e), dot(e, e)) * e; }

// <= d(0, S). Tried are the offset from the closest point found (right for a corner), that made orthogonal to each edge (right
// for an edge) and to the plane (right for the interior).
VKH_FN float triangle_distance_down(Corners s) {
  vec3 zero = vec3(0.0f, 0.0f, 0.0f);
  float radius = radius_up(s);
  vec3 ab = s.b - s.a;
  vec3 ac = s.c - s.a;
  vec3 bc = s.c - s.b;
  vec3 h = without(without(ac, ab), ab);
  vec3 r = closest_point(zero, s).offset;
  float best = separation_down(s, radius, r);
  best = max(best, separation_down(s, radius, without(r, ab)));
  best = max(best, separation_down(s, radius, without(r, ac)));
  best = max(best, separation_down(s, radius, without(r, bc)));
  return max(best, separation_down(s, radius, without(without(without(r, ab), h), ab)));
}

VKH_LIB_END
#endif
