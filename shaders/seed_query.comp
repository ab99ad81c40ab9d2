// What: the closest triangle of B to each vertex of A, in plain floats.
// In: vertices; vertex_nearest from seed_mark. Out: vertex_nearest, vertex_distance;
// control.maximum[kMaxVertex].
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Nodes { Node nodes[]; };
layout(scalar, binding = 2) readonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 3) buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 4) writeonly buffer VertexDistance { float vertex_distance[]; };
layout(scalar, binding = 5) buffer ControlBlock { Control control; };
layout(scalar, binding = 6) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

#include "shaders/lib/bvh.glsl"
#include "shaders/lib/stream.glsl"

void main() {
  uint i = item_index();
  float d = 0.0;
  if (i < push.count && vertex_nearest[i] != kNone) {
    Two3 p = Two3(vertices[i].hi, vertices[i].lo);
    Nearest found = nearest_triangle(Query(p, 0.0, false), kNone);
    d = found.above;
    vertex_nearest[i] = found.triangle;
    vertex_distance[i] = d;
  }
  raise(kMaxVertex, d);
}
