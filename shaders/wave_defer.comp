// What: copies the candidates that this wave does not refine into the next frontier. In:
// frontier[parents, parents + deferred). Out: frontier's writing half. One that the risen lower
// bound closes stays behind; its u is kept.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(constant_id = 0) const uint kSwitches = kUseAll;
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
  Candidate c = frontier[reading(held ? control.parents + i : 0u)];
  bool closed = held && c.upper <= cull_threshold((kSwitches & kUseToleranceCull) != 0u);
  count_culled(kCullLowerRaised, closed);
  raise(kMaxDropped, closed ? c.upper : 0.0);
  bool open = held && !closed;
  raise(kMaxNext, open ? c.upper : 0.0);
  uint slot = stream_append(kCountNext, open);
  if (open) frontier[writing(slot)] = c;
}
