// u4: the pair of corners' own closest points, as points (eq. 12), for the two corners at the
// shortest edge. The kernel declares what wave/candidate.glsl and base/surface.glsl need.
#ifndef VKH_SHADERS_PAPER_BOUND_U4_GLSL
#define VKH_SHADERS_PAPER_BOUND_U4_GLSL

#include "shaders/base/surface.glsl"
#include "shaders/wave/candidate.glsl"

Surface closest_point_surface(Two3 corner, uint triangle, View view) {
  Surface s = load_surface(triangle, view);
  Two3 offset = offset_from(corner, s, closest_point(rounded(corner), s.at));
  s.a = two_difference(
      corner,
      offset);  // its own rounding is under the slack, which counts for this point and for the next
  s.b = s.a;
  s.c = s.a;
  s.at = Corners(rounded(s.a), rounded(s.a), rounded(s.a));
  s.slack = round_up(2.0f * s.slack, 2.0f);
  return s;
}

float bound_u4(Patch t, uvec3 nearest, View view, float shift) {
  uint opposite = opposite_longest(Corners(t.at.a, t.at.b, t.at.c));
  Surface s[3];
  s[0] = closest_point_surface(t.a, nearest.x, view);
  s[1] = closest_point_surface(t.b, nearest.y, view);
  s[2] = closest_point_surface(t.c, nearest.z, view);
  float u4 = 3.0e38;
  for (uint k = 0u; k < 3u; ++k) {
    if (k == opposite) continue;
    vec3 da = corner_distances(t, s[opposite]);
    vec3 db = corner_distances(t, s[k]);
    u4 = min(u4, kept_bound(bound_pair(t, s[opposite], da, s[k], db), shift));
  }
  return u4;
}

#endif
