// The cascade of upper bounds on h(T, B), cheapest first: exact case, u1, u2, ha, u3, u4 (paper.md Appendix A).
//
// T is a sub-triangle of A as computed in a local frame, S a triangle of B in the same frame. Each bound holds in exact
// arithmetic for the computed T; the caller adds position_slack for the distance from it to the exact one.
// All of them rest on three facts. d(., B) <= d(., S). d(., S) is convex, since S is, so its maximum over a polygon is at a
// corner. d(., B) is 1-Lipschitz.
#ifndef VKH_SHADERS_LIB_BOUNDS_H
#define VKH_SHADERS_LIB_BOUNDS_H

#include "shaders/lib/triangle.h"

VKH_LIB_BEGIN

// T and the largest distance of its corners from the local origin.
struct Patch {
  Corners at;
  float radius;
};

// S likewise, with the slack that its distances from points of T need.
struct Surface {
  Corners at;
  float slack;
};

VKH_FN Patch make_patch(Corners t) {
  Patch p;
  p.at = t;
  p.radius = radius_up(t);
  return p;
}

// `p_radius` >= every |p| whose distance will be asked. The points that bound_pair puts on T's edges lie within
// 5 ulp of the patch radius of the exact ones (2 + 2 for the weighted edge, 1 for the sum); that is taken here, once.
VKH_FN Surface make_surface(Corners s, float p_radius) {
  Surface f;
  f.at = s;
  f.slack = distance_slack(p_radius, radius_up(s)) + round_up(5.25f * kUlp * p_radius, 4.0f);
  return f;
}

VKH_FN float surface_distance_up(vec3 p, Surface s) {
  return round_up(distance_up(closest_point(p, s.at)) + s.slack, 1.0f);
}

// d(corner, S) for each corner of T.
VKH_FN vec3 corner_distances(Patch t, Surface s) {
  return vec3(surface_distance_up(t.at.a, s), surface_distance_up(t.at.b, s),
              surface_distance_up(t.at.c, s));
}

VKH_FN float max3(vec3 d) { return max(d.x, max(d.y, d.z)); }

// ha for one S, and the exact case where S is closest to all three corners: h(T, S) = max over the corners (eq. 5, 11).
VKH_FN float bound_single(vec3 d) { return max3(d); }

// u1, the anchor bound (eq. 6): from one corner, the farther of the other two. `d` bounds the corners' distances from B.
VKH_FN float bound_u1(Patch t, vec3 d) {
  float ab = norm_up(t.at.b - t.at.a);
  float bc = norm_up(t.at.c - t.at.b);
  float ca = norm_up(t.at.a - t.at.c);
  return round_up(min(d.x + max(ab, ca), min(d.y + max(ab, bc), d.z + max(bc, ca))), 3.0f);
}

// u2 (eq. 7): every point of T is within g of a corner, g the radius of T's smallest enclosing ball. The ball at hand may have
// another centre; then it is larger, and the bound still holds.
VKH_FN float bound_u2(Patch t, vec3 d) {
  return round_up(enclosing_radius_up(t.at) + max3(d), 2.0f);
}

VKH_FN float pick3(vec3 v, uint i) { return i == 0u ? v.x : (i == 1u ? v.y : v.z); }
VKH_FN vec3 corner_at(Corners t, uint i) { return i == 0u ? t.a : (i == 1u ? t.b : t.c); }

// One edge of T, from a corner nearer to S to one nearer to R, cut where the distances even out if both were linear. Any cut is
// right, as both pieces use it; at the cut, the larger of the two distances counts.
VKH_FN float cut_distance(vec3 from, vec3 to, float excess_from, float excess_to, Surface s, Surface r) {
  float gap = abs(excess_from) + abs(excess_to);
  float cut = gap > kTiny ? min(abs(excess_from) / gap, 1.0f) : 0.5f;  // uncertified: any cut is right
  vec3 p = from + cut * (to - from);
  return max(surface_distance_up(p, s), surface_distance_up(p, r));
}

// u3 for a pair of surfaces (eq. 9, and algorithm.md §4.4): T is cut in two where its distances from them even out, one piece
// is measured against S and the other against R. `ds` and `dr` are corner_distances of both.
VKH_FN float bound_pair(Patch t, Surface s, vec3 ds, Surface r, vec3 dr) {
  vec3 excess = ds - dr;  // < 0: nearer to S
  bool na = excess.x < 0.0f;
  bool nb = excess.y < 0.0f;
  bool nc = excess.z < 0.0f;
  if (na == nb && nb == nc) return na ? max3(ds) : max3(dr);
  uint alone = na == nb ? 2u : (na == nc ? 1u : 0u);
  uint i = alone == 2u ? 0u : alone + 1u;
  uint j = alone == 0u ? 2u : alone - 1u;
  vec3 p = corner_at(t.at, alone);
  float corners = max(min(ds.x, dr.x), max(min(ds.y, dr.y), min(ds.z, dr.z)));
  float ci = cut_distance(p, corner_at(t.at, i), pick3(excess, alone), pick3(excess, i), s, r);
  float cj = cut_distance(p, corner_at(t.at, j), pick3(excess, alone), pick3(excess, j), s, r);
  return max(corners, max(ci, cj));
}

VKH_LIB_END
#endif
