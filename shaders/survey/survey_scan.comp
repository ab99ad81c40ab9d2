// Sums the blocks' counts: each block gets the sum over the blocks before it. In: wave. In and out:
// blocks. One workgroup.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"

layout(local_size_x = kSortGroup) in;
layout(scalar, binding = 0) buffer Blocks { SurveyCounts blocks[]; };
layout(scalar, binding = 1) readonly buffer WaveBlock { SurveyWave wave; };

shared uint above[kSortGroup];
shared uint ties[kSortGroup];

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint count = (wave.live + kSurveyBlock - 1u) / kSurveyBlock;
  uint per_lane = (count + kSortGroup - 1u) / kSortGroup;
  uint begin = min(lane * per_lane, count);
  uint end = min(begin + per_lane, count);
  SurveyCounts sum = SurveyCounts(0u, 0u);
  for (uint i = begin; i < end; ++i) {
    sum.above += blocks[i].above;
    sum.ties += blocks[i].ties;
  }
  above[lane] = sum.above;
  ties[lane] = sum.ties;
  barrier();
  for (uint reach = 1u; reach < kSortGroup; reach *= 2u) {
    uint above_before = lane >= reach ? above[lane - reach] : 0u;
    uint ties_before = lane >= reach ? ties[lane - reach] : 0u;
    barrier();
    above[lane] += above_before;
    ties[lane] += ties_before;
    barrier();
  }
  SurveyCounts running = SurveyCounts(above[lane] - sum.above, ties[lane] - sum.ties);
  for (uint i = begin; i < end; ++i) {
    SurveyCounts here = blocks[i];
    blocks[i] = running;
    running.above += here.above;
    running.ties += here.ties;
  }
}
