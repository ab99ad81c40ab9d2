// One wave: every refined candidate becomes four, or sixteen, every new point is queried, every
// child bounded, most children closed; then the next one is planned. The stages that the switches
// do not need are left out (engine/stages.h).
#include "engine/record.h"
#include "engine/stages.h"

namespace vkh {
namespace {

using Sizes = gpu::WaveSizes;

class Wave {
 public:
  Wave(Recorder& rec, const Problem& p)
      : rec_(rec),
        p_(p),
        buffers_(p),
        points_(buffers_, query_push(p, gpu::kAskPoints)),
        centroids_(buffers_, query_push(p, gpu::kAskCentroids)) {
    // Query has one binding, `points`. For centroids it is given the stream of centroids.
    centroids_.points = buffers_.centroids;
  }

  void order() const {
    if (gpu::sorts_frontier(p_.switches, p_.wide)) record_order(rec_, buffers_);
  }

  // The refined candidates, and their new points.
  void refine() const {
    run<k::PaperSubdivide, &Sizes::sorted>(buffers_);
    run<k::WaveSubdivide, &Sizes::subdivide>(buffers_);
    run<k::WavePacket, &Sizes::packet>(buffers_);
    run<k::Query, &Sizes::query_points>(points_);
  }

  // Records the cheap bounds of all children, if a filter is on; then the bounds of all children,
  // or of the ones that the filter leaves; then the plan of the next wave.
  void bound() const {
    run<k::WaveFilter, &Sizes::filter_all>(buffers_);
    run<k::WaveSurvivors>(buffers_);
    run<k::Query, &Sizes::query_centroids>(centroids_);
    run<k::WaveBisect, &Sizes::bisect>(buffers_);
    run<k::PaperBound, &Sizes::bound_besides>(buffers_);
    run<k::WaveBound, &Sizes::bound>(buffers_);
    run<k::WavePlan>(buffers_);
  }

 private:
  // Records a kernel if the switches need it, with the number of workgroups that the plan has
  // written, or with one.
  template <class K, WaveSize kSize = nullptr, class Buffers>
  void run(const Buffers& buffers) const {
    static constexpr Stage stage = stage_of(IndexOf<K>::value, kSize);
    if (!stage.needed(p_.switches, p_.wide)) return;
    if constexpr (kSize == nullptr) {
      rec_.run<K>(buffers, Groups{1});
    } else {
      rec_.run_indirect<K>(buffers, size_at(buffers_.sizes, kSize));
    }
    rec_.stage(stage.column);
  }

  Recorder& rec_;
  const Problem& p_;
  RunBuffers buffers_;
  Given<gpu::QueryPush> points_, centroids_;
};

}  // namespace

void record_first_wave(Recorder& rec, const Problem& p) {
  const auto scope = rec.scope("wave");
  Wave(rec, p).bound();
}

void record_wave(Recorder& rec, const Problem& p) {
  const auto scope = rec.scope("wave");
  const Wave wave(rec, p);
  wave.order();
  wave.refine();
  wave.bound();
}

}  // namespace vkh
