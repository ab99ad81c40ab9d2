// Computes where each block's keys of a digit start among all keys of that digit, and how many keys
// have it. In: counts[block * kSortDigits + digit]. Out: counts, summed exclusively along each
// digit; totals[digit]. There is one workgroup per digit; if blocks are few, sort_scatter does it.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/bvh/sort.glsl"

layout(local_size_x = kSortGroup) in;
layout(scalar, binding = 0) buffer Counts { uint counts[]; };
layout(scalar, binding = 1) writeonly buffer Totals { uint totals[]; };
layout(scalar, binding = 2) readonly buffer KeyCount { uint key_count; };
layout(scalar, push_constant) uniform PushBlock { SortPush push; };

#include "shaders/bvh/key_total.glsl"

shared uint sums[kSortGroup];

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint blocks = sort_blocks(key_total());
  uint digit = gl_WorkGroupID.x;
  uint per_lane = (blocks + kSortGroup - 1u) / kSortGroup;
  uint begin = min(lane * per_lane, blocks);
  uint end = min(begin + per_lane, blocks);
  uint sum = 0u;
  for (uint i = begin; i < end; ++i) sum += counts[i * kSortDigits + digit];
  sums[lane] = sum;
  barrier();
  for (uint reach = 1u; reach < kSortGroup; reach *= 2u) {
    uint before = lane >= reach ? sums[lane - reach] : 0u;
    barrier();
    sums[lane] += before;
    barrier();
  }
  uint running = sums[lane] - sum;
  for (uint i = begin; i < end; ++i) {
    uint here = counts[i * kSortDigits + digit];
    counts[i * kSortDigits + digit] = running;
    running += here;
  }
  if (lane == kSortGroup - 1u) totals[digit] = sums[lane];
}
