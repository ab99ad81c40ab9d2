// What: the closest triangle of B to each point of a stream. In: points (the new points, or the
// centroids), each with a triangle to start from; a negative distance means skip. Out: nearest,
// distance; control.maximum[kMaxLower].
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Nodes { Node nodes[]; };
layout(scalar, binding = 2) readonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 3) buffer Points { Point points[]; };
layout(scalar, binding = 4) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, push_constant) uniform PushBlock { QueryPush push; };

#include "shaders/lib/bvh.glsl"
#include "shaders/lib/stream.glsl"

void main() {
  uint i = item_index();
  uint count = push.centroids != 0u ? control.count[kCountSurvivors] : 3u * control.parents;
  float d = 0.0;
  if (i < count && points[i].distance >= 0.0) {
    Query q =
        Query(Two3(points[i].position, points[i].position_lo), control.base, control.tight != 0u);
    Nearest found = nearest_triangle(q, points[i].nearest);
    d = max(found.above, 0.0);
    points[i].nearest = found.triangle;
    points[i].distance = d;
  }
  raise(kMaxLower, d);
}
