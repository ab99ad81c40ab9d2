// The stage that only the paper's presets record: the frontier is sorted before it is refined.
#include <cstddef>

#include "engine/record.h"

namespace vkh {
namespace {

struct OrderBuffers : RunBuffers {
  explicit OrderBuffers(const RunBuffers& run)
      : RunBuffers(run), keys(run.sort.keys[0]), values(run.sort.values[0]) {}
  Slice<uint32_t> keys, values;
};

}  // namespace

void record_order(Recorder& rec, const RunBuffers& run) {
  // The frontier's length, as one word.
  static_assert(offsetof(gpu::Control, count) == 0 && gpu::kCountFrontier == 0);
  SortStreams streams = run.sort;
  streams.count = {run.control.buffer, run.control.offset, sizeof(uint32_t)};
  rec.run_indirect<k::WaveSort>(OrderBuffers(run), size_at(run.sizes, &gpu::WaveSizes::sort_keys));
  record_sort(rec, streams, size_at(run.sizes, &gpu::WaveSizes::sort_blocks),
              size_at(run.sizes, &gpu::WaveSizes::sort_digits));
  rec.stage("order");
}

}  // namespace vkh
