// The report: the witness certified against every triangle of B, and the current interval.
#include <cstddef>

#include "engine/record.h"

namespace vkh {
namespace {

struct ReportBuffers : RunBuffers {
  ReportBuffers(const Problem& p, const Slice<gpu::Report>& at)
      : RunBuffers(p), report(at), push{p.b.face_count, 1} {}
  Slice<gpu::Report> report;
  gpu::ReportPush push;
};

// The part of Control that VkhStatistics ends with.
constexpr size_t kTotals = offsetof(gpu::Control, candidate_total);
static_assert(sizeof(gpu::Control) - kTotals ==
              sizeof(VkhStatistics) - offsetof(VkhStatistics, candidateTotal));
static_assert(offsetof(gpu::Control, waves) - kTotals ==
              offsetof(VkhStatistics, waveRecords) - offsetof(VkhStatistics, candidateTotal));
static_assert(sizeof(gpu::WaveRecord) == sizeof(VkhWaveRecord));

// A part of a slice, in bytes.
template <class T>
Slice<uint32_t> part_of(const Slice<T>& slice, size_t offset, size_t size) {
  return {slice.buffer, slice.offset + offset, size};
}

// The half of the areas for open candidates.
Slice<gpu::Area> open_areas(const Problem& p) {
  const VkDeviceSize half = p.face_count * sizeof(gpu::Area);
  return {p.areas.buffer, p.areas.offset + half, half};
}

}  // namespace

void record_report(Recorder& rec, const Problem& p, const Slice<gpu::Report>& report) {
  const auto scope = rec.scope("report");
  const ReportBuffers run(p, report);
  const bool has_areas = p.areas.buffer != VK_NULL_HANDLE;
  rec.run<k::ReportWrite>(run, Items{p.b.face_count});
  if (has_areas) rec.fill(open_areas(p), 0);
  if (has_areas) rec.run<k::ReportOpen>(run, Items{p.ws.capacity});
  rec.stage("report");
}

void record_statistics(Recorder& rec, const Problem& p, const Slice<uint32_t>& to, Order order) {
  using Totals = VkhStatistics;
  const Slice<gpu::Control>& control = p.ws.control;
  const auto copy = [&](size_t from, size_t at, size_t size, Order after) {
    rec.copy(part_of(control, from, size), part_of(to, at, size), after);
  };
  copy(kTotals, offsetof(Totals, candidateTotal), sizeof(gpu::Control) - kTotals, order);
  copy(offsetof(gpu::Control, culled), offsetof(Totals, culled), sizeof(Totals::culled),
       Order::kIndependent);
  copy(offsetof(gpu::Control, certified), offsetof(Totals, certified), sizeof(Totals::certified),
       Order::kIndependent);
}

void record_unbuilt_report(Recorder& rec, const Problem& p, const Slice<gpu::Report>& report) {
  const auto scope = rec.scope("report");
  ReportBuffers run(p, report);
  // The code of the invalid meshes, for the kernel that runs if nothing is built.
  run.push = {(p.has_a ? 0u : 1u) | (p.b.face_count > 0 ? 0u : 2u), 0};
  rec.run<k::ReportWrite>(run, Groups{1});
  rec.stage("report");
}

}  // namespace vkh
