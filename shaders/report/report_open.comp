// Adds, for --verify, the area of every candidate that is still in the frontier to the open half of
// `areas`, one item per candidate, including the candidates that the plan closed as a whole,
// deferred or spilled. In: frontier; areas[face_count, 2 face_count) cleared. Out: the same areas.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/base/switches.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 2) buffer Areas { Area areas[]; };

#include "shaders/base/coverage.glsl"

void main() {
  uint i = item_index();
  if (i >= control.count[kCountFrontier]) return;
  Candidate c = frontier[control.parity * control.capacity + i];
  if (c.root >= control.face_count) return;  // a subroot, which counts as closed
  add_area(control.face_count + c.root, unpack_corners(c.corners));
}
