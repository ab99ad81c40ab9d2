// What: writes the seed's witness and base into the control block. One invocation. In:
// control.seed_witness from seed_witness; kNone where a warm run's old witness is farther than
// every vertex and stays.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"

layout(local_size_x = 1) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) readonly buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 3) buffer ControlBlock { Control control; };

#include "shaders/lib/base.glsl"

void adopt_corner() {
  uint face = control.seed_witness / 3u;  // uncertified: integers
  uint corner = control.seed_witness % 3u;
  uint vertex = faces[face][corner];
  control.witness =
      Witness(vertices[vertex].hi, uintBitsToFloat(control.maximum[kMaxLower]), face,
              corner == 1u ? kBaryOne : 0u, corner == 2u ? kBaryOne : 0u, vertex_nearest[vertex]);
}

void main() {
  if (control.seed_witness != kNone) adopt_corner();
  control.seed_witness = kNone;
  float base = base_of_run();
  control.base = base;
  control.tight = is_tight(base) ? 1u : 0u;
}
