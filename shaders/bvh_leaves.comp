// What: B's triangles in Morton order. In: values (sorted face numbers), positions, faces. Out: triangles.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/lib/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Positions { vec3 positions[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) readonly buffer Values { uint values[]; };
layout(scalar, binding = 3) buffer Triangles { Triangle triangles[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

void main() {
  uint i = item_index();
  if (i >= push.count) return;
  uint face = values[i];
  uvec3 f = faces[face];
  triangles[i].a = positions[f.x];
  triangles[i].b = positions[f.y];
  triangles[i].c = positions[f.z];
  triangles[i].face = face;
}
