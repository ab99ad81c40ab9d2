// Moves each key and value to its place for one digit, keeping the order of equal digits. In:
// keys_in, values_in; counts and totals from sort_scan, or, if blocks are few, counts from
// sort_count, from the writer of the keys or from the pass before. Out: keys_out, values_out, and
// the next pass's counts if this one counts for it. Each subgroup owns a contiguous run of the
// block, so that its counters, taken round by round, keep the order; lanes of equal digit find each
// other by ballots. 16-bit counters, two a word: a block has 2048 keys at most. If there are more
// subgroups than counters, neighbours share them, one after the other.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "shaders/gpu_types.h"
#include "shaders/base/invocation.glsl"
#include "shaders/base/subgroup.glsl"
#include "shaders/bvh/sort.glsl"

layout(local_size_x = kSortGroup) in;
layout(scalar, binding = 0) readonly buffer KeysIn { uint keys_in[]; };
layout(scalar, binding = 1) readonly buffer ValuesIn { uint values_in[]; };
layout(scalar, binding = 2) writeonly buffer KeysOut { uint keys_out[]; };
layout(scalar, binding = 3) writeonly buffer ValuesOut { uint values_out[]; };
layout(scalar, binding = 4) buffer Counts { uint counts[]; };
layout(scalar, binding = 5) readonly buffer Totals { uint totals[]; };
layout(scalar, binding = 6) readonly buffer KeyCount { uint key_count; };
layout(scalar, push_constant) uniform PushBlock { SortPush push; };

#include "shaders/bvh/key_total.glsl"

const uint kMaxSubgroups = kSortGroup / kNarrowestSubgroup;
const uint kRows = 16u;  // of counters, 8 KiB: one each for subgroups that are 16 wide or wider
const uint kRow = kSortDigits / 2u;
const uint kBatch = 8u;  // loads of counts that do not wait for each other
shared uint counters[kRows * kRow];
shared uint digit_base[kSortDigits];  // places of the block's keys of a digit
shared uint subgroup_sum[kMaxSubgroups];

uint total;   // keys
uint blocks;  // of them
// Loops over these go to kSortRounds, which compilers know: they unroll them and keep the arrays in
// registers.
uint key[kSortRounds];
uint value[kSortRounds];
uint rank[kSortRounds];

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

struct DigitCount {
  uint total;
  uint earlier;  // of them in earlier blocks
};

DigitCount count_of(uint digit, uint block) {
  if (blocks > kSortFewBlocks)
    return DigitCount(totals[digit], counts[block * kSortDigits + digit]);
  uint start = push.pass * blocks;
  DigitCount sum = DigitCount(0u, 0u);
  for (uint first = 0u; first < blocks; first += kBatch) {
    uint here[kBatch];
    for (uint k = 0u; k < kBatch; ++k)
      here[k] = counts[(start + min(first + k, blocks - 1u)) * kSortDigits + digit];
    for (uint k = 0u; k < kBatch; ++k) {
      if (first + k < blocks) sum.total += here[k];
      if (first + k < block) sum.earlier += here[k];
    }
  }
  return sum;
}

// Exclusive sum of the totals over digits: the start of each digit in the output, and of this
// block's keys there.
void scan_totals(uint digit, uint block) {
  DigitCount own = count_of(digit, block);
  uint inclusive = subgroupInclusiveAdd(own.total);
  if (gl_SubgroupInvocationID == gl_SubgroupSize - 1u) subgroup_sum[gl_SubgroupID] = inclusive;
  barrier();
  uint before = inclusive - own.total;
  for (uint s = 0u; s < gl_SubgroupID; ++s) before += subgroup_sum[s];
  digit_base[digit] = before + own.earlier;
}

// The number of neighbours that share a row of counters.
uint sharers() { return (gl_NumSubgroups + kRows - 1u) / kRows; }

uint row_of_subgroup() { return gl_SubgroupID / sharers(); }

uint used_rows() { return (gl_NumSubgroups + sharers() - 1u) / sharers(); }

// Turns the counters of one digit into exclusive sums over the rows.
void scan_rows(uint word) {
  uint running = 0u;
  for (uint r = 0u; r < used_rows(); ++r) {
    uint here = counters[r * kRow + word];
    counters[r * kRow + word] = running;
    running += here;
  }
}

// The keys and values of this invocation, all at once: no load waits for the use of another.
void load_run(uint run) {
  for (uint round = 0u; round < kSortRounds; ++round) {
    if (round >= push.rounds) continue;
    uint i = min(run + round * gl_SubgroupSize, total - 1u);
    key[round] = keys_in[i];
    value[round] = values_in[i];
  }
}

// Finds, for each key, the number of keys of its digit that stand before it in the runs of the
// subgroups that share its row.
void rank_run(uint run) {
  uint row = row_of_subgroup() * kRow;
  for (uint round = 0u; round < kSortRounds; ++round) {
    if (round >= push.rounds) continue;
    // Past the end every key counts as the last digit: such lanes come after all others and move
    // none of them.
    bool there = run + round * gl_SubgroupSize < total;
    uint digit = there ? (key[round] >> push.shift) & 255u : 255u;
    uvec4 peers = peers_of(digit);
    uint leader = first_lane(peers);
    uint shift = 16u * (digit & 1u);
    uint before = 0u;
    if (gl_SubgroupInvocationID == leader) {
      before = atomicAdd(counters[row + (digit >> 1)], subgroupBallotBitCount(peers) << shift);
    }
    before = (subgroupShuffle(before, leader) >> shift) & 0xffffu;
    rank[round] = before + subgroupBallotExclusiveBitCount(peers);
    subgroupMemoryBarrierShared();
    subgroupBarrier();
  }
}

void rank_in_turn(uint run) {
  for (uint turn = 0u; turn < sharers(); ++turn) {
    if (gl_SubgroupID % sharers() == turn) rank_run(run);
    barrier();
  }
}

void count_for_next(uint moved, uint place) {
  uint block = place / (push.rounds * kSortGroup);
  uint digit = (moved >> (push.shift + 8u)) & 255u;
  atomicAdd(counts[((push.pass + 1u) * blocks + block) * kSortDigits + digit], 1u);
}

void write_run(uint run) {
  for (uint round = 0u; round < kSortRounds; ++round) {
    if (round >= push.rounds || run + round * gl_SubgroupSize >= total) continue;
    uint digit = (key[round] >> push.shift) & 255u;
    uint earlier =
        (counters[row_of_subgroup() * kRow + (digit >> 1)] >> (16u * (digit & 1u))) & 0xffffu;
    uint place = digit_base[digit] + earlier + rank[round];
    keys_out[place] = key[round];
    values_out[place] = value[round];
    if (push.pass + 1u < push.passes) count_for_next(key[round], place);
  }
}

void main() {
  uint lane = gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID;
  uint block = workgroup_index();
  total = key_total();
  blocks = sort_blocks(total, push.rounds);
  if (block >= blocks) return;
  uint run = block * push.rounds * kSortGroup + gl_SubgroupID * (gl_SubgroupSize * push.rounds) +
             gl_SubgroupInvocationID;
  load_run(run);
  for (uint i = lane; i < used_rows() * kRow; i += kSortGroup) counters[i] = 0u;
  scan_totals(lane, block);
  barrier();
  rank_in_turn(run);
  if (lane < kRow) scan_rows(lane);
  barrier();
  write_run(run);
}
