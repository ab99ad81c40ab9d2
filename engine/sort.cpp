// Radix sort of 32-bit keys with 32-bit values: 8-bit digits, count / scan / scatter per pass
// (Harris, Satish and Garland's scheme, without look-back between workgroups, which Vulkan does not
// promise to make progress).
#include <algorithm>

#include "engine/record.h"

namespace vkh {
namespace {

// The buffers of a pass's kernels: from one side to the other.
struct Pass {
  Pass(const SortStreams& s, uint32_t from, const gpu::SortPush& p)
      : push(p),
        keys(s.keys[from]),
        keys_in(s.keys[from]),
        values_in(s.values[from]),
        keys_out(s.keys[1 - from]),
        values_out(s.values[1 - from]),
        counts(s.counts),
        totals(s.totals),
        key_count(s.count) {}
  gpu::SortPush push;
  Slice<uint32_t> keys, keys_in, values_in, keys_out, values_out, counts, totals, key_count;
};

template <class K>
void dispatch(Recorder& rec, const Pass& pass, Groups groups) {
  if (groups.count > 0) rec.run<K>(pass, groups);
}
template <class K>
void dispatch(Recorder& rec, const Pass& pass, const Slice<gpu::Dispatch>& size) {
  rec.run_indirect<K>(pass, size);
}

// The bits to sort by, the keys per invocation, their number, and whether each pass counts for the
// next.
struct SortKeys {
  uint32_t first_bit, rounds, count;
  bool counted_ahead;
};

uint32_t passes_of(const SortKeys& keys) { return (32 - keys.first_bit) / 8; }

// `blocks`, `digits`: the sizes of dispatches with one workgroup each; without `digits` if blocks
// are few.
template <class Size>
// NOLINTNEXTLINE(readability-function-size): two callers, in this file
void record_passes(Recorder& rec, const SortStreams& s, SortKeys sorted, Counted counted,
                   const Size& blocks, const Size& digits) {
  const uint32_t passes = passes_of(sorted);
  for (uint32_t pass = 0; pass < passes; ++pass) {
    const uint32_t from = (passes - pass) % 2;
    const gpu::SortPush push{.shift = sorted.first_bit + 8 * pass,
                             .rounds = sorted.rounds,
                             .count = sorted.count,
                             .pass = sorted.counted_ahead ? pass : 0,
                             .passes = sorted.counted_ahead ? passes : 1};
    const Pass given(s, from, push);
    if (push.pass == 0 && counted == Counted::kNo) dispatch<k::SortCount>(rec, given, blocks);
    dispatch<k::SortScan>(rec, given, digits);
    dispatch<k::SortScatter>(rec, given, blocks);
  }
}

// A sort of few keys is a chain of rounds and dispatches on a few of the device's processors: up to
// kSortFewBlocks workgroups take fewer rounds, and each pass counts for the next, by atomics. A CPU
// has no such waits, and each workgroup costs it more.
SortKeys keys_for(const Recorder& rec, uint32_t first_bit, uint32_t count) {
  if (!rec.is_wide()) return {first_bit, gpu::kSortRounds, count, false};
  uint32_t rounds = gpu::kFewestSortRounds;
  while (rounds < gpu::kSortRounds && sort_blocks(count, rounds) > gpu::kSortFewBlocks) rounds *= 2;
  return {first_bit, rounds, count, sort_blocks(count, rounds) <= gpu::kSortFewBlocks};
}

}  // namespace

uint32_t sort_side(uint32_t first_bit) { return (32 - first_bit) / 8 % 2; }

uint32_t record_empty_counts(Recorder& rec, const SortStreams& s, uint32_t count,
                             uint32_t first_bit, Order order) {
  const SortKeys keys = keys_for(rec, first_bit, count);
  if (!keys.counted_ahead) return 0;
  const uint64_t words =
      uint64_t{passes_of(keys)} * sort_blocks(count, keys.rounds) * gpu::kSortDigits;
  rec.fill(Slice<uint32_t>{s.counts.buffer, s.counts.offset, words * sizeof(uint32_t)}, 0, order);
  return keys.rounds * gpu::kSortGroup;
}

void record_sort(Recorder& rec, const SortStreams& s, uint32_t count, uint32_t first_bit,
                 Counted counted) {
  const SortKeys keys = keys_for(rec, first_bit, count);
  const uint32_t blocks = sort_blocks(count, keys.rounds);
  const uint32_t digits = blocks > gpu::kSortFewBlocks ? gpu::kSortDigits : 0;
  if (counted == Counted::kNo && count > 0)
    record_empty_counts(rec, s, count, first_bit, Order::kAfterAll);
  record_passes(rec, s, keys, counted, Groups{blocks}, Groups{digits});
}

void record_sort(Recorder& rec, const SortStreams& s, const Slice<gpu::Dispatch>& blocks,
                 const Slice<gpu::Dispatch>& digits) {
  record_passes(rec, s, {0, gpu::kSortRounds, gpu::kNone, false}, Counted::kNo, blocks, digits);
}

}  // namespace vkh
