// Counts the cells of each block that a wave may split. In: keys, wave. Out: blocks, one per
// workgroup.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Keys { uint keys[]; };
layout(scalar, binding = 1) writeonly buffer Blocks { SurveyCounts blocks[]; };
layout(scalar, binding = 2) readonly buffer WaveBlock { SurveyWave wave; };

#include "shaders/survey/chosen.glsl"

shared uint above, ties;

void main() {
  if (gl_LocalInvocationID.x == 0u) above = ties = 0u;
  barrier();
  SurveyCounts n = counts_of_lane();
  atomicAdd(above, n.above);
  atomicAdd(ties, n.ties);
  barrier();
  if (gl_LocalInvocationID.x == 0u) blocks[workgroup_index()] = SurveyCounts(above, ties);
}
