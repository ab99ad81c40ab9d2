// An answer as Python gets it.
#include "host/python/answer.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <vector>

#include "host/answer/figures.h"
#include "host/base/decimal.h"
#include "host/base/float_environment.h"
#include "host/base/system.h"
#include "host/python/python_tree.h"
#include "host/solve/join_reports.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

/// The question, findings, work and times of a direction.
py::dict stats_of(const Answer& answer, const Report& r) {
  py::dict stats = members_of(answer.unit,
                              [&](auto& v) {
                                visit_search(v, answer, r);
                                v.number("tolerance", r.tolerance);
                                v.number("max", r.limit.within);
                                v.number("diagonal_a", r.diagonal_a);
                                visit_switches(v, r);
                                v.object("times", [&] { visit(v, r.times); });
                                visit_counts(v, r);
                                v.named_counts("culled", r.culled);
                                v.count("host_memory_bytes", r.host_memory_bytes);
                              },
                              {"interval", "times", "counts"});
  stats["mesh_a"] = counts_dict(r.mesh_a);
  stats["mesh_b"] = counts_dict(r.mesh_b);
  stats["device"] = device_dict(r.device);
  return stats;
}

py::array_t<double> array_of(const std::vector<double>& numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

/// A distance as the caller gave it: a number, or its text.
py::object key_of(const Length& length) {
  return length.is_double ? py::object(py::float_(length.number))
                          : py::object(py::str(length.requested));
}

/// The bands in the order of finish.cpp: the limit first.
py::list bands_of(const Question& question) {
  py::list bands;
  if (question.max) bands.append(key_of(*question.max));
  for (const Length& band : question.bands) bands.append(key_of(band));
  return bands;
}

py::tuple ends_of_faces(const Field& field) {
  return py::make_tuple(array_of(field.lower), array_of(field.upper));
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

void add_fields(const SurveyedSide& side, const Answer& answer, py::dict& parts) {
  const SurveyResult& found = *side.found;
  parts["field"] = ends_of_faces(found.field);
  parts["source"] = source_of(side, answer);
  if (!found.sides) return;
  parts["over_field"] = ends_of_faces(found.sides->over_of_faces);
  parts["under_field"] = ends_of_faces(found.sides->under_of_faces);
}

/// The figures of a direction by their keys, except for the distance itself.
py::dict figures_of(const Answer& answer, bool of_b) {
  py::dict figures;
  for (const AnswerFigure& figure : vkh::figures_of(answer)) {
    if (figure.of_b == of_b && figure.kind > FigureKind::kLargest &&
        figure.kind < FigureKind::kMetric)
      figures[py::str(figure.key)] = members_of("", [&](auto& v) {
        v.enclosure(figure.value);
        v.mark("jump", figure.jump);
      });
  }
  return figures;
}

/// Returns a Survey, which _survey.py makes of the members of JSON.
py::object survey_of(const Question& question, const Answer& answer, const SurveyedSide& side) {
  const std::optional<SurveyResult>& found = side.found;
  if (!found) return py::none();
  py::dict parts = members_of(answer.unit, [&](auto& v) {
    v.optional("survey", found, [&](const SurveyResult& survey) { visit(v, survey); });
    v.optional("statistics", found->statistics, [&](const Statistics& s) { visit(v, s); });
    v.optional("signed", found->sides, [&](const SignedFigures& s) { visit(v, s); });
  });
  parts["upper"] = side.report.upper;
  parts["figures"] = figures_of(answer, &found == &answer.survey_b);
  parts["bands"] = bands_of(question);
  if (question.faces) add_fields(side, answer, parts);
  return py::module_::import("vkhausdorff._survey").attr("made")(**parts);
}

/// The notes on the pair, and then those on A's file and B's.
py::list list_of_notes(const Answer& answer) {
  py::list notes;
  const auto add = [&](const std::vector<Note>& all) {
    for (const Note& note : all) notes.append(members_of("", [&](auto& v) { visit(v, note); }));
  };
  add(vkh::notes_of(answer));
  for (const Input& input : answer.inputs) add(notes_with_file(input));
  return notes;
}

py::dict proof_of(const Proof& proof) {
  return members_of("", [&](auto& v) { visit(v, proof); });
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
    both.asked_cells += proof->asked_cells;
    both.bytes += proof->bytes;
    both.ms += proof->ms;
  }
  py::dict certificate = proof_of(both);
  certificate["a_to_b"] = proof_of(*answer.proof_a);
  certificate["b_to_a"] = answer.proof_b ? py::object(proof_of(*answer.proof_b)) : py::none();
  return certificate;
}

/// Both directions as one report: their interval, the sums of counts and times, and the larger
/// amounts of memory.
Report report_of_both(const Answer& answer, bool is_forward) {
  Report both = answer.a_to_b;
  const Report& back = *answer.b_to_a;
  const CertifiedInterval whole = interval_of(answer);
  both.status = whole.status;
  both.lower = whole.lower;
  both.upper = whole.upper;
  if (!is_forward) {
    both.has_witness = back.has_witness;
    both.witness_a = back.witness_a;
    both.witness_b = back.witness_b;
  }
  both.waves += back.waves;
  both.candidates += back.candidates;
  both.queries += back.queries;
  both.peak_frontier = std::max(both.peak_frontier, back.peak_frontier);
  add_culled(back.culled, both.culled);
  both.workspace_bytes = std::max(both.workspace_bytes, back.workspace_bytes);
  both.host_memory_bytes = std::max(both.host_memory_bytes, back.host_memory_bytes);
  both.times.upload_ms += back.times.upload_ms;
  both.times.hierarchy_ms += back.times.hierarchy_ms;
  both.times.solve_ms += back.times.solve_ms;
  both.times.wall_ms += back.times.wall_ms;
  return both;
}

/// One schema for one direction and for both: members of the whole answer, and each direction by
/// itself.
py::dict stats_of(const Answer& answer, bool is_forward) {
  py::dict stats =
      stats_of(answer, answer.b_to_a ? report_of_both(answer, is_forward) : answer.a_to_b);
  stats["gap"] = interval_of(answer).gap;
  stats["direction"] = is_forward ? "a_to_b" : "b_to_a";
  stats["a_to_b"] = stats_of(answer, answer.a_to_b);
  stats["b_to_a"] =
      answer.b_to_a ? py::object(stats_of(answer, *answer.b_to_a)) : py::object(py::none());
  return stats;
}

/// Returns what _metrics.py makes Metrics of.
py::dict metrics_of(const Question& question, const Answer& answer) {
  py::dict metrics = members_of(answer.unit, [&](auto& v) { visit(v, *answer.metrics); });
  py::list bands;
  for (const Length& band : question.bands) bands.append(key_of(band));
  metrics["bands"] = bands;
  return metrics;
}

py::dict transform_of(const Answer& answer) {
  py::dict transform = members_of(answer.unit, [&](auto& v) { visit(v, *answer.placed, answer); });
  transform["found"] = answer.placed->fit.has_value();
  return transform;
}

void add_limit(const Answer& answer, py::dict& stats) {
  if (!answer.max) return;
  const std::optional<FaceLimits>& faces = answer.max->faces_a;
  if (faces || answer.max->area)
    stats["max"] = faces ? faces->limit.within : answer.max->limit.within;
  if (answer.max->area) stats["area"] = *answer.max->area;
  if (!faces) return;
  stats["faces_within"] = faces->within;
  stats["runs"] = faces->runs;
}

py::dict all_stats_of(const Question& question, const Answer& answer, bool is_forward) {
  py::dict stats = stats_of(answer, is_forward);
  add_limit(answer, stats);
  if (answer.placed) stats["transform"] = transform_of(answer);
  if (question.certificate) stats["certificate"] = certificate_of(answer);
  if (answer.metrics) stats["metrics"] = metrics_of(question, answer);
  return stats;
}

/// A point of a mesh: its face, its weights of the corners, and its coordinates.
py::tuple place_of(const SurfacePoint& p) {
  const auto xyz = [](const DVec3& v) { return py::make_tuple(v.x, v.y, v.z); };
  return py::make_tuple(p.face, xyz(p.barycentric), xyz(p.point));
}

/// Both ends as texts, rounded outward.
py::tuple outward(double lower, double upper) {
  const FloatEnvironment ours;
  constexpr int kDigits = 9;
  return py::make_tuple(decimal(lower, kDigits, Rounding::kDown),
                        decimal(upper, kDigits, Rounding::kUp));
}

}  // namespace

py::list matrix_rows(const MatrixRows& matrix) {
  return members_of("", [&](auto& v) { v.matrix("rows", matrix); })["rows"].cast<py::list>();
}

py::dict parts_of(const Question& question, const Answer& answer, const MeshPointer& a,
                  const MeshPointer& b) {
  const CertifiedInterval whole = interval_of(answer);
  const bool is_forward = !answer.b_to_a || answer.a_to_b.lower >= answer.b_to_a->lower;
  const Report& r = is_forward ? answer.a_to_b : *answer.b_to_a;
  py::dict parts;
  parts["lower"] = whole.lower;
  parts["upper"] = whole.upper;
  parts["status"] = status_name(whole.status);
  if (answer.max) parts["verdict"] = verdict_name(verdict_of(answer));
  parts["witness_a"] = place_of(is_forward ? r.witness_a : r.witness_b);
  parts["witness_b"] = place_of(is_forward ? r.witness_b : r.witness_a);
  parts["stats"] = all_stats_of(question, answer, is_forward);
  parts["notes"] = list_of_notes(answer);
  const std::string &path_a = answer.inputs[0].path, &path_b = answer.inputs[1].path;
  parts["survey"] = survey_of(question, answer, {answer.a_to_b, answer.survey_a, a, path_b});
  if (answer.b_to_a)
    parts["survey_back"] =
        survey_of(question, answer, {*answer.b_to_a, answer.survey_b, b, path_a});
  return parts;
}

py::object result_of(const py::dict& parts) {
  return py::module_::import("vkhausdorff._result").attr("made")(**parts);
}

void define_result(py::module_& m) {
  m.def("_outward", outward);
  m.def("_is_farthest_known", is_farthest_known);
}

}  // namespace vkh::python
