// Radix sort of 32-bit keys with 32-bit values: 8-bit digits, count / scan / scatter a pass
// (Harris, Satish and Garland's scheme, without look-back between workgroups, which Vulkan does not
// promise to make progress).
#include "engine/stages.h"

namespace vkh {

void record_sort(Recorder& rec, const BuildScratch& s, uint32_t count) {
  const uint32_t blocks = (count + gpu::kSortBlock - 1) / gpu::kSortBlock;
  for (uint32_t pass = 0; pass < gpu::kSortPasses; ++pass) {
    const uint32_t from = pass % 2;
    const uint32_t to = 1 - from;
    const gpu::SortPush push{.count = count, .shift = 8 * pass, .blocks = blocks};
    rec.run<k::SortCount>({.keys = s.keys[from], .counts = s.counts}, push, Groups{blocks});
    if (blocks > gpu::kSortFewBlocks) {
      rec.run<k::SortScan>({.counts = s.counts, .totals = s.totals}, push,
                           Groups{gpu::kSortDigits});
    }
    rec.run<k::SortScatter>({.keys_in = s.keys[from],
                             .values_in = s.values[from],
                             .keys_out = s.keys[to],
                             .values_out = s.values[to],
                             .counts = s.counts,
                             .totals = s.totals},
                            push, Groups{blocks});
  }
}

}  // namespace vkh
