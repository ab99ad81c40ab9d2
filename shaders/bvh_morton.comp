// What: a Morton code for each face of B. In: vertices, faces, box of their middles. Out: keys[i],
// values[i] = i.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/lib/face_code.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) readonly buffer BoxBlock { CentroidBox box; };
layout(scalar, binding = 3) writeonly buffer Keys { uint keys[]; };
layout(scalar, binding = 4) writeonly buffer Values { uint values[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

void main() {
  uint i = item_index();
  if (i >= push.count) return;
  uvec3 f = faces[i];
  keys[i] =
      face_code(face_middle(vertices[f.x].hi, vertices[f.y].hi, vertices[f.z].hi), box, push.count);
  values[i] = i;
}
