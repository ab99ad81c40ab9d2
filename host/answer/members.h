// The members of an answer, each of them once: their names, their order and their kinds.
//
// A visitor is called with each member. MemberWriter writes them, as JSON or as another tree, and
// JsonReader reads them back, so that a new member is one line here. Its kind is the call:
//   text, number, count, truth, named, ...  what it is; `_or_null`: what is empty or infinite
//   optional, nullable, mark, ..._if_any    missing, or null, if there is no value
//   bounds, enclosure, ends, down, up       rounded outward, with the doubles in hexadecimal
//   implied, beside                         the others imply it: written, and compared when read
//   told, said                              for people: compared where this version has written it
// A member that is missing is refused, unless its kind allows it, or a program before the version
// in its `..._since` has written the rest.
// is_full() is false for a result line, which leaves out what only one run or machine has.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "host/answer/figures.h"
#include "host/answer/result.h"
#include "host/answer/simplified.h"
#include "vkhausdorff/answer.h"

namespace vkh {

/// A visitor that reads changes what it visits; the others see it as const.
template <class V, class T>
using Of = std::conditional_t<V::kReads, T, const T>;

/// The words of an enumeration, from `first` to `last`.
template <class Enum>
struct Words {
  const char* (*word)(Enum);
  Enum last, first = Enum{};
};
inline constexpr Words<Status> kStatusWords{status_name, Status::kLimit};
inline constexpr Words<Verdict> kVerdictWords{verdict_name, Verdict::kUndecided};
inline constexpr Words<SurveyEnd> kSurveyEndWords{survey_end_name, SurveyEnd::kMemory};
inline constexpr Words<Inside> kInsideWords{inside_name, Inside::kUndecided};
inline constexpr Words<InsideOut> kInsideOutWords{inside_out_name, InsideOut::kAll,
                                                  InsideOut::kPart};

/// kBrief leaves out times, stages, waves and workspace, which only one run or machine has.
enum class Detail { kFull, kBrief };

/// The first line, as the other members imply it. None if it says more than they do: the limits of
/// single faces, or a share as it was typed.
std::optional<std::string> implied_words(const Answer& answer);

/// The input's notes. Notes without a file get the input's.
std::vector<Note> notes_with_file(const Input& input);

/// A text that is null if it is empty.
struct TextOrNull {
  std::string text = {};
};

/// The messages for an implied member that is refused: it is there, or is not; or it differs.
struct Refusals {
  const char *of_presence, *of_value;
};

// Notes, files and meshes.

template <class V>
void visit(V& v, Of<V, Note>& note) {
  v.note_code("code", note.code);
  v.text("text", note.text);
  v.number_or_none("value", note.value);
  v.text_or_null("unit", note.unit);
  v.text_or_null("file", note.file);
  v.count_or_none("face", note.face);
}

template <class V>
void visit(V& v, Of<V, FileHash>& file) {
  v.text("path", file.path);
  v.text_or_null("sha256", file.sha256);
}

/// The hash of an input's file, and the other files that were read; null where the hash is.
template <class V>
void visit_hashes(V& v, Of<V, Input>& input) {
  v.text_or_null("sha256", input.sha256);
  v.files("files", input.files, !input.sha256.empty(), [&](auto& file) { visit(v, file); });
}

/// A note that names no file is about the input's own.
template <class V>
void visit_notes(V& v, Of<V, Input>& input) {
  v.notes(
      "notes", input.notes, [&] { return notes_with_file(input); },
      [&](Note& note) {
        if (note.file == input.path) note.file.clear();
        return true;
      });
}

/// The members of an input that a failure has, too.
template <class V>
void visit_source(V& v, Of<V, Input>& input, const char* name) {
  v.beside("name", name);
  v.text("path", input.path);
  visit_hashes(v, input);
}

/// `are_known`: the mesh was read. Otherwise all are null.
template <class V>
void visit(V& v, Of<V, MeshCounts>& counts, Of<V, bool>& are_known) {
  v.counts("of a mesh that was not read", are_known,
           {{"vertices", counts.vertices},
            {"faces", counts.faces},
            {"unreferenced", counts.unreferenced},
            {"degenerate", counts.degenerate},
            {"duplicate", counts.duplicate},
            {"polygons", counts.polygons}});
}

template <class V>
void visit(V& v, Of<V, Input>& input, const char* name) {
  visit_source(v, input, name);
  visit(v, input.counts, input.is_read);
  v.mark("points", input.are_points);
  v.number("delta", input.place.delta);
  v.text_or_null("unit", input.place.unit);
  visit_notes(v, input);
}

template <class V>
void visit(V& v, Of<V, Box>& box) {
  v.vector("min", box.lo);
  v.vector("max", box.hi);
}

template <class V>
void visit(V& v, Of<V, PlacedInput>& placed, const Answer& answer) {
  v.text_or_null("from_unit", placed.from);
  v.implied(
      "unit", [&] { return TextOrNull{answer.unit}; }, "units that contradict each other");
  v.two_numbers("factor", placed.by.numerator, placed.by.denominator);
  v.matrix("matrix", placed.by.matrix);
  v.text_or_null("path", placed.file);
  v.text_or_null("sha256", placed.sha256);
  if (!v.has("found", placed.fit)) return;
  v.implied(
      "found", [] { return true; }, "a transform with found false");
  v.number("rms", placed.fit->rms);
  v.number("share", placed.fit->share);
  v.count("samples", placed.fit->samples);
}

// The run.

template <class V>
void visit(V& v, Of<V, DeviceDescription>& device) {
  v.count("index", device.index);
  v.text("name", device.name);
  v.text("type", device.type);
  v.text("api_version", device.api_version);
  v.count("memory_bytes", device.memory_bytes);
}

template <class V>
void visit_devices(V& v, Of<V, Report>& r) {
  if (v.is_some("device", !r.device.name.empty())) v.object("device", [&] { visit(v, r.device); });
  v.text_or_null("driver", r.device.driver);
  v.list_if_any("more_devices", r.more_devices, [&](auto& device) { visit(v, device); });
}

template <class V>
void visit(V& v, Of<V, Times>& times) {
  v.number("upload_ms", times.upload_ms);
  v.number("hierarchy_ms", times.hierarchy_ms);
  v.number("solve_ms", times.solve_ms);
  v.number("wall_ms", times.wall_ms);
}

template <class V>
void visit(V& v, Of<V, StageStats>& stage) {
  v.text("name", stage.name);
  v.number("gpu_ms", stage.gpu_ms);
  v.count("times", stage.times);
}

template <class V>
void visit(V& v, Of<V, WaveStats>& wave) {
  v.count("wave", wave.wave);
  v.count("parents", wave.parents);
  v.count("candidates", wave.candidates);
  v.count("queries", wave.queries);
  v.count("survivors", wave.survivors);
  v.count("deferred", wave.deferred);
  v.number_or_null("lower", wave.lower);
  v.number_or_null("upper", wave.upper);
}

/// The workspace depends on earlier runs of the device.
template <class V>
void visit_counts(V& v, Of<V, Report>& r) {
  v.object("counts", [&] {
    v.count("waves", r.waves);
    v.count("candidates", r.candidates);
    v.count("queries", r.queries);
    v.count("peak_frontier", r.peak_frontier);
    if (v.is_full()) v.count("workspace_bytes", r.workspace_bytes);
  });
}

template <class V>
void visit_work(V& v, Of<V, Report>& r) {
  if (v.is_full()) v.object("times", [&] { visit(v, r.times); });
  visit_counts(v, r);
  if (!v.is_full()) return;
  v.list("stages", r.stages, [&](auto& stage) { visit(v, stage); });
  v.named_counts("culled", r.culled);
  v.list("wave_stats", r.wave_stats, [&](auto& wave) { visit(v, wave); });
}

// Enclosures and figures.

/// `power`: of the answer's unit, in which the enclosed figure is.
template <class V>
void visit(V& v, const char* key, Of<V, Enclosure>& e, int power) {
  v.bounds(key, [&] {
    v.enclosure(e);
    v.unit(power);
  });
}

/// The same for a signed distance, whose ends may be negative.
template <class V>
void visit_signed(V& v, Of<V, Enclosure>& e) {
  v.signed_ends(e.lower, e.upper);
  v.unit(1);
}

template <class V>
void visit(V& v, Of<V, AreaWithin>& within) {
  v.number_or_null("distance", within.distance);
  v.unit(1);
  visit(v, "share", within.share, 0);
  v.mark("jump", within.jump);
}

template <class V>
void visit(V& v, Of<V, Percentile>& percentile) {
  v.number("share", percentile.share);
  visit(v, "distance", percentile.distance, 1);
  v.mark("jump", percentile.jump);
}

template <class V>
void visit_signed(V& v, Of<V, Percentile>& percentile) {
  v.number("share", percentile.share);
  v.bounds("distance", [&] { visit_signed(v, percentile.distance); });
}

template <class V>
void visit(V& v, Of<V, Statistics>& s) {
  v.number_or_null("area", s.area);
  v.count_if_any("points", s.points);
  if (v.has("kept", s.kept)) {
    v.number("max_distance", s.max_distance);
    visit(v, "kept", *s.kept, 0);
  }
  visit(v, "mean", s.mean, 1);
  visit(v, "rms", s.rms, 1);
  v.list("bands", s.bands, [&](auto& band) { visit(v, band); });
  v.list("percentiles", s.percentiles, [&](auto& percentile) { visit(v, percentile); });
  v.list("curve", s.curve, [&](auto& at) { visit(v, at); });
}

template <class V>
void visit(V& v, Of<V, Metric>& metric, int power) {
  v.enclosure(metric.value);
  v.unit(power);
  v.truth("met", metric.is_met);
  v.mark("jump", metric.jump);
}

template <class V>
void visit(V& v, Of<V, MetricsWithin>& at, bool has_normals) {
  v.number("distance", at.distance);
  v.unit(1);
  for (const NamedShare& share : kNamedShares) {
    if (has_normals || !share.of_normals)
      v.bounds(share.name, [&] { visit(v, at.*share.figure, 0); });
  }
}

template <class V>
void visit(V& v, Of<V, Metrics>& m) {
  v.number("percentile", m.percentile);
  v.implied(
      "met", [&] { return m.is_met(); }, "metrics: met contradicts the figures");
  v.texts_if_any("figures", m.figures);
  if (v.has("normals", m.normals)) v.number("normals", *m.normals);
  for (const NamedMetric& metric : kNamedMetrics) {
    if (m.normals || !metric.of_normals)
      v.bounds(metric.name, [&] { visit(v, m.*metric.figure, metric.dimension); });
  }
  v.list("within", m.within, [&](auto& at) { visit(v, at, m.normals.has_value()); });
}

// Sides.

template <class V>
void visit(V& v, Of<V, SurfacePoint>& point) {
  v.face("face", point);
  v.vector("barycentric", point.barycentric);
  v.vector("point", point.point);
}

template <class V>
void visit(V& v, Of<V, SidedPoint>& witness) {
  visit(v, witness.at);
  v.down("lower", witness.lower);
  v.unit(1);
}

template <class V>
void visit(V& v, Of<V, SignedFigures::Areas>& areas) {
  visit(v, "over", areas.over, 0);
  visit(v, "under", areas.under, 0);
  v.object("unsigned", [&] {
    for (size_t k = 1; k < kDoubts; ++k)
      visit(v, doubt_name(static_cast<Doubt>(k)), areas.doubts[k], 0);
  });
}

template <class V>
void visit(V& v, Of<V, SignedFigures>& s) {
  visit(v, "over", s.over, 1);
  visit(v, "under", s.under, 1);
  v.nullable("over_witness", s.over_witness, [&](auto& witness) { visit(v, witness); });
  v.nullable("under_witness", s.under_witness, [&](auto& witness) { visit(v, witness); });
  v.named("inside", s.inside, kInsideWords);
  v.named_unless(InsideOut::kNone, "inside_out", s.inside_out, kInsideOutWords);
  v.object("edges", [&] {
    v.count("open", s.edges.open);
    v.count("uneven", s.edges.uneven);
  });
  v.nullable("areas", s.areas, [&](auto& areas) { visit(v, areas); });
  v.nullable("mean", s.mean, [&](auto& mean) { visit_signed(v, mean); });
  v.list("percentiles", s.percentiles, [&](auto& percentile) { visit_signed(v, percentile); });
  if (v.is_full()) v.number("wall_ms", s.ms);
}

// Surveys.

template <class V>
void visit(V& v, Of<V, FieldSummary>& field, bool has_limit) {
  v.count("faces", field.faces);
  v.number_or_null("width", field.width);
  if (!has_limit) return;
  v.count("within", field.within);
  v.count("beyond", field.beyond);
  v.count("undecided", field.undecided);
}

template <class V>
void visit(V& v, Of<V, MapShares>& map) {
  v.number("low", map.bar.low);
  v.number("high", map.bar.high);
  v.unit(1);
  v.truth("signed", map.has_sides);
  if (v.has("limit", map.bar.limit)) v.number("limit", *map.bar.limit);
  if (v.has("limit_under", map.bar.limit_under)) v.number("limit_under", *map.bar.limit_under);
  v.number("above", map.above);
  v.number("below", map.below);
  v.number("no_side", map.no_side);
  v.number("left_out", map.left_out);
  v.number("unresolved", map.unresolved);
  v.number("within", map.within);
  v.number("mean", map.mean);
}

template <class V>
void visit(V& v, Of<V, SurveyResult>& survey) {
  v.implied(
      "met", [&] { return survey.is_met(); }, "met contradicts ended");
  v.count("effort", survey.effort);
  v.named("ended", survey.ended, kSurveyEndWords);
  v.count("cells", survey.cells);
  v.count("bounded", survey.bounded);
  if (v.is_full()) v.number("wall_ms", survey.ms);
}

/// The survey of one direction's mesh, with its options.
template <class V>
void visit_survey(V& v, Of<V, Answer>& answer, bool back) {
  auto& survey = back ? answer.survey_b : answer.survey_a;
  v.optional("survey", survey, [&](auto& found) { visit(v, found); });
  if (!survey) return;
  if (v.has("field", survey->faces))
    v.made(
        "field", survey->summary, [&] { return summary_of(answer, *survey); },
        [&](auto& field) { visit(v, field, answer.max.has_value()); });
  v.optional("statistics", survey->statistics, [&](auto& s) { visit(v, s); });
  v.optional("signed", survey->sides, [&](auto& sides) { visit(v, sides); });
  v.optional("map", survey->shares, [&](auto& map) { visit(v, map); });
}

template <class V>
void visit(V& v, Of<V, Proof>& proof) {
  v.up("upper", proof.upper);
  v.count("leaves", proof.leaves);
  v.count("cut_leaves", proof.cut_leaves);
  v.count("unproven", proof.unproven);
  v.count("cells", proof.asked_cells);
  v.count("bytes", proof.bytes);
  v.number("wall_ms", proof.ms);
}

// Directions.

template <class V>
void visit_witness(V& v, Of<V, Report>& r) {
  if (!v.is_some("witness", r.has_witness)) return;
  v.object("witness", [&] {
    v.object("from", [&] { visit(v, r.witness_a); });
    v.object("to", [&] {
      v.face("face", r.witness_b);
      v.vector("point", r.witness_b.point);
    });
  });
}

template <class V>
void visit(V& v, Of<V, CoverageCheck>& check) {
  v.truth("coverage", check.holds);
  v.object("faces", [&] {
    v.count("whole", check.whole);
    v.count("waiting", check.waiting);
    v.count("wrong", check.wrong);
  });
  v.number("closed", check.closed);
}

template <class V>
void visit_verified(V& v, Of<V, Report>& r, Of<V, WitnessCheck>& check) {
  v.truth("witness", check.holds);
  v.down("distance_lower", check.distance_lower);
  v.up("distance_upper", check.distance_upper);
  if (v.has("coverage", r.coverage_check)) visit(v, *r.coverage_check);
}

inline constexpr const char* kWrongGap = "a gap that is not that of its interval";

/// The findings of a direction's search.
template <class V>
void visit_search(V& v, const Answer& answer, Of<V, Report>& r) {
  v.named("status", r.status, kStatusWords);
  v.told("stop_reason", [&] { return stop_reason(answer, r.status); });
  v.bounds("interval", [&] {
    v.ends(r.lower, r.upper);
    v.implied(
        "gap", [&] { return r.gap(); }, kWrongGap);
    v.unit(1);
  });
  v.number("known_lower", r.known_lower);
  visit_witness(v, r);
  v.optional("verified", r.witness_check, [&](auto& check) { visit_verified(v, r, check); });
}

template <class V>
void visit_direction(V& v, Of<V, Answer>& answer, Of<V, Report>& r, bool back) {
  v.implied(
      "from", [&] { return back ? "b" : "a"; }, "directions are not A's and B's");
  v.beside("to", back ? "a" : "b");
  visit_search(v, answer, r);
  visit_survey(v, answer, back);
  v.optional("certificate", back ? answer.proof_b : answer.proof_a,
             [&](auto& proof) { visit(v, proof); });
  visit_work(v, r);
}

// The question.

/// The length as it was typed; what it is a share of is beside it.
template <class V>
void visit_diagonal_of(V& v, const Length& length) {
  v.implied(
      "diagonal_of", [&] { return TextOrNull{length.of == Length::Of::kDiagonal ? "a" : ""}; },
      [&] { return "requested '" + length.requested + "' and diagonal_of contradict each other"; });
}

/// Lengths are null until both meshes are read.
template <class V>
void visit_side(V& v, Of<V, Length>& length, Of<V, Limit>& limit, bool is_known) {
  v.length("requested", length);
  v.number_if_known("within", limit.within, is_known);
  v.number_if_known("beyond", limit.beyond, is_known);
  visit_diagonal_of(v, length);
}

template <class V>
void visit(V& v, Of<V, FaceLimits>& faces) {
  v.text("path", faces.path);
  v.text_or_null("sha256", faces.sha256);
  v.count("faces", faces.faces);
  v.count("within", faces.within);
  v.count("runs", faces.runs);
  v.named("verdict", faces.verdict, kVerdictWords);
}

template <class V>
void visit(V& v, Of<V, Asked>& max, bool is_known) {
  v.length("requested", max.length);
  v.number_if_known("within", max.limit.within, is_known);
  v.number_if_known("beyond", max.limit.beyond, is_known);
  v.unit(1);
  visit_diagonal_of(v, max.length);
  if (v.has("area", max.area)) v.number("area", *max.area);
  v.optional("sides", max.sides, [&](auto& sides) {
    v.object("over", [&] { visit_side(v, sides.over, sides.limits.over, is_known); });
    v.object("under", [&] { visit_side(v, sides.under, sides.limits.under, is_known); });
  });
  v.mark("worst", max.worst);
  v.optional("faces_a", max.faces_a, [&](auto& faces) { visit(v, faces); });
  v.optional("faces_b", max.faces_b, [&](auto& faces) { visit(v, faces); });
}

template <class V>
void visit_tolerance(V& v, Of<V, Answer>& answer) {
  const bool is_known = are_read(answer);
  v.length("requested", answer.tolerance);
  v.number_if_known("absolute", answer.a_to_b.tolerance, is_known);
  v.text_or_null("unit", answer.unit);
  visit_diagonal_of(v, answer.tolerance);
  v.number_if_known("diagonal", answer.a_to_b.diagonal_a, is_known);
  if (answer.b_to_a) v.number_since("0.3.0", "diagonal_b", answer.b_to_a->diagonal_a, is_known);
}

template <class V>
void visit_switches(V& v, Of<V, Report>& r) {
  v.text("preset", r.preset);
  v.texts("switched_on", r.switched_on);
  v.texts("switched_off", r.switched_off);
}

template <class V>
void visit_options(V& v, Of<V, Answer>& answer) {
  v.implied(
      "symmetric", [&] { return answer.b_to_a.has_value(); },
      "symmetric contradicts the directions");
  visit_switches(v, answer.a_to_b);
}

// The answer.

template <class V>
void visit_whole(V& v, const Answer& answer) {
  v.bounds("interval", [&] {
    v.implied_ends([&] { return interval_of(answer); },
                   "an interval that is not that of its directions");
    v.implied(
        "gap", [&] { return interval_of(answer).gap; }, kWrongGap);
    v.unit(1);
  });
}

template <class V>
void visit_verdict(V& v, Of<V, Answer>& answer) {
  v.implied_if(answer.max.has_value(), "verdict", [&] { return verdict_name(verdict_of(answer)); },
               {"a verdict without a limit, or a limit without one",
                "a verdict that is not that of its bounds"});
  v.optional("max", answer.max, [&](auto& max) { visit(v, max, are_read(answer)); });
}

template <class V>
void visit_meshes(V& v, Of<V, Answer>& answer) {
  auto &a = answer.inputs[0], &b = answer.inputs[1];
  v.array_of_two("inputs", [&](bool is_b) { visit(v, is_b ? b : a, is_b ? "b" : "a"); });
  v.notes(
      "notes", answer.notes, [&] { return notes_of(answer); },
      [](const Note& note) { return note.code != NoteCode::kOneWay; });
  if (v.has("boxes", a.box, b.box))
    v.object("boxes", [&] {
      v.object("a", [&] { visit(v, *a.box); });
      v.object("b", [&] { visit(v, *b.box); });
    });
  v.optional("transform", answer.placed, [&](auto& placed) { visit(v, placed, answer); });
}

/// The members that an answer and a result line have in common.
template <class V>
void visit_common(V& v, Of<V, Answer>& answer) {
  v.in_unit(answer.unit);
  v.said("words", answer.first_line, answer);
  v.implied(
      "status", [&] { return status_name(interval_of(answer).status); },
      "a status that is not that of its directions");
  v.told("stop_reason", [&] { return stop_reason(answer, interval_of(answer).status); });
  visit_verdict(v, answer);
  v.optional("part", answer.part, [&](auto& part) {
    v.count("index", part.index);
    v.count("count", part.count);
  });
  v.count_if_any("parts", answer.parts);
  visit_whole(v, answer);
  v.one_or_two("directions", answer.a_to_b, answer.b_to_a,
               [&](auto& r, bool back) { visit_direction(v, answer, r, back); });
  v.optional("metrics", answer.metrics, [&](auto& metrics) { visit(v, metrics); });
  visit_meshes(v, answer);
  v.object("tolerance", [&] { visit_tolerance(v, answer); });
  v.object("options", [&] { visit_options(v, answer); });
}

template <class V>
void visit_waits(V& v, Of<V, Waits>& waits) {
  v.object("times", [&] {
    v.number("read_ms", waits.read);
    v.number("start_ms", waits.start);
    v.number("total_ms", waits.total);
  });
}

template <class V>
void visit(V& v, Of<V, Answer>& answer) {
  v.text("version", answer.version);
  v.in_version(answer.version);
  visit_common(v, answer);
  visit_devices(v, answer.a_to_b);
  visit_waits(v, answer.waits);
  v.text("command", answer.command);
  v.texts("arguments", answer.words);
  v.text("host", answer.host);
  v.text("started", answer.started);
}

template <class V>
void visit(V& v, Of<V, Failure>& failure) {
  v.count("code", failure.code);
  v.text("message", failure.message);
  v.text_or_null("file", failure.file);
  v.text_or_null("place", failure.place);
}

/// A result line. A failure has what is known of its inputs and its run.
template <class V>
void visit(V& v, Of<V, Result>& result) {
  auto& answer = result.answer;
  v.text("version", answer.version);
  v.in_version(answer.version);
  v.text("id", result.name.id);
  v.text("key", result.name.key);
  v.exit_code("code", result.code);
  v.optional("error", result.failure, [&](auto& failure) { visit(v, failure); });
  if (result.failure)
    v.array_of_two("inputs", [&](bool is_b) {
      visit_source(v, answer.inputs[is_b ? 1 : 0], is_b ? "b" : "a");
    });
  else
    visit_common(v, answer);
  v.object_if_there("run", [&] {
    visit_devices(v, answer.a_to_b);
    v.object("times", [&] {
      v.number("read_ms", answer.waits.read);
      v.number("gpu_ms", result.gpu_ms);
      v.number("total_ms", answer.waits.total);
    });
    v.text("host", answer.host);
    v.text("started", answer.started);
  });
}

// The answer of `simplify`, which is not read.

template <class V>
void visit_end(V& v, const char* key, const Report& r) {
  v.object(key, [&] {
    v.ends(r.lower, r.upper);
    v.named("status", r.status, kStatusWords);
  });
}

template <class V>
void visit(V& v, const SimplifiedFile& file) {
  v.text("path", file.path);
  v.text("format", file.format);
  v.text_or_null("sha256", file.sha256);
  v.count("faces", file.counts.faces);
  v.count("vertices", file.counts.vertices);
  const Deviation& deviation = file.deviation;
  v.ends(deviation.interval.lower, deviation.interval.upper);
  v.named("verdict", deviation.verdict, kVerdictWords);
  visit_end(v, "a_to_b", deviation.a_to_b);
  if (v.is_some("b_to_a", deviation.b_to_a.has_value())) visit_end(v, "b_to_a", *deviation.b_to_a);
}

template <class V>
void visit_simplified_input(V& v, const Input& input) {
  v.text("path", input.path);
  visit_hashes(v, input);
  v.count("faces", input.counts.faces);
  v.count("vertices", input.counts.vertices);
  v.number("delta", input.place.delta);
  visit_notes(v, input);
}

template <class V>
void visit(V& v, const SimplifyAnswer& answer) {
  v.text("version", program_version());
  v.told("words", [&] { return in_words(answer); });
  v.object("input", [&] { visit_simplified_input(v, answer.input); });
  v.text_or_null("unit", answer.unit);
  v.object("max", [&] {
    v.length("requested", answer.max);
    v.down("within", answer.limit.within);
    v.up("beyond", answer.limit.beyond);
  });
  v.truth("one_way", answer.one_way);
  v.truth("lock_borders", answer.lock_borders);
  v.told("found", [&] { return !answer.files.empty(); });
  v.truth("complete", answer.complete);
  v.count("tried", answer.tried);
  v.list("files", answer.files, [&](auto& file) { visit(v, file); });
  v.texts("removed", answer.removed);
  v.text_or_null("certificate", answer.certificate);
  v.text_or_null("device", answer.device.name);
  v.text_or_null("driver", answer.device.driver);
  visit_waits(v, answer.waits);
  v.text("command", "simplify");
  v.texts("arguments", answer.words);
}

}  // namespace vkh
