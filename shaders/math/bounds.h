// The cascade of upper bounds on h(T, B), cheapest first: exact case, u1, u2, ha, u3
// (docs/method.md, section 3; equations are cited by its numbers). u4 stands in shaders/paper/.
//
// T is a sub-triangle of A as computed in a local frame, S a triangle of B in the same frame. Each
// bound holds in exact arithmetic for the computed T; the caller adds LocalCorners::slack for the
// distance from it to the exact one. Distances and bounds are what they are above one base
// (View::base), and may be negative. All of them rest on three facts. d(., B) <= d(., S). d(., S)
// is convex, since S is, so its maximum over a polygon is at a corner. d(., B) is 1-Lipschitz.
#ifndef VKH_SHADERS_MATH_BOUNDS_H
#define VKH_SHADERS_MATH_BOUNDS_H

#include "shaders/math/marked.h"
#include "shaders/math/triangle.h"

VKH_LIB_BEGIN

// T around a local origin: its corners to 48 bits and, for lengths and for steering, rounded.
struct Patch {
  Two3 a, b, c;
  Corners at;
};

VKH_FN Patch make_patch(Two3 a, Two3 b, Two3 c) {
  Patch p;
  p.a = a;
  p.b = b;
  p.c = c;
  p.at.a = rounded(a);
  p.at.b = rounded(b);
  p.at.c = rounded(c);
  return p;
}

// `bound` moved by `shift` >= 0, rounded up, as it is kept: a bound below the base is one of the
// base too.
VKH_FN float kept_bound(float bound, float shift) {
  return round_up(max(bound + shift, 0.0f), 1.0f);
}

VKH_FN float max3(vec3 d) { return max(d.x, max(d.y, d.z)); }

// ha for one S, and the exact case where S is closest to all three corners: h(T, S) = max over the
// corners (eq. 5, 11).
VKH_FN float bound_single(vec3 d) { return max3(d); }

// u1, the anchor bound (eq. 6): from one corner, the farther of the other two. `d` bounds the
// corners' distances from B. It is not below 0, nor is u2.
VKH_FN float bound_u1(Patch t, vec3 d) {
  float ab = norm_up(t.at.b - t.at.a);
  float bc = norm_up(t.at.c - t.at.b);
  float ca = norm_up(t.at.a - t.at.c);
  float farther = min(d.x + max(ab, ca), min(d.y + max(ab, bc), d.z + max(bc, ca)));
  return round_up(max(farther, 0.0f), 3.0f);
}

// u2 (eq. 7): every point of T is within g of a corner, g the radius of T's smallest enclosing
// ball. The ball at hand may have another centre; then it is larger, and the bound still holds.
VKH_FN float bound_u2(Patch t, vec3 d) {
  return round_up(max(enclosing_radius_up(t.at) + max3(d), 0.0f), 1.0f);
}

VKH_FN float pick3(vec3 v, uint i) { return choose(i == 0u, v.x, choose(i == 1u, v.y, v.z)); }
VKH_FN Two3 corner_at(Patch t, uint i) {
  Two3 p;
  p.hi = choose(i == 0u, t.a.hi, choose(i == 1u, t.b.hi, t.c.hi));
  p.lo = choose(i == 0u, t.a.lo, choose(i == 1u, t.b.lo, t.c.lo));
  return p;
}

// >= d(p, S) - base, marked.
VKH_FN float corner_distance(Two3 p, Surface s) {
  bool inside;
  float d = surface_distance_up(p, s, inside);
  return marked(d, inside);
}

// d(corner, S) for each corner of T, marked.
VKH_FN vec3 corner_distances(Patch t, Surface s) {
  vec3 d = vec3(0.0f, 0.0f, 0.0f);
  for (uint i = 0u; i < 3u; ++i) {
    float at_corner = corner_distance(corner_at(t, i), s);
    if (i == 0u) d.x = at_corner;
    if (i == 1u) d.y = at_corner;
    if (i == 2u) d.z = at_corner;
  }
  return d;
}

// The cut of T between two surfaces (u3), by a number for each corner that gives its side, < 0 or
// not, and its distance: one corner is alone on its side; the edges from it to the others are
// cut.
struct Cut {
  bool none;  // all corners are on one side
  uint alone;
  uint first, second;  // the other corners, the next and the last
};

VKH_FN Cut cut_by(vec3 side) {
  bool na = side.x < 0.0f;
  bool nb = side.y < 0.0f;
  bool nc = side.z < 0.0f;
  Cut cut;
  cut.none = na == nb && nb == nc;
  cut.alone = choose(na == nb, 2u, choose(na == nc, 1u, 0u));
  cut.first = choose(cut.alone == 2u, 0u, cut.alone + 1u);
  cut.second = choose(cut.alone == 0u, 2u, cut.alone - 1u);
  return cut;
}

// The cut of the edge to the first (k = 0) or second other corner: `side` would be 0 there if it
// were linear. Any cut is right, as both pieces use it. It is off by 10 kUlp2 of T's radius:
// LocalCorners::slack takes it.
VKH_FN Two3 cut_point(Patch t, Cut cut, uint k, vec3 side) {
  uint end = choose(k == 0u, cut.first, cut.second);
  Two3 from = corner_at(t, cut.alone);
  Two3 to = corner_at(t, end);
  float near_from = abs(pick3(side, cut.alone));
  float gap = near_from + abs(pick3(side, end));
  float at =
      choose(gap > kTiny, min(near_from / gap, 1.0f), 0.5f);  // uncertified: any cut is right
  return two_combination(from, at, two_difference(to, from), 0.0f, two(vec3(0.0f, 0.0f, 0.0f)));
}

// At a cut, which both pieces have, the larger of its distances counts.
VKH_FN float bound_cut(Patch t, Cut cut, vec3 side, Surface s, Surface r) {
  Two3 p = cut_point(t, cut, 0u, side);
  Two3 q = cut_point(t, cut, 1u, side);
  float at_p = max(surface_distance_up(p, s), surface_distance_up(p, r));
  float at_q = max(surface_distance_up(q, s), surface_distance_up(q, r));
  return max(at_p, at_q);
}

// The bound at the corners if each counts with the nearer of two surfaces.
VKH_FN float bound_nearer(vec3 ds, vec3 dr) {
  return max(min(ds.x, dr.x), max(min(ds.y, dr.y), min(ds.z, dr.z)));
}

// Whether the point lies above the nearer of two surfaces and beside the other, by its marked
// distances from them.
VKH_FN bool is_beside(float ds, float dr) {
  return both(is_marked(min(ds, dr)), !is_marked(max(ds, dr)));
}

// The root of |ds^2 - dr^2|, from distances above the base. Neither is squared, so that what they
// have in common is not lost.
VKH_FN float root_between(float ds, float dr, float base) {
  return root(abs(ds - dr) * max((ds + dr) + 2.0f * base, 0.0f));
}

// How far T's corners are from the cut of u3 between S and R, by marked distances: cut_point takes
// these numbers for lengths along T's edges. Above two triangles in one plane, at height H and a
// length x from the edge between them, the distances are H and sqrt(H^2 + x^2): their difference is
// no line across the edge, but the root of that of their squares is x. The same holds outside of a
// convex edge. Inside of a concave one both distances are from planes, and their own difference is
// a line. The side of a corner is the nearer surface's in both cases, or bound_nearer would be
// false.
VKH_FN vec3 from_cut(vec3 ds, vec3 dr, float base) {
  bool ab = either(is_beside(ds.x, dr.x), is_beside(ds.y, dr.y));
  if (!either(ab, is_beside(ds.z, dr.z))) return ds - dr;
  return vec3(root_between(ds.x, dr.x, base), root_between(ds.y, dr.y, base),
              root_between(ds.z, dr.z, base));
}

// u3 for a pair of surfaces (eq. 13): T is cut where its distances from them even out, one piece is
// measured against S and the other against R. `ds` and `dr` are corner_distances of both.
VKH_FN float bound_pair(Patch t, Surface s, vec3 ds, Surface r, vec3 dr) {
  Cut cut = cut_by(ds - dr);
  if (cut.none) return min(max3(ds), max3(dr));
  return max(bound_nearer(ds, dr), bound_cut(t, cut, from_cut(ds, dr, s.base), s, r));
}

VKH_LIB_END
#endif
