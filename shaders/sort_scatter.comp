// What: moves each key and value to its place for one digit, keeping the order of equal digits.
// In: keys_in, values_in; counts and totals from sort_scan, or, of few blocks, counts from
// sort_count. Out: keys_out, values_out.
// Each subgroup owns a contiguous run of the block, so that its own counters, taken round by round,
// keep the order; lanes of equal digit find each other by ballots. 16-bit counters, two a word: a
// block has 2048 keys.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "shaders/gpu_types.h"
#include "shaders/lib/invocation.glsl"
#include "shaders/lib/sort.glsl"

layout(local_size_x = kSortGroup) in;
layout(scalar, binding = 0) readonly buffer KeysIn { uint keys_in[]; };
layout(scalar, binding = 1) readonly buffer ValuesIn { uint values_in[]; };
layout(scalar, binding = 2) writeonly buffer KeysOut { uint keys_out[]; };
layout(scalar, binding = 3) writeonly buffer ValuesOut { uint values_out[]; };
layout(scalar, binding = 4) readonly buffer Counts { uint counts[]; };
layout(scalar, binding = 5) readonly buffer Totals { uint totals[]; };
layout(scalar, binding = 6) readonly buffer KeyCount { uint key_count; };
layout(scalar, push_constant) uniform PushBlock { SortPush push; };

const uint kMaxSubgroups =
    kSortGroup / 8u;                 // uncertified: integers. Subgroups are 8 wide or wider.
const uint kRow = kSortDigits / 2u;  // uncertified: integers
shared uint counters[kMaxSubgroups * kRow];
shared uint digit_base[kSortDigits];
shared uint block_base[kSortDigits];  // of them in this block

// Lanes of this subgroup whose digit equals ours.
uvec4 peers_of(uint digit) {
  uvec4 peers = subgroupBallot(true);
  for (uint bit = 0u; bit < 8u; ++bit) {
    bool set = ((digit >> bit) & 1u) != 0u;
    uvec4 with_bit = subgroupBallot(set);
    peers &= set ? with_bit : ~with_bit;
  }
  return peers;
}

// How many keys have the digit `lane`. Out: block_base[lane], how many of them are in earlier
// blocks.
uint total_of(uint lane, uint block) {
  uint blocks = sort_blocks(key_count);
  if (blocks > kSortFewBlocks) {
    block_base[lane] = counts[lane * blocks + block];
    return totals[lane];
  }
  uint total = 0u;
  for (uint b = 0u; b < blocks; ++b) {
    if (b == block) block_base[lane] = total;
    total += counts[lane * blocks + b];
  }
  return total;
}

// Exclusive sum of the totals over digits: where each digit starts in the output.
void scan_totals(uint lane, uint block) {
  uint own = total_of(lane, block);
  digit_base[lane] = own;
  barrier();
  for (uint reach = 1u; reach < kSortDigits; reach *= 2u) {
    uint before = lane >= reach ? digit_base[lane - reach] : 0u;
    barrier();
    digit_base[lane] += before;
    barrier();
  }
  uint inclusive = digit_base[lane];
  barrier();
  digit_base[lane] = inclusive - own;
}

// Turns the subgroups' counters of one digit into exclusive sums over the subgroups.
void scan_subgroups(uint word) {
  uint running = 0u;
  for (uint s = 0u; s < gl_NumSubgroups; ++s) {
    uint here = counters[s * kRow + word];
    counters[s * kRow + word] = running;
    running += here;
  }
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint block = workgroup_index();
  uint blocks = sort_blocks(key_count);
  if (block >= blocks) return;
  for (uint i = lane; i < kMaxSubgroups * kRow; i += kSortGroup) counters[i] = 0u;
  scan_totals(lane, block);
  barrier();
  uint run = block * kSortBlock + gl_SubgroupID * (gl_SubgroupSize * kSortRounds) +
             gl_SubgroupInvocationID;
  uint rank[kSortRounds];
  for (uint round = 0u; round < kSortRounds; ++round) {
    uint i = run + round * gl_SubgroupSize;
    // Past the end every key counts as the last digit: such lanes stand after all others and push
    // none of them away.
    uint digit = i < key_count ? (keys_in[i] >> push.shift) & 255u : 255u;
    uvec4 peers = peers_of(digit);
    uint leader = subgroupBallotFindLSB(peers);
    uint shift = 16u * (digit & 1u);
    uint before = 0u;
    if (gl_SubgroupInvocationID == leader) {
      before = atomicAdd(counters[gl_SubgroupID * kRow + (digit >> 1)],
                         subgroupBallotBitCount(peers) << shift);
    }
    before = (subgroupShuffle(before, leader) >> shift) & 0xffffu;
    rank[round] = before + subgroupBallotExclusiveBitCount(peers);
    subgroupMemoryBarrierShared();
    subgroupBarrier();
  }
  barrier();
  if (lane < kRow) scan_subgroups(lane);
  barrier();
  for (uint round = 0u; round < kSortRounds; ++round) {
    uint i = run + round * gl_SubgroupSize;
    if (i >= key_count) break;
    uint key = keys_in[i];
    uint digit = (key >> push.shift) & 255u;
    uint earlier =
        (counters[gl_SubgroupID * kRow + (digit >> 1)] >> (16u * (digit & 1u))) & 0xffffu;
    uint place = digit_base[digit] + block_base[digit] + earlier + rank[round];
    keys_out[place] = key;
    values_out[place] = values_in[i];
  }
}
