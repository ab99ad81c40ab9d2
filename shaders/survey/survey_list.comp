// Lists the chosen cells in their order: the cells above the key, and then the cells with this key.
// In: keys, blocks, wave. Out: parents, their places. A workgroup for each block.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Keys { uint keys[]; };
layout(scalar, binding = 1) readonly buffer Blocks { SurveyCounts blocks[]; };
layout(scalar, binding = 2) writeonly buffer Parents { uint parents[]; };
layout(scalar, binding = 3) readonly buffer WaveBlock { SurveyWave wave; };

#include "shaders/survey/chosen.glsl"

shared uint above[kGroupSize];
shared uint ties[kGroupSize];

// Counts what is chosen before the invocation's cells.
SurveyCounts counts_before() {
  uint lane = gl_LocalInvocationID.x;
  SurveyCounts own = counts_of_lane();
  above[lane] = own.above;
  ties[lane] = own.ties;
  barrier();
  for (uint reach = 1u; reach < kGroupSize; reach *= 2u) {
    uint above_before = lane >= reach ? above[lane - reach] : 0u;
    uint ties_before = lane >= reach ? ties[lane - reach] : 0u;
    barrier();
    above[lane] += above_before;
    ties[lane] += ties_before;
    barrier();
  }
  SurveyCounts of_block = blocks[workgroup_index()];
  return SurveyCounts(of_block.above + above[lane] - own.above,
                      of_block.ties + ties[lane] - own.ties);
}

void main() {
  SurveyCounts before = counts_before();
  uint first = first_of_lane();
  for (uint k = 0u; k < kCellsOfLane; ++k) {
    uint i = first + k;
    if (is_above(i)) parents[before.above++] = i;
    if (is_tie(i) && before.ties < wave.ties) parents[wave.above + before.ties] = i;
    if (is_tie(i)) ++before.ties;
  }
}
