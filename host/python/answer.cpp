#include "host/python/answer.h"

#include <pybind11/stl.h>

namespace vkh::python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

py::dict counts_of(const MeshCounts& c) {
  return py::dict("vertices"_a = c.vertices, "faces"_a = c.faces, "unreferenced"_a = c.unreferenced,
                  "degenerate"_a = c.degenerate, "duplicate"_a = c.duplicate);
}

py::dict culled_of(const std::vector<CullCount>& culled) {
  py::dict counts;
  for (const CullCount& c : culled) counts[c.name] = c.candidates;
  return counts;
}

py::dict device_of(const DeviceDescription& d) {
  return py::dict("index"_a = d.index, "name"_a = d.name, "type"_a = d.type, "driver"_a = d.driver,
                  "api_version"_a = d.api_version);
}

py::dict stats_of(const Report& r) {
  const Times& t = r.times;
  return py::dict(
      "status"_a = status_name(r.status), "lower"_a = r.lower, "upper"_a = r.upper,
      "gap"_a = r.gap(), "tolerance"_a = r.tolerance, "known_lower"_a = r.known_lower,
      "max"_a = r.limit.within, "diagonal_a"_a = r.diagonal_a, "mesh_a"_a = counts_of(r.mesh_a),
      "mesh_b"_a = counts_of(r.mesh_b), "device"_a = device_of(r.device), "waves"_a = r.waves,
      "candidates"_a = r.candidates, "queries"_a = r.queries, "peak_frontier"_a = r.peak_frontier,
      "culled"_a = culled_of(r.culled), "workspace_bytes"_a = r.workspace_bytes,
      "host_memory_bytes"_a = r.host_memory_bytes, "preset"_a = r.preset,
      "switched_on"_a = r.switched_on, "switched_off"_a = r.switched_off,
      "upload_ms"_a = t.upload_ms, "hierarchy_ms"_a = t.hierarchy_ms, "solve_ms"_a = t.solve_ms,
      "wall_ms"_a = t.wall_ms);
}

std::optional<Verdict> verdict_within(double lower, double upper, const Limit& limit) {
  if (!(limit.within > 0)) return std::nullopt;
  return verdict_of(lower, upper, limit);
}

}  // namespace

Answer answer_of(const Report& r) {
  return {r.lower,     r.upper,     r.status,   verdict_within(r.lower, r.upper, r.limit),
          r.witness_a, r.witness_b, stats_of(r)};
}

Answer answer_of(const FaceGate& gate) {
  Answer answer = answer_of(gate.report);
  answer.verdict = gate.verdict;
  answer.stats["max"] = gate.limit.within;
  answer.stats["faces_within"] = gate.within;
  answer.stats["runs"] = gate.runs;
  return answer;
}

const char* Answer::verdict_name() const { return verdict ? vkh::verdict_name(*verdict) : nullptr; }

Answer answer_of(const SymmetricReport& both) {
  const CertifiedInterval whole = both.interval();
  const bool there = both.a_to_b.lower >= both.b_to_a.lower;
  const Report& r = there ? both.a_to_b : both.b_to_a;
  Answer answer{whole.lower,
                whole.upper,
                whole.status,
                verdict_within(whole.lower, whole.upper, r.limit),
                r.witness_a,
                r.witness_b,
                {}};
  if (!there) std::swap(answer.witness_a, answer.witness_b);
  answer.stats["status"] = status_name(whole.status);
  answer.stats["gap"] = whole.gap;
  answer.stats["tolerance"] = both.a_to_b.tolerance;
  answer.stats["direction"] = there ? "a_to_b" : "b_to_a";
  answer.stats["a_to_b"] = stats_of(both.a_to_b);
  answer.stats["b_to_a"] = stats_of(both.b_to_a);
  return answer;
}

}  // namespace vkh::python
