// What: B's triangles where their vertices are now, in the order that they were sorted in. In:
// triangles[].face, vertices, faces. Out: triangles, triangle_lows.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/lib/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 3) writeonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

void main() {
  uint i = item_index();
  if (i >= push.count) return;
  // Clamped, as in bvh_leaves: a triangle is one of B, whatever the memory held.
  uint face = min(triangles[i].face, push.count - 1u);
  uvec3 f = faces[face];
  triangles[i].a = vertices[f.x].hi;
  triangles[i].b = vertices[f.y].hi;
  triangles[i].c = vertices[f.z].hi;
  triangles[i].face = face;
  triangle_lows[i] = TriangleLow(vertices[f.x].lo, vertices[f.y].lo, vertices[f.z].lo);
}
