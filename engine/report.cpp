// The report: the witness certified against every triangle of B, and the current interval.
#include "engine/record.h"

namespace vkh {
namespace {

struct ReportBuffers : RunBuffers {
  ReportBuffers(const Problem& p, const Slice<gpu::Report>& at)
      : RunBuffers(p), report(at), push{p.b.face_count, 1} {}
  Slice<gpu::Report> report;
  gpu::ReportPush push;
};

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

void record_unbuilt_report(Recorder& rec, const Problem& p, const Slice<gpu::Report>& report) {
  const auto scope = rec.scope("report");
  ReportBuffers run(p, report);
  // The meshes that are invalid, as a code for the kernel where nothing is built.
  run.push = {(p.has_a ? 0u : 1u) | (p.b.face_count > 0 ? 0u : 2u), 0};
  rec.run<k::ReportWrite>(run, Groups{1});
  rec.stage("report");
}

}  // namespace vkh
