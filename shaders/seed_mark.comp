// What: marks the vertices of A that a face uses. Unreferenced vertices are no part of a mesh and
// must not raise the lower bound. In: faces. Out: vertex_distance[v] = 0 for every used v (all
// others keep the negative number that they were filled with). Not vertex_nearest: a warm run
// starts from it.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/lib/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 1) writeonly buffer VertexDistance { float vertex_distance[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

void main() {
  uint i = item_index();
  if (i >= push.count) return;
  uvec3 f = faces[i];
  vertex_distance[f.x] = 0.0;
  vertex_distance[f.y] = 0.0;
  vertex_distance[f.z] = 0.0;
}
