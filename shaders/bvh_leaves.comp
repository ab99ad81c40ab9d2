// What: B's triangles in Morton order. In: keys and values (sorted codes and face numbers),
// vertices, faces. Out: triangles, triangle_lows, codes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/lib/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) readonly buffer Values { uint values[]; };
layout(scalar, binding = 3) buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 4) writeonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 5) readonly buffer Keys { uint keys[]; };
layout(scalar, binding = 6) writeonly buffer Codes { uint codes[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

void main() {
  uint i = item_index();
  if (i >= push.count) return;
  codes[i] = keys[i];
  // Clamped: whatever the sort did, a triangle is one of B, and upper bounds from it are true.
  uint face = min(values[i], push.count - 1u);
  uvec3 f = faces[face];
  triangles[i].a = vertices[f.x].hi;
  triangles[i].b = vertices[f.y].hi;
  triangles[i].c = vertices[f.z].hi;
  triangles[i].face = face;
  triangle_lows[i] = TriangleLow(vertices[f.x].lo, vertices[f.y].lo, vertices[f.z].lo);
}
