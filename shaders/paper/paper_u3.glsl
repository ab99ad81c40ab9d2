// The paper's u3 of a candidate by the triangles closest to its corners. The kernel declares what
// base/surface.glsl needs.
#ifndef VKH_SHADERS_PAPER_PAPER_U3_GLSL
#define VKH_SHADERS_PAPER_PAPER_U3_GLSL

#include "shaders/base/surface.glsl"
#include "shaders/paper/bounds_paper.h"

// The corners have two triangles between them: the first has corner `alone`, the second the others.
// Huge if the two have no corner in common.
float bisector_bound(Patch t, uint first, uint second, View view) {
  Surface s = load_surface(first, view);
  Surface r = load_surface(second, view);
  vec3 at;
  if (!share_corner(s.at, r.at, at)) return 3.0e38;
  return bound_bisector(t, s, corner_distances(t, s), r, corner_distances(t, r), at);
}

float thirds_bound(Patch t, uvec3 nearest, View view) {
  float worst = -3.0e38;
  for (uint i = 0u; i < 3u; ++i) {
    Surface s = load_surface(nearest[i], view);
    float d = surface_distance_up(corner_at(t, i), s);
    worst = max(worst, bound_third(t, i, s, d));
  }
  return worst;
}

// Returns u3 above the base, without the position's slack. h(T, S) for each S alone, which eq. 10
// takes into the minimum, is ha's; if one triangle is closest to all corners, nothing is left to
// do.
float paper_u3(Patch t, uvec3 nearest, View view) {
  bool ab = nearest.x == nearest.y;
  bool bc = nearest.y == nearest.z;
  bool ca = nearest.z == nearest.x;
  if (ab && bc) return 3.0e38;
  float u3 = 3.0e38;
  if (ab) u3 = bisector_bound(t, nearest.z, nearest.x, view);
  if (bc) u3 = bisector_bound(t, nearest.x, nearest.y, view);
  if (ca) u3 = bisector_bound(t, nearest.y, nearest.z, view);
  return u3 < 3.0e38 ? u3 : thirds_bound(t, nearest, view);
}

#endif
