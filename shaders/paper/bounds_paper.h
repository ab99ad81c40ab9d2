// The paper's u3 (Appendix A, after Kang et al. 2018): T cut along the bisector of two
// triangles' supporting planes, or into three quadrilaterals by midpoints and centroid. As in
// bounds.h any cut is right, since the pieces share its points: the plane and the centroid only
// steer, and distances at the corners of the pieces bound them.
#ifndef VKH_SHADERS_PAPER_BOUNDS_PAPER_H
#define VKH_SHADERS_PAPER_BOUNDS_PAPER_H

#include "shaders/math/bounds.h"

VKH_LIB_BEGIN

VKH_FN vec3 corner_position(Corners t, uint i) { return i == 0u ? t.a : (i == 1u ? t.b : t.c); }

// Whether S and R share an edge or a vertex: one of `s` is one of `r`; then `at` is it.
VKH_FN bool share_corner(Corners s, Corners r, VKH_OUT(vec3) at) {
  at = s.a;
  for (uint i = 0u; i < 3u; ++i) {
    for (uint j = 0u; j < 3u; ++j) {
      vec3 from = corner_position(s, i) - corner_position(r, j);
      if (dot3(from, from) > 0.0f) continue;
      at = corner_position(s, i);
      return true;
    }
  }
  return false;
}

// The plane through `at` that halves the angle between the planes of S and R and has S on the side
// where dot3(p - at, normal) < 0, as far as one of the two such planes has.
VKH_FN vec3 bisector_normal(Corners s, Corners r, vec3 at) {
  vec3 n = cross3(s.b - s.a, s.c - s.a);
  vec3 m = cross3(r.b - r.a, r.c - r.a);
  vec3 p = norm_up(m) * n;
  vec3 q = norm_up(n) * m;
  // Three times the centres, from `at`.
  vec3 to_s = (s.a - at) + (s.b - at) + (s.c - at);
  vec3 to_r = (r.a - at) + (r.b - at) + (r.c - at);
  vec3 normal = p + q;
  if (dot3(normal, to_s) * dot3(normal, to_r) >= 0.0f) normal = p - q;
  return dot3(normal, to_s) > dot3(normal, to_r) ? -normal : normal;
}

// Case 1 (eq. 9): the corners with side < 0 and the part next to them against S, the others against
// R, the cuts against both. `ds` and `dr` are corner_distances.
VKH_FN float bound_split(Patch t, Surface s, vec3 ds, Surface r, vec3 dr, vec3 side) {
  Cut cut = cut_by(side);
  if (cut.none) return side.x < 0.0f ? max3(ds) : max3(dr);
  float corners = max(side.x < 0.0f ? ds.x : dr.x,
                      max(side.y < 0.0f ? ds.y : dr.y, side.z < 0.0f ? ds.z : dr.z));
  return max(corners, bound_cut(t, cut, side, s, r));
}

VKH_FN float bound_bisector(Patch t, Surface s, vec3 ds, Surface r, vec3 dr, vec3 at) {
  vec3 n = bisector_normal(s.at, r.at, at);
  vec3 side = vec3(dot3(t.at.a - at, n), dot3(t.at.b - at, n), dot3(t.at.c - at, n));
  return bound_split(t, s, ds, r, dr, side);
}

VKH_FN Two3 middle_between(Two3 p, Two3 q) {
  return two_combination(two(vec3(0.0f, 0.0f, 0.0f)), 0.5f, p, 0.5f, q);
}

// One of three pieces in case 2 (eq. 10): the quadrilateral of corner i, the middles of its edges
// and the centroid, against S; the other two have the same points. `d` is corner i's distance from
// S. The points are off by 4 kUlp2 of T's radius, less than cuts are (cut_point). Twice the weight
// is under 1, so the centroid at hand lies in T.
VKH_FN float bound_third(Patch t, uint i, Surface s, float d) {
  uint j = i == 2u ? 0u : i + 1u;
  uint k = i == 0u ? 2u : i - 1u;
  Two3 p = corner_at(t, i);
  Two3 q = corner_at(t, j);
  Two3 r = corner_at(t, k);
  Two3 centre = two_combination(t.a, 0.33333334f, two_difference(t.b, t.a), 0.33333334f,
                                two_difference(t.c, t.a));
  float middles = max(surface_distance_up(middle_between(p, q), s),
                      surface_distance_up(middle_between(r, p), s));
  return max(d, max(middles, surface_distance_up(centre, s)));
}

VKH_LIB_END
#endif
