// An answer as JSON.
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/answer/json_object.h"
#include "host/base/decimal.h"
#include "host/base/float_environment.h"
#include "host/base/rounding.h"
#include "vkhausdorff/answer.h"

namespace vkh {
namespace {

Json vector_json(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

Json witness_json(const Report& r) {
  if (!r.has_witness) return nullptr;
  return {{"from",
           {{"face", r.witness_a.file_face},
            {"barycentric", vector_json(r.witness_a.barycentric)},
            {"point", vector_json(r.witness_a.point)}}},
          {"to", {{"face", r.witness_b.file_face}, {"point", vector_json(r.witness_b.point)}}}};
}

Json box_json(const Box& box) {
  return {{"min", vector_json(box.lo)}, {"max", vector_json(box.hi)}};
}

// Writes null counts before a mesh is read. The delta is written so that it is read back as the
// same double.
Json input_json(const char* name, const Input& input) {
  Json json = {{"name", name}, {"path", input.path}};
  add_hashes(json, input);
  const auto add = [&](const char* key, uint64_t count) {
    json[key] = input.is_read ? Json(count) : Json();
  };
  add("vertices", input.counts.vertices);
  add("faces", input.counts.faces);
  add("unreferenced", input.counts.unreferenced);
  add("degenerate", input.counts.degenerate);
  add("duplicate", input.counts.duplicate);
  add("polygons", input.counts.polygons);
  if (input.are_points) json["points"] = true;
  json["delta"] = input.place.delta;
  json["unit"] = text_or_null(input.place.unit);
  json["notes"] = notes_json(input.notes, input.path);
  return json;
}

// The matrix has all four rows, as its file has.
Json transform_json(const Answer& answer) {
  const PlacedInput& placed = *answer.placed;
  Json json = {{"from_unit", text_or_null(placed.from)},
               {"unit", text_or_null(answer.unit)},
               {"factor", Json::array({placed.by.numerator, placed.by.denominator})},
               {"matrix", nullptr},
               {"path", text_or_null(placed.file)},
               {"sha256", text_or_null(placed.sha256)}};
  if (placed.fit) {
    json["found"] = true;
    json["rms"] = placed.fit->rms;
    json["share"] = placed.fit->share;
    json["samples"] = placed.fit->samples;
  }
  if (!placed.by.matrix) return json;
  json["matrix"] = Json::array();
  for (const auto& row : *placed.by.matrix) json["matrix"].push_back(row);
  json["matrix"].push_back(Json::array({0.0, 0.0, 0.0, 1.0}));
  return json;
}

Json device_json(const DeviceDescription& d) {
  if (d.name.empty()) return nullptr;  // no device was opened yet
  return {{"index", d.index},
          {"name", d.name},
          {"type", d.type},
          {"api_version", d.api_version},
          {"memory_bytes", d.memory_bytes}};
}

Json devices_json(const std::vector<DeviceDescription>& devices) {
  Json rows = Json::array();
  for (const DeviceDescription& device : devices) rows.push_back(device_json(device));
  return rows;
}

Json stages_json(const std::vector<StageStats>& stages) {
  Json rows = Json::array();
  for (const StageStats& s : stages) {
    rows.push_back({{"name", s.name}, {"gpu_ms", s.gpu_ms}, {"times", s.times}});
  }
  return rows;
}

Json culled_json(const std::vector<CullCount>& culled) {
  Json json = Json::object();
  for (const CullCount& c : culled) json[c.name] = c.candidates;
  return json;
}

Json wave_stats_json(const std::vector<WaveStats>& waves) {
  Json rows = Json::array();
  for (const WaveStats& w : waves) {
    rows.push_back({{"wave", w.wave},
                    {"parents", w.parents},
                    {"candidates", w.candidates},
                    {"queries", w.queries},
                    {"survivors", w.survivors},
                    {"deferred", w.deferred},
                    {"lower", w.lower},
                    {"upper", w.upper}});
  }
  return rows;
}

std::string interval_json(double lower, double upper, double gap, const std::string& unit) {
  JsonObject json;
  json.add_bound("lower", lower, Rounding::kDown);
  json.add_bound("upper", upper, Rounding::kUp);
  json.add("gap", gap);
  json.add("unit", text_or_null(unit));
  return json.text();
}

void add_status(JsonObject& json, const Answer& answer, Status status) {
  json.add("status", status_name(status));
  json.add("stop_reason", stop_reason(answer, status));
}

Json diagonal_of(const Length& length) {
  return length.of == Length::Of::kDiagonal ? Json("a") : Json();
}

Json faces_json(const FaceLimits& faces) {
  return {{"path", faces.path},   {"sha256", text_or_null(faces.sha256)},
          {"faces", faces.faces}, {"within", faces.within},
          {"runs", faces.runs},   {"verdict", verdict_name(faces.verdict)}};
}

/// A length in the answer's unit: null until the meshes are read, which it waits for.
Json length_json(const Answer& answer, double length) {
  return are_read(answer) ? Json(length) : Json();
}

Json sides_json(const Answer& answer) {
  const AskedSides& sides = *answer.max->sides;
  const auto one = [&](const Length& length, const Limit& limit) {
    return Json{{"requested", length.requested},
                {"within", length_json(answer, limit.within)},
                {"beyond", length_json(answer, limit.beyond)},
                {"diagonal_of", diagonal_of(length)}};
  };
  return {{"over", one(sides.over, sides.limits.over)},
          {"under", one(sides.under, sides.limits.under)}};
}

std::string max_json(const Answer& answer) {
  JsonObject json;
  json.add("requested", answer.max->length.requested);
  json.add("within", length_json(answer, answer.max->limit.within));
  json.add("beyond", length_json(answer, answer.max->limit.beyond));
  json.add("unit", text_or_null(answer.unit));
  json.add("diagonal_of", diagonal_of(answer.max->length));
  if (answer.max->area) json.add("area", *answer.max->area);
  if (answer.max->sides) json.add("sides", sides_json(answer));
  if (answer.max->worst) json.add("worst", true);
  if (answer.max->faces_a) json.add("faces_a", faces_json(*answer.max->faces_a));
  if (answer.max->faces_b) json.add("faces_b", faces_json(*answer.max->faces_b));
  return json.text();
}

Json tolerance_json(const Answer& answer) {
  return {{"requested", answer.tolerance.requested},
          {"absolute", length_json(answer, answer.a_to_b.tolerance)},
          {"unit", text_or_null(answer.unit)},
          {"diagonal_of", diagonal_of(answer.tolerance)},
          {"diagonal", length_json(answer, answer.a_to_b.diagonal_a)}};
}

Json options_json(const Answer& answer) {
  const Report& r = answer.a_to_b;
  return {{"symmetric", answer.b_to_a.has_value()},
          {"preset", r.preset},
          {"switched_on", r.switched_on},
          {"switched_off", r.switched_off}};
}

std::string verified_json(const Report& r) {
  const WitnessCheck& check = *r.witness_check;
  JsonObject json;
  json.add("witness", check.holds);
  json.add_bound("distance_lower", check.distance_lower, Rounding::kDown);
  json.add_bound("distance_upper", check.distance_upper, Rounding::kUp);
  if (r.coverage_check) {
    const CoverageCheck& c = *r.coverage_check;
    json.add("coverage", c.holds);
    json.add("faces", {{"whole", c.whole}, {"waiting", c.waiting}, {"wrong", c.wrong}});
    json.add("closed", c.closed);
  }
  return json.text();
}

Json times_json(const Times& t) {
  return {{"upload_ms", t.upload_ms},
          {"hierarchy_ms", t.hierarchy_ms},
          {"solve_ms", t.solve_ms},
          {"wall_ms", t.wall_ms}};
}

std::string proof_json(const Proof& proof) {
  JsonObject json;
  json.add_bound("upper", proof.upper, Rounding::kUp);
  json.add("leaves", proof.leaves);
  json.add("cut_leaves", proof.cut_leaves);
  json.add("unproven", proof.unproven);
  json.add("cells", proof.asked_cells);
  json.add("bytes", proof.bytes);
  json.add("wall_ms", proof.ms);
  return json.text();
}

Json counts_json(const Report& r, Detail detail) {
  Json counts = {{"waves", r.waves},
                 {"candidates", r.candidates},
                 {"queries", r.queries},
                 {"peak_frontier", r.peak_frontier}};
  // The workspace depends on earlier runs of the device.
  if (detail == Detail::kFull) counts["workspace_bytes"] = r.workspace_bytes;
  return counts;
}

std::string direction_json(const Answer& answer, const Report& r, bool back, Detail detail) {
  JsonObject json;
  json.add("from", back ? "b" : "a");
  json.add("to", back ? "a" : "b");
  add_status(json, answer, r.status);
  json.add_text("interval", interval_json(r.lower, r.upper, r.gap(), answer.unit));
  json.add("known_lower", r.known_lower);
  json.add("witness", witness_json(r));
  if (r.witness_check) json.add_text("verified", verified_json(r));
  const std::optional<SurveyResult>& survey = back ? answer.survey_b : answer.survey_a;
  if (survey) add_survey(json, *survey, answer, detail);
  const std::optional<Proof>& proof = back ? answer.proof_b : answer.proof_a;
  if (proof) json.add_text("certificate", proof_json(*proof));
  if (detail == Detail::kFull) json.add("times", times_json(r.times));
  json.add("counts", counts_json(r, detail));
  if (detail == Detail::kBrief) return json.text();
  json.add("stages", stages_json(r.stages));
  json.add("culled", culled_json(r.culled));
  json.add("wave_stats", wave_stats_json(r.wave_stats));
  return json.text();
}

}  // namespace

void add_hashes(Json& json, const Input& input) {
  json["sha256"] = text_or_null(input.sha256);
  if (input.sha256.empty()) {
    json["files"] = nullptr;
    return;
  }
  json["files"] = Json::array();
  for (const FileHash& file : input.files)
    json["files"].push_back({{"path", file.path}, {"sha256", text_or_null(file.sha256)}});
}

void add_answer(JsonObject& json, const Answer& answer, Detail detail) {
  const CertifiedInterval whole = interval_of(answer);
  json.add("words", in_words(answer));
  add_status(json, answer, whole.status);
  if (answer.max) {
    json.add("verdict", verdict_name(verdict_of(answer)));
    json.add_text("max", max_json(answer));
  }
  if (answer.part) json.add("part", {{"index", answer.part->index}, {"count", answer.part->count}});
  if (answer.parts > 0) json.add("parts", answer.parts);
  json.add_text("interval", interval_json(whole.lower, whole.upper, whole.gap, answer.unit));
  std::string directions = direction_json(answer, answer.a_to_b, false, detail);
  if (answer.b_to_a) directions += "," + direction_json(answer, *answer.b_to_a, true, detail);
  json.add_text("directions", "[" + directions + "]");
  if (answer.metrics) add_metrics(json, answer);
  json.add("inputs",
           Json::array({input_json("a", answer.inputs[0]), input_json("b", answer.inputs[1])}));
  json.add("notes", notes_json(notes_of(answer), ""));
  if (answer.inputs[0].box && answer.inputs[1].box)
    json.add("boxes",
             {{"a", box_json(*answer.inputs[0].box)}, {"b", box_json(*answer.inputs[1].box)}});
  if (answer.placed) json.add("transform", transform_json(answer));
  json.add("tolerance", tolerance_json(answer));
  json.add("options", options_json(answer));
}

void add_device(JsonObject& json, const Answer& answer) {
  const DeviceDescription& device = answer.a_to_b.device;
  json.add("device", device_json(device));
  json.add("driver", text_or_null(device.driver));
  if (!answer.a_to_b.more_devices.empty())
    json.add("more_devices", devices_json(answer.a_to_b.more_devices));
}

void add_waits(JsonObject& json, const Waits& waits) {
  json.add("times",
           {{"read_ms", waits.read}, {"start_ms", waits.start}, {"total_ms", waits.total}});
}

std::string to_json(const Answer& answer) {
  JsonObject json;
  json.add("schema", kAnswerSchema);
  json.add("version", answer.version);
  add_answer(json, answer, Detail::kFull);
  add_device(json, answer);
  add_waits(json, answer.waits);
  json.add("command", answer.command);
  json.add("arguments", answer.words);
  json.add("host", answer.host);
  json.add("started", answer.started);
  return json.text();
}

Failure failure_of(const Error& error) {
  const bool is_of_input = error.parts().option.empty();
  return {.code = code_of(error.kind()),
          .message = error.what(),
          .file = is_of_input ? error.file() : "",
          .place = is_of_input ? error.place() : ""};
}

std::string to_json(const Failure& failure) { return failure_json(failure, kAnswerSchema); }

std::string failure_json(const Failure& failure, const char* schema) {
  JsonObject json;
  json.add("schema", schema);
  json.add("version", program_version());
  json.add("error", {{"code", failure.code},
                     {"message", failure.message},
                     {"file", text_or_null(failure.file)},
                     {"place", text_or_null(failure.place)}});
  return json.text();
}

}  // namespace vkh
