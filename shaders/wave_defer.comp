// What: keeps the candidates that this wave does not refine: copies them to the same places of the
// next frontier. In: frontier[0, deferred). Out: frontier's writing half, kMaxNext.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 2) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 3) readonly buffer Faces { uvec3 faces[]; };

#include "shaders/lib/candidate.glsl"
#include "shaders/lib/stream.glsl"

void main() {
  uint i = item_index();
  bool held = i < control.deferred;
  Candidate c = frontier[reading(held ? i : 0u)];
  raise(kMaxNext, held ? c.upper : 0.0);
  if (held) frontier[writing(i)] = c;
}
