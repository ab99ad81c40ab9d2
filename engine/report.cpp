// The report: the witness certified against every triangle of B, and the interval as it stands.
#include "engine/stages.h"

namespace vkh {

namespace {

// Above the ordered bits (lib/morton.h) of every distance.
constexpr uint32_t kHighest = 0xffffffffu;

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
  rec.fill(ws.lower_bits, kHighest);
  rec.run<k::ReportLower>({.control = ws.control,
                           .b_vertices = p.b.vertices,
                           .lower_bits = ws.lower_bits,
                           .vertices = ws.vertices,
                           .faces = ws.faces,
                           .b_faces = p.b.faces},
                          gpu::CountPush{p.b.face_count}, Items{p.b.face_count});
  rec.run<k::ReportWrite>({.control = ws.control,
                           .lower_bits = ws.lower_bits,
                           .vertices = ws.vertices,
                           .faces = ws.faces,
                           .triangles = p.b.triangles,
                           .report = report},
                          {}, Groups{1});
  record_open(rec, p);
  rec.stage("report");
}

}  // namespace vkh
