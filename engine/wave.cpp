// One wave: every refined candidate becomes four, or sixteen, every new point is queried, every
// child bounded, most children closed; then the next one is planned. Its stages are the lines of
// shaders/stages.h, recorded here in their order if the switches need them.
#include <cstddef>

#include "engine/record.h"

namespace vkh {
namespace {

// The arguments of the lines: the wave's buffers, and the points for `query`.
struct Lines {
  explicit Lines(const Problem& p)
      : wave(p),
        points(wave, query_push(p, gpu::kAskPoints)),
        centroids(wave, query_push(p, gpu::kAskCentroids)) {
    // Query has one binding, `points`. For centroids it is given the stream of centroids.
    centroids.points = wave.centroids;
  }
  RunBuffers wave;
  Given<gpu::QueryPush> points, centroids;
};

#define VKH_RECORD_SIZED(kernel, given, size, needed, column, groups)                       \
  if (gpu::needed(p.switches, p.wide)) {                                                    \
    rec.run_indirect<k::kernel>(lines.given,                                                \
                                size_at(lines.wave.sizes, offsetof(gpu::WaveSizes, size))); \
    rec.stage(#column);                                                                     \
  }
#define VKH_RECORD_ALONE(kernel, given, needed, column) \
  if (gpu::needed(p.switches, p.wide)) {                \
    rec.run<k::kernel>(lines.given, Groups{1});         \
    rec.stage(#column);                                 \
  }

void record_bounds(Recorder& rec, const Problem& p, const Lines& lines) {
  VKH_FILTER_STAGES(VKH_RECORD_SIZED, VKH_RECORD_ALONE)
  VKH_BOUND_STAGES(VKH_RECORD_SIZED, VKH_RECORD_ALONE)
}

}  // namespace

void record_first_wave(Recorder& rec, const Problem& p) {
  const auto scope = rec.scope("wave");
  record_bounds(rec, p, Lines(p));
}

void record_wave(Recorder& rec, const Problem& p) {
  const auto scope = rec.scope("wave");
  const Lines lines(p);
  if (gpu::sorts_frontier(p.switches, p.wide)) record_order(rec, lines.wave);
  VKH_REFINE_STAGES(VKH_RECORD_SIZED)
  record_bounds(rec, p, lines);
}

}  // namespace vkh
