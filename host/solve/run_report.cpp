#include "host/solve/run_report.h"

#include <algorithm>
#include <new>

#include "host/base/rounding.h"
#include "host/mesh/closest.h"
#include "host/mesh/same_faces.h"
#include "shaders/gpu_types.h"

namespace vkh {

Report report_on(const Mesh& a, const Mesh& b, const SolveOptions& options) {
  Report out;
  out.known_lower = options.known_lower;
  out.limit = options.limit;
  out.mesh_a = a.counts;
  out.mesh_b = b.counts;
  out.place_a = {a.delta, a.unit};
  out.place_b = {b.delta, b.unit};
  return out;
}

std::optional<Status> reached_by(const Report& r) {
  if (is_within(r.lower, r.upper, r.tolerance)) return Status::kClosed;
  if (r.known_lower > 0 && is_within(r.known_lower, r.upper, r.tolerance)) return Status::kPruned;
  if (is_decided(r.lower, r.upper, r.limit)) return Status::kLimit;
  return std::nullopt;
}

bool is_within_faces_of(const Mesh& a, const Mesh& b) {
  if (a.delta > 0 || b.delta > 0) return false;
  try {
    return has_faces_of(b, a);
  } catch (const std::bad_alloc&) {
    return false;
  }
}

void fill_counts(const RunOutput& run, const Frame& frame, Report& out) {
  const VkhReport& r = run.report;
  const VkhStatistics& counted = run.statistics;
  out.waves = r.waves;
  out.candidates = counted.candidateTotal;
  out.queries = counted.queryTotal;
  out.peak_frontier = counted.peakFrontier;
#define VKH_COUNT(constant, value, name) {#name, counted.culled[value]},
  out.culled = {VKH_CULLS(VKH_COUNT)};
#undef VKH_COUNT
  const uint32_t first = r.waves > VKH_MAX_WAVE_RECORDS ? r.waves - VKH_MAX_WAVE_RECORDS : 0;
  for (uint32_t w = first; w < r.waves; ++w) {
    const VkhWaveRecord& rec = counted.waveRecords[w % VKH_MAX_WAVE_RECORDS];
    out.wave_stats.push_back({w, rec.parents, rec.candidates, rec.queries, rec.survivors,
                              rec.deferred, frame.length_down(static_cast<double>(rec.lower)),
                              frame.length_up(static_cast<double>(rec.upper))});
  }
}

void fill_stages(const RunOutput& run, Report& out) {
  for (const StageTime& s : run.stages) {
    auto at = std::find_if(out.stages.begin(), out.stages.end(),
                           [&](const StageStats& x) { return x.name == s.name; });
    if (at == out.stages.end()) at = out.stages.insert(out.stages.end(), StageStats{s.name, 0, 0});
    at->gpu_ms += s.ms;
    ++at->times;
    const bool building = at->name == "morton" || at->name == "sort" || at->name == "hierarchy";
    (building ? out.times.hierarchy_ms : out.times.solve_ms) += s.ms;
  }
}

void fill_witness(const VkhReport& r, const Mesh& a, const Mesh& b, Report& out) {
  if (r.witnessFaceA >= a.faces.size() || r.witnessFaceB >= b.faces.size()) return;
  const auto coordinate = [&](int i) {  // exact: 40 bits
    return r.witnessBarycentric[i] * 0x1p-20 + r.witnessBarycentricLow[i] * 0x1p-40;
  };
  const double v = coordinate(0), w = coordinate(1);
  fill_witness({r.witnessFaceA, r.witnessFaceB, {1 - v - w, v, w}}, a, b, out);
}

void fill_witness(const FoundWitness& found, const Mesh& a, const Mesh& b, Report& out) {
  const glm::dvec3 at = found.barycentric;
  const glm::uvec3 fa = a.faces[found.face_a];
  const glm::dvec3 p = at.x * a.vertices[fa.x] + at.y * a.vertices[fa.y] + at.z * a.vertices[fa.z];
  out.witness_a = {.barycentric = found.barycentric, .point = p};
  out.witness_a.set_face(a, found.face_a);
  const glm::uvec3 fb = b.faces[found.face_b];
  const ClosestPoint q =
      closest_point_of_any_size(p, b.vertices[fb.x], b.vertices[fb.y], b.vertices[fb.z]);
  out.witness_b = {.barycentric = q.barycentric, .point = q.point};
  out.witness_b.set_face(b, found.face_b);
  out.has_witness = true;
}

}  // namespace vkh
