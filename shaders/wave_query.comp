// What: the closest triangle of B to each point of a stream. In: points (the new points, or the
// centroids), each with a triangle to start from; a negative distance means skip. Out: nearest,
// distance; control.maximum[kMaxLower]. An invocation walks for a point of its own, or, where a
// wave has few points, all of a workgroup for one (lib/group_walk.glsl).
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(constant_id = 0) const uint kSwitches = kUseAll;
layout(local_size_x = kQueryGroup) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 2) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 3) buffer Points { Point points[]; };
layout(scalar, binding = 4) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 5) readonly buffer Boxes { Box boxes[]; };
layout(scalar, push_constant) uniform PushBlock { QueryPush push; };

#include "shaders/lib/bvh.glsl"
#include "shaders/lib/generations.glsl"
#include "shaders/lib/dispatch.glsl"
#include "shaders/lib/group_walk.glsl"
#include "shaders/lib/query.glsl"
#include "shaders/lib/stream.glsl"

void main() {
  uint count = push.centroids != 0u ? control.count[kCountSurvivors] : point_count();
  // All of a workgroup for one query, or an invocation for each.
  bool by_group = walks_in_groups(count);
  uint lane = gl_LocalInvocationID.x;
  uint i = by_group ? workgroup_index() : workgroup_index() * kQueryGroup + lane;
  bool mine = i < count && (!by_group || lane == 0u);
  uint at = mine ? i : 0u;
  bool asked = mine && points[at].distance >= 0.0;
  Nearest found = find_nearest(query_at(at), points[at].nearest, asked, by_group);
  raise(kMaxLower, asked ? answer(at, found) : 0.0);
}
