// What: which corner of A is the witness of the first lower bound: the smallest face and corner
// whose distance is the maximum, so that the choice does not depend on scheduling. Out:
// control.seed_witness = 3 * face + corner.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/lib/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 1) readonly buffer VertexDistance { float vertex_distance[]; };
layout(scalar, binding = 2) buffer ControlBlock { Control control; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

void main() {
  uint i = item_index();
  if (i >= push.count) return;
  float lower = uintBitsToFloat(control.maximum[kMaxLower]);
  uvec3 f = faces[i];
  uint corner = vertex_distance[f.x] == lower   ? 0u
                : vertex_distance[f.y] == lower ? 1u
                : vertex_distance[f.z] == lower ? 2u
                                                : kNone;
  if (corner != kNone) atomicMin(control.seed_witness, 3u * i + corner);
}
