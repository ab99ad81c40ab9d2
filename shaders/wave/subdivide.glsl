// The work of wave_subdivide, and of paper_subdivide in the order of the sort. The kernel declares
// `points`, and what wave/split.glsl needs.
#ifndef VKH_SHADERS_WAVE_SUBDIVIDE_GLSL
#define VKH_SHADERS_WAVE_SUBDIVIDE_GLSL

#include "shaders/base/invocation.glsl"
#include "shaders/wave/split.glsl"

void write_points(uint lane, Refined r, uint group) {
  for (uint k = lane; k < points_each(); k += split_lanes()) {
    NewPoint n = new_point(k, r, group);
    points[points_each() * r.slot + k] = Point(n.p.hi, n.start, n.p.lo, n.asked ? 0.0 : -1.0);
  }
}

void subdivide() {
  uint item = item_index() / split_lanes();
  uint lane = item_index() % split_lanes();
  uint group = gl_LocalInvocationID.x / split_lanes();
  Refined r = refine(item, lane == 0u, group);
  if (r.slot != kNone) write_points(lane, r, group);
  keep_split(r, lane == 0u, group);
}

#endif
