// The positions of a candidate's corners (math/dyadic.h), in the frame of the meshes and around
// each other.
#ifndef VKH_SHADERS_MATH_BARY_H
#define VKH_SHADERS_MATH_BARY_H

#include "shaders/math/dyadic.h"
#include "shaders/math/triangle.h"

VKH_LIB_BEGIN

// A root triangle of A: a corner and the two edges from it, to 48 bits.
struct Root {
  Two3 origin;
  Two3 ab, ac;
};

VKH_FN Root make_root(Two3 a, Two3 b, Two3 c) {
  Root r;
  r.origin = a;
  r.ab = two_difference(b, a);
  r.ac = two_difference(c, a);
  return r;
}

// A power of two, so that j * kBaryUnit is exact.
VKH_CONST float kBaryUnit = 9.5367431640625e-7f;  // 2^-20 = 1 / kBaryOne

// A point of the root in the frame of the meshes; off by 8 kUlp2 of the root's coordinates (`reach`
// of local_corners).
VKH_FN Two3 position_of(Root r, uvec2 point) {
  return two_combination(r.origin, float(point.x) * kBaryUnit, r.ab, float(point.y) * kBaryUnit,
                         r.ac);
}

// A candidate around its first corner.
struct LocalCorners {
  Two3 origin;
  Two3 b, c;    // the other corners from the first
  Corners at;   // rounded; a is 0
  float slack;  // how far a computed corner, or a cut between two, can lie from the exact one
  float reach;  // >= the largest coordinate magnitude of the root
};

// The step from corner to corner along the root's edges: the integers' difference is exact.
VKH_FN Two3 step_between(uvec2 from, uvec2 to, Root r) {
  float x = float(int(to.x) - int(from.x)) * kBaryUnit;
  float y = float(int(to.y) - int(from.y)) * kBaryUnit;
  return two_combination(two(vec3(0.0f, 0.0f, 0.0f)), x, r.ab, y, r.ac);
}

// Corners around the first in plain floats, for steering only.
VKH_FN vec3 plain_step(uvec2 from, uvec2 to, Root r) {
  float x = float(int(to.x) - int(from.x)) * kBaryUnit;
  float y = float(int(to.y) - int(from.y)) * kBaryUnit;
  return x * r.ab.hi + y * r.ac.hi;
}

VKH_FN Corners plain_corners(Root r, Bary3 t) {
  Corners c;
  c.a = vec3(0.0f, 0.0f, 0.0f);
  c.b = plain_step(t.a, t.b, r);
  c.c = plain_step(t.a, t.c, r);
  return c;
}

// In kUlp2 of the reach corners are off by 5.5, steps by 4.5, cuts by 10 more. The rest of the 24
// is for Surface::slack (docs/proofs.md).
VKH_FN LocalCorners local_corners(Root r, Bary3 t) {
  LocalCorners p;
  p.origin = position_of(r, t.a);
  p.b = step_between(t.a, t.b, r);
  p.c = step_between(t.a, t.c, r);
  p.at.a = vec3(0.0f, 0.0f, 0.0f);
  p.at.b = rounded(p.b);
  p.at.c = rounded(p.c);
  p.reach = round_up(norm_up(r.origin.hi) + norm_up(r.ab.hi) + norm_up(r.ac.hi), 8.0f);
  p.slack = round_up(24.0f * kUlp2 * p.reach, 3.0f);
  return p;
}

// The same with only the high parts of the other corners: T is moved by the longer low part at
// most.
VKH_FN LocalCorners without_low_parts(LocalCorners p) {
  p.slack = round_up(p.slack + max(norm_up(p.b.lo), norm_up(p.c.lo)), 1.0f);
  p.b = two(p.b.hi);
  p.c = two(p.c.hi);
  return p;
}

VKH_LIB_END
#endif
