// Counts how often each digit occurs in each block of keys. In: keys; their number, from a buffer
// if only the device knows it, as with the frontier. Out: counts[block * kSortDigits + digit].
// It is the first of the radix sort's three kernels per pass: count, scan, scatter. If passes count
// for each other, it runs in the first at most: not if the kernel that wrote the keys has counted
// (bvh_morton).
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/base/invocation.glsl"
#include "shaders/bvh/sort.glsl"

layout(local_size_x = kSortGroup) in;
layout(scalar, binding = 0) readonly buffer Keys { uint keys[]; };
layout(scalar, binding = 1) writeonly buffer Counts { uint counts[]; };
layout(scalar, binding = 2) readonly buffer KeyCount { uint key_count; };
layout(scalar, push_constant) uniform PushBlock { SortPush push; };

#include "shaders/bvh/key_total.glsl"

shared uint histogram[kSortDigits];

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint block = workgroup_index();
  uint total = key_total();
  uint blocks = sort_blocks(total, push.rounds);
  if (block >= blocks) return;
  uint first = block * push.rounds * kSortGroup + lane;
  // Loads all keys before any is counted: no load waits for a counter.
  uint key[kSortRounds];
  for (uint round = 0u; round < kSortRounds; ++round) {
    if (round >= push.rounds) continue;
    key[round] = keys[min(first + round * kSortGroup, total - 1u)];
  }
  histogram[lane] = 0u;
  barrier();
  for (uint round = 0u; round < kSortRounds; ++round) {
    if (round >= push.rounds || first + round * kSortGroup >= total) continue;
    atomicAdd(histogram[(key[round] >> push.shift) & 255u], 1u);
  }
  barrier();
  counts[block * kSortDigits + lane] = histogram[lane];
}
