// A candidate's corners: dyadic barycentric integers in its root triangle, so that subdivision is
// exact. A corner is (j, k): root.a + (j ab + k ac) / kBaryOne.
#ifndef VKH_SHADERS_MATH_DYADIC_H
#define VKH_SHADERS_MATH_DYADIC_H

#include "shaders/math/choose.h"

VKH_LIB_BEGIN

struct Bary3 {
  uvec2 a, b, c;
};

VKH_FN Bary3 whole_root() {
  Bary3 t;
  t.a = uvec2(0u, 0u);
  t.b = uvec2(kBaryOne, 0u);
  t.c = uvec2(0u, kBaryOne);
  return t;
}

// Six integers of 21 bits in four words: j0 k0 j1 k1 j2 k2 from bit 0 up.
VKH_FN uvec4 pack_corners(Bary3 t) {
  uvec4 w;
  w.x = t.a.x | (t.a.y << 21);
  w.y = (t.a.y >> 11) | (t.b.x << 10) | (t.b.y << 31);
  w.z = (t.b.y >> 1) | (t.c.x << 20);
  w.w = (t.c.x >> 12) | (t.c.y << 9);
  return w;
}

VKH_FN Bary3 unpack_corners(uvec4 w) {
  const uint mask = (1u << 21) - 1u;
  Bary3 t;
  t.a = uvec2(w.x & mask, ((w.x >> 21) | (w.y << 11)) & mask);
  t.b = uvec2((w.y >> 10) & mask, ((w.y >> 31) | (w.z << 1)) & mask);
  t.c = uvec2(((w.z >> 20) | (w.w << 12)) & mask, (w.w >> 9) & mask);
  return t;
}

// ---- subdivision: 1 -> 4 ------------------------------------------------------------

// A split is a code. 0: midpoints, new point i in the middle of the edge opposite corner i.
// Otherwise double longest-edge bisection, 1 + x + 3 y + 9 z: bisect the edge opposite corner x
// (new point 3), then each half at the edge opposite its corner y (new point 4) or z (new point 5).
// Points 0..2 are the corners.

VKH_CONST uint kSplitMidpoint = 0u;
VKH_CONST uint kChildSplitNone = 31u;     // as kSplitNone, in 5 bits
VKH_CONST uint kSplitNone = 0xffffffffu;  // not split: closed before its subdivision

VKH_FN uint pick(uvec3 t, uint i) { return choose(i == 0u, t.x, choose(i == 1u, t.y, t.z)); }

// One half of triangle t, bisected at the middle m of the edge opposite corner `opposite`. Both
// halves keep t's orientation.
VKH_FN uvec3 bisected(uvec3 t, uint opposite, uint m, uint side) {
  uint a = pick(t, opposite);
  uint b = choose(opposite == 0u, t.y, choose(opposite == 1u, t.z, t.x));
  uint c = choose(opposite == 0u, t.z, choose(opposite == 1u, t.x, t.y));
  return uvec3(a, choose(side == 0u, b, m), choose(side == 0u, m, c));
}

VKH_FN uint bisection_code(uint x, uint y, uint z) { return 1u + x + 3u * y + 9u * z; }

// The corners of child 0..3 among the six points.
VKH_FN uvec3 child_points(uint split, uint child) {
  if (split == kSplitMidpoint) {
    if (child == 3u) return uvec3(3u, 4u, 5u);
    // (0, 5, 4), (5, 1, 3), (4, 3, 2): a corner, and the middles of the edges at it.
    return uvec3(choose(child == 0u, 0u, 6u - child), choose(child == 1u, 1u, 5u - child),
                 choose(child == 2u, 2u, 4u - child));
  }
  uint code = split - 1u;
  uint half_side = child >> 1;
  uvec3 half_points = bisected(uvec3(0u, 1u, 2u), code % 3u, 3u, half_side);
  uint inner = choose(half_side == 0u, (code / 3u) % 3u, code / 9u);
  return bisected(half_points, inner, 4u + half_side, child & 1u);
}

VKH_FN uvec2 middle(uvec2 p, uvec2 q) { return uvec2((p.x + q.x) >> 1, (p.y + q.y) >> 1); }

VKH_FN bool has_middle(uvec2 p, uvec2 q) { return (((p.x + q.x) | (p.y + q.y)) & 1u) == 0u; }

VKH_FN uvec2 corner_of(Bary3 t, uint i) { return choose(i == 0u, t.a, choose(i == 1u, t.b, t.c)); }

struct Bary6 {
  Bary3 corner, fresh;
};

VKH_FN uvec2 point_of(Bary6 p, uint i) {
  return choose(i < 3u, corner_of(p.corner, i), corner_of(p.fresh, i - 3u));
}

// The corners after and before corner i, whose edge lies opposite.
VKH_FN uvec2 next_of(Bary3 t, uint i) { return choose(i == 0u, t.b, choose(i == 1u, t.c, t.a)); }
VKH_FN uvec2 last_of(Bary3 t, uint i) { return choose(i == 0u, t.c, choose(i == 1u, t.a, t.b)); }

VKH_FN uvec2 middle_opposite(Bary3 t, uint i) { return middle(next_of(t, i), last_of(t, i)); }

VKH_FN bool has_middle_opposite(Bary3 t, uint i) {
  return has_middle(next_of(t, i), last_of(t, i));
}

// A bisection's halves, as bisected() has them by number: m is the middle opposite corner
// `opposite`.
struct Halves {
  Bary3 first, second;
};

VKH_FN Halves halves_of(Bary3 t, uint opposite, uvec2 m) {
  Halves h;
  h.first.a = corner_of(t, opposite);
  h.first.b = next_of(t, opposite);
  h.first.c = m;
  h.second.a = h.first.a;
  h.second.b = m;
  h.second.c = last_of(t, opposite);
  return h;
}

// The six points of a split, all of them exact if can_split.
VKH_FN Bary6 split_points(Bary3 t, uint split) {
  Bary6 p;
  p.corner = t;
  if (split == kSplitMidpoint) {
    p.fresh.a = middle(t.b, t.c);
    p.fresh.b = middle(t.c, t.a);
    p.fresh.c = middle(t.a, t.b);
    return p;
  }
  uint code = split - 1u;
  uvec2 m = middle_opposite(t, code % 3u);
  Halves h = halves_of(t, code % 3u, m);
  p.fresh.a = m;
  p.fresh.b = middle_opposite(h.first, (code / 3u) % 3u);
  p.fresh.c = middle_opposite(h.second, code / 9u);
  return p;
}

// Whether every new point of the split is an integer; where it is not, the bits have run out.
VKH_FN bool can_split(Bary3 t, uint split) {
  if (split == kSplitMidpoint)
    return has_middle(t.b, t.c) && has_middle(t.c, t.a) && has_middle(t.a, t.b);
  uint code = split - 1u;
  Halves h = halves_of(t, code % 3u, middle_opposite(t, code % 3u));
  return has_middle_opposite(t, code % 3u) && has_middle_opposite(h.first, (code / 3u) % 3u) &&
         has_middle_opposite(h.second, code / 9u);
}

VKH_FN Bary3 child_of(Bary6 p, uvec3 points) {
  Bary3 t;
  t.a = point_of(p, points.x);
  t.b = point_of(p, points.y);
  t.c = point_of(p, points.z);
  return t;
}

VKH_FN uint third(uint x) { return x / 3u; }

// Returns a dyadic point next to the centroid of t. The point is inside the root; it is inside t
// except for the rounding to an integer.
VKH_FN uvec2 centroid_of(Bary3 t) {
  return uvec2(third(t.a.x + t.b.x + t.c.x), third(t.a.y + t.b.y + t.c.y));
}

VKH_LIB_END
#endif
