// An answer as Python gets it.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <vector>

#include "host/base/system.h"
#include "host/python/result.h"

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
  for (const CullCount& c : culled) counts[c.name.c_str()] = c.candidates;
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

py::array_t<double> array_of(const std::vector<double>& numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

/// Returns what _survey.py makes an Interval of.
py::tuple interval_of(const Enclosure& e, bool jump = false) {
  return py::make_tuple(e.lower, e.upper, e.estimate, jump);
}

py::tuple pair_of(const py::object& key, const Enclosure& e, bool jump) {
  return py::make_tuple(key, interval_of(e, jump));
}

/// A distance as the caller gave it: a number, or its text.
py::object key_of(const Length& length) {
  return length.is_double ? py::object(py::float_(length.number))
                          : py::object(py::str(length.requested));
}

py::dict statistics_of(const Question& question, const Statistics& s) {
  py::list bands, percentiles, curve;
  std::vector<const Length*> lengths;  // as they were asked: the limit first (finish.cpp)
  if (question.max) lengths.push_back(&*question.max);
  for (const Length& band : question.bands) lengths.push_back(&band);
  for (size_t i = 0; i < s.bands.size(); ++i)
    bands.append(pair_of(key_of(*lengths[i]), s.bands[i].share, s.bands[i].jump));
  for (const Percentile& p : s.percentiles)
    percentiles.append(pair_of(py::float_(p.share), p.distance, p.jump));
  for (const AreaWithin& at : s.curve)
    curve.append(pair_of(py::float_(at.distance), at.share, at.jump));
  const py::object kept = s.kept ? py::object(interval_of(*s.kept)) : py::none();
  return py::dict("area"_a = s.area, "points"_a = s.points, "kept"_a = kept,
                  "mean"_a = interval_of(s.mean), "rms"_a = interval_of(s.rms), "bands"_a = bands,
                  "percentiles"_a = percentiles, "curve"_a = curve);
}

py::dict areas_of(const SignedFigures::Areas& areas) {
  py::dict without;
  for (size_t k = 1; k < kDoubts; ++k)
    without[doubt_name(static_cast<Doubt>(k))] = interval_of(areas.doubts[k]);
  return py::dict("over"_a = interval_of(areas.over), "under"_a = interval_of(areas.under),
                  "unsigned"_a = without);
}

py::object witness_of(const std::optional<SidedPoint>& witness) {
  if (!witness) return py::none();
  const DVec3& p = witness->at.point;
  return py::make_tuple(py::make_tuple(p.x, p.y, p.z), witness->at.face, witness->lower);
}

py::object signed_of(const Question& question, const SignedFigures& s) {
  py::object areas = py::none(), mean = py::none(), over = py::none(), under = py::none();
  if (s.areas) areas = areas_of(*s.areas);
  if (s.mean) mean = interval_of(*s.mean);
  if (question.faces) {
    over = py::make_tuple(array_of(s.over_of_faces.lower), array_of(s.over_of_faces.upper));
    under = py::make_tuple(array_of(s.under_of_faces.lower), array_of(s.under_of_faces.upper));
  }
  py::list percentiles;
  for (const Percentile& p : s.percentiles)
    percentiles.append(py::make_tuple(p.share, p.distance.lower, p.distance.upper));
  return py::dict("over"_a = interval_of(s.over), "under"_a = interval_of(s.under),
                  "inside"_a = inside_name(s.inside),
                  "inside_out"_a = inside_out_name(s.inside_out), "open_edges"_a = s.edges.open,
                  "areas"_a = areas, "mean"_a = mean, "percentiles"_a = percentiles,
                  "over_field"_a = over, "under_field"_a = under,
                  "over_witness"_a = witness_of(s.over_witness),
                  "under_witness"_a = witness_of(s.under_witness));
}

/// A direction, as Python shows the survey of the mesh that it begins at.
struct SurveyedSide {
  const Report& report;
  const std::optional<SurveyResult>& found;
  const MeshPointer& mesh;     ///< as it was measured
  const std::string& against;  ///< the other one's name
};

/// Gathers everything but the bounds of faces that Field.save() writes.
py::object source_of(const SurveyedSide& side, const Answer& answer) {
  if (side.mesh == nullptr) return py::none();
  return py::make_tuple(mesh_object(side.mesh), side.report.lower, side.report.upper, answer.unit,
                        py::bytes(file_name_of(side.against)));
}

py::object survey_of(const Question& question, const Answer& answer, const SurveyedSide& side) {
  const std::optional<SurveyResult>& found = side.found;
  if (!found) return py::none();
  py::object field = py::none(), statistics = py::none(), sides = py::none();
  if (question.faces)
    field = py::make_tuple(array_of(found->field.lower), array_of(found->field.upper));
  if (found->statistics) statistics = statistics_of(question, *found->statistics);
  if (found->sides) sides = signed_of(question, *found->sides);
  const py::dict stats("cells"_a = found->cells, "bounded"_a = found->bounded,
                       "effort"_a = found->effort, "wall_ms"_a = found->ms);
  return py::module_::import("vkhausdorff._survey")
      .attr("made")(field, statistics, side.report.upper, survey_end_name(found->ended), stats,
                    sides, question.faces ? source_of(side, answer) : py::none());
}

py::dict note_dict(const Note& note) {
  const auto text = [](const std::string& t) {
    return t.empty() ? py::object(py::none()) : py::object(py::str(t));
  };
  return py::dict("code"_a = std::string(code_name(note.code)), "text"_a = note.text,
                  "value"_a = note.value, "unit"_a = text(note.unit), "file"_a = text(note.file),
                  "face"_a = note.face);
}

/// The notes on the pair, and then those on A's file and B's.
py::list list_of_notes(const Answer& answer) {
  py::list notes;
  for (const Note& note : vkh::notes_of(answer)) notes.append(note_dict(note));
  for (const Input& input : answer.inputs) {
    for (Note note : input.notes) {
      note.file = input.path;
      notes.append(note_dict(note));
    }
  }
  return notes;
}

py::dict proof_of(const Proof& proof) {
  return py::dict("upper"_a = proof.upper, "leaves"_a = proof.leaves,
                  "cut_leaves"_a = proof.cut_leaves, "unproven"_a = proof.unproven,
                  "wall_ms"_a = proof.ms);
}

/// One schema for both: in a symmetric run the figures are of both directions together.
py::object certificate_of(const Answer& answer) {
  const bool is_whole = answer.proof_a && answer.proof_b.has_value() == answer.b_to_a.has_value();
  if (!is_whole) return py::none();
  Proof both;
  for (const Proof* proof : {&*answer.proof_a, answer.proof_b ? &*answer.proof_b : nullptr}) {
    if (proof == nullptr) continue;
    both.upper = std::max(both.upper, proof->upper);
    both.leaves += proof->leaves;
    both.cut_leaves += proof->cut_leaves;
    both.unproven += proof->unproven;
    both.ms += proof->ms;
  }
  py::dict certificate = proof_of(both);
  certificate["a_to_b"] = proof_of(*answer.proof_a);
  certificate["b_to_a"] = answer.proof_b ? py::object(proof_of(*answer.proof_b)) : py::none();
  return certificate;
}

void add_culled(std::vector<CullCount>& sum, const std::vector<CullCount>& more) {
  for (const CullCount& c : more) {
    const auto same = [&](const CullCount& one) { return one.name == c.name; };
    const auto known = std::find_if(sum.begin(), sum.end(), same);
    if (known == sum.end()) {
      sum.push_back(c);
    } else {
      known->candidates += c.candidates;
    }
  }
}

/// Both directions as one report: their interval, the sums of what they counted and took, and the
/// most of what they held.
Report report_of_both(const Answer& answer) {
  Report both = answer.a_to_b;
  const Report& back = *answer.b_to_a;
  const CertifiedInterval whole = interval_of(answer);
  both.status = whole.status;
  both.lower = whole.lower;
  both.upper = whole.upper;
  both.waves += back.waves;
  both.candidates += back.candidates;
  both.queries += back.queries;
  both.peak_frontier = std::max(both.peak_frontier, back.peak_frontier);
  add_culled(both.culled, back.culled);
  both.workspace_bytes = std::max(both.workspace_bytes, back.workspace_bytes);
  both.host_memory_bytes = std::max(both.host_memory_bytes, back.host_memory_bytes);
  both.times.upload_ms += back.times.upload_ms;
  both.times.hierarchy_ms += back.times.hierarchy_ms;
  both.times.solve_ms += back.times.solve_ms;
  both.times.wall_ms += back.times.wall_ms;
  return both;
}

/// One schema for one direction and for both: what holds for the whole answer, and each direction
/// by itself.
py::dict stats_of(const Answer& answer, bool is_forward) {
  py::dict stats = stats_of(answer.b_to_a ? report_of_both(answer) : answer.a_to_b);
  stats["gap"] = interval_of(answer).gap;
  stats["direction"] = is_forward ? "a_to_b" : "b_to_a";
  stats["a_to_b"] = stats_of(answer.a_to_b);
  stats["b_to_a"] = answer.b_to_a ? py::object(stats_of(*answer.b_to_a)) : py::none();
  return stats;
}

py::tuple metric_of(const Metric& metric) {
  return py::make_tuple(interval_of(metric.value, metric.jump), metric.is_met);
}

/// Returns what _metrics.py makes Metrics of.
py::dict metrics_of(const Question& question, const Metrics& m) {
  py::dict lengths;
  for (const NamedMetric& metric : kNamedMetrics) {
    if (m.normals || !metric.of_normals) lengths[metric.name] = metric_of(m.*metric.figure);
  }
  py::list within;
  for (size_t i = 0; i < m.within.size(); ++i) {
    py::dict shares;
    for (const NamedShare& share : kNamedShares) {
      if (m.normals || !share.of_normals) shares[share.name] = metric_of(m.within[i].*share.figure);
    }
    within.append(py::make_tuple(key_of(question.bands[i]), shares));
  }
  py::list figures;
  for (const std::string& figure : m.figures) figures.append(figure);
  return py::dict("percentile"_a = m.percentile, "lengths"_a = lengths, "within"_a = within,
                  "figures"_a = figures);
}

py::dict transform_of(const PlacedInput& placed) {
  py::object matrix = py::none();
  if (placed.by.matrix) matrix = matrix_rows(*placed.by.matrix);
  return py::dict("factor"_a = py::make_tuple(placed.by.numerator, placed.by.denominator),
                  "matrix"_a = matrix, "found"_a = placed.fit.has_value());
}

void add_limit(const Answer& answer, Result& result) {
  if (!answer.max) return;
  result.verdict = verdict_of(answer);
  const std::optional<FaceLimits>& faces = answer.max->faces_a;
  if (faces || answer.max->area)
    result.stats["max"] = faces ? faces->limit.within : answer.max->limit.within;
  if (answer.max->area) result.stats["area"] = *answer.max->area;
  if (!faces) return;
  result.stats["faces_within"] = faces->within;
  result.stats["runs"] = faces->runs;
}

}  // namespace

py::list matrix_rows(const MatrixRows& matrix) {
  py::list rows;
  for (const auto& row : matrix) rows.append(py::list(py::cast(row)));
  rows.append(py::list(py::cast(std::array{0.0, 0.0, 0.0, 1.0})));
  return rows;
}

Result result_of(const Question& question, const Answer& answer, const MeshPointer& a,
                 const MeshPointer& b) {
  const CertifiedInterval whole = interval_of(answer);
  const bool is_forward = !answer.b_to_a || answer.a_to_b.lower >= answer.b_to_a->lower;
  const Report& r = is_forward ? answer.a_to_b : *answer.b_to_a;
  Result result;
  result.lower = whole.lower;
  result.upper = whole.upper;
  result.status = whole.status;
  result.witness_a = r.witness_a;
  result.witness_b = r.witness_b;
  if (!is_forward) std::swap(result.witness_a, result.witness_b);
  result.stats = stats_of(answer, is_forward);
  result.notes = list_of_notes(answer);
  add_limit(answer, result);
  const std::string &path_a = answer.inputs[0].path, &path_b = answer.inputs[1].path;
  result.survey = survey_of(question, answer, {answer.a_to_b, answer.survey_a, a, path_b});
  if (answer.b_to_a)
    result.survey_back = survey_of(question, answer, {*answer.b_to_a, answer.survey_b, b, path_a});
  if (answer.placed) result.stats["transform"] = transform_of(*answer.placed);
  if (question.certificate) result.stats["certificate"] = certificate_of(answer);
  if (answer.metrics) result.stats["metrics"] = metrics_of(question, *answer.metrics);
  return result;
}

bool Result::is_upper_sought() const {
  return verdict != Verdict::kBeyond || stats.contains("area") || is_farthest_known(lower, upper);
}

const char* Result::verdict_name() const { return verdict ? vkh::verdict_name(*verdict) : nullptr; }

}  // namespace vkh::python
