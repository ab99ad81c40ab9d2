// What: adopts the last wave's witness and clears the certified lower bound. One workgroup.
// In: the streams of the last wave. Out: control.witness; lower_bits as those of a huge float.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"

layout(constant_id = 0) const uint kSwitches = kUseAll;
layout(local_size_x = kPlanGroup) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) writeonly buffer LowerBits { uint lower_bits[]; };
layout(scalar, binding = 2) readonly buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 3) readonly buffer Splits { Split splits[]; };
layout(scalar, binding = 4) readonly buffer Points { Point points[]; };
layout(scalar, binding = 5) readonly buffer Survivors { uint survivors[]; };
layout(scalar, binding = 6) readonly buffer Centroids { Point centroids[]; };
layout(scalar, binding = 7) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 8) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 9) readonly buffer VertexNearest { uint vertex_nearest[]; };

#include "shaders/lib/candidate.glsl"
#include "shaders/lib/child.glsl"
#include "shaders/lib/witness.glsl"

const uint kAdoptGroup = kPlanGroup;
#include "shaders/lib/adopt.glsl"
#include "shaders/lib/morton.h"

void main() {
  adopt_witness();
  if (gl_LocalInvocationID.x == 0u) lower_bits[0] = ordered_bits(floatBitsToUint(3.0e38));
}
