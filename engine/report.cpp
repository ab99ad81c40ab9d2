// The report: the witness certified against every triangle of B, and the interval as it stands.
#include "engine/stages.h"

namespace vkh {

namespace {

void record_open(Recorder& rec, const Problem& p) {
  if (p.areas.buffer == VK_NULL_HANDLE) return;
  const VkDeviceSize half = p.face_count * sizeof(gpu::Area);
  rec.fill(Slice<gpu::Area>{p.areas.buffer, p.areas.offset + half, half}, 0);
  rec.run<k::ReportOpen>({.control = p.ws.control, .frontier = p.ws.frontier, .areas = p.areas}, {},
                         Items{p.ws.capacity});
}

}  // namespace

void record_report(Recorder& rec, const Problem& p, const Slice<gpu::Report>& report) {
  const auto scope = rec.scope("report");
  const Workspace& ws = p.ws;
  rec.run<k::ReportWrite>({.control = ws.control,
                           .b_vertices = p.b.vertices,
                           .b_faces = p.b.faces,
                           .vertices = ws.vertices,
                           .faces = ws.faces,
                           .triangles = p.b.triangles,
                           .lower_bits = ws.lower_bits,
                           .groups_done = ws.groups_done,
                           .report = report},
                          gpu::CountPush{p.b.face_count}, Items{p.b.face_count});
  record_open(rec, p);
  rec.stage("report");
}

}  // namespace vkh
