// What: the wave's first step (wave/split.glsl) where `query` does not do it: on CPU devices, and
// where the frontier is sorted or points are asked for in packets. In: the frontier's reading half.
// Out: splits; points[points_each() i + k], started from the best triangle known to the candidate,
// a negative distance where it is not to be queried; deferred candidates and kMaxNext.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/gpu_types.h"

layout(constant_id = 0) const uint kSwitches = kUseAll;
layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 2) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 3) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 4) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 5) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 6) writeonly buffer Splits { Split splits[]; };
layout(scalar, binding = 7) writeonly buffer Points { Point points[]; };
layout(scalar, binding = 8) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 9) buffer Areas { Area areas[]; };
layout(scalar, binding = 10) readonly buffer Order { uint order[]; };
layout(scalar, binding = 11) buffer CentroidNearest { uint centroid_nearest[]; };

#include "shaders/walk/walk.glsl"
#include "shaders/candidate/candidate.glsl"
#include "shaders/candidate/centroid.glsl"
#include "shaders/base/coverage.glsl"
#include "shaders/candidate/dispatch.glsl"
#include "shaders/base/stream.glsl"
#include "shaders/wave/split.glsl"

void write_points(uint lane, Refined r, uint group) {
  for (uint k = lane; k < points_each(); k += split_lanes()) {
    NewPoint n = new_point(k, r, group);
    points[points_each() * r.place + k] = Point(n.p.hi, n.start, n.p.lo, n.asked ? 0.0 : -1.0);
  }
}

void main() {
  uint item = item_index() / split_lanes();
  uint lane = item_index() % split_lanes();
  uint group = gl_LocalInvocationID.x / split_lanes();
  Refined r = refine(item, lane == 0u, group);
  if (r.place != kNone) write_points(lane, r, group);
  keep_split(r, lane == 0u, group);
}
