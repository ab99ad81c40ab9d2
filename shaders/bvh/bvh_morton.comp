// Computes a Morton code for each face of B. In: vertices, faces, box of their middles. Out:
// keys[i], values[i] = i; if push.block, the counts of the sort's first pass (sort_count), which
// were 0; groups_done = 0.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/base/face_code.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) readonly buffer BoxBlock { CentroidBox box; };
layout(scalar, binding = 3) writeonly buffer Keys { uint keys[]; };
layout(scalar, binding = 4) writeonly buffer Values { uint values[]; };
layout(scalar, binding = 5) buffer Counts { uint counts[]; };
layout(scalar, binding = 6) writeonly buffer GroupsDone { uint groups_done; };
layout(scalar, push_constant) uniform PushBlock { MortonPush push; };

void main() {
  uint i = item_index();
  if (i >= push.count) return;
  if (i == 0u) groups_done = 0u;
  uvec3 f = faces[i];
  uint key =
      face_code(face_middle(vertices[f.x].hi, vertices[f.y].hi, vertices[f.z].hi), box, push.count);
  keys[i] = key;
  values[i] = i;
  if (push.block == 0u) return;
  uint block = i / push.block;
  atomicAdd(counts[block * kSortDigits + ((key >> push.first_bit) & 255u)], 1u);
}
