// An answer's JSON, read back: byte for byte what was written, and nothing that was changed since.
#include <doctest/doctest.h>

#include <cstdlib>
#include <functional>
#include <limits>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "host/answer/json_object.h"
#include "host/answer/merge_parts.h"
#include "host/base/decimal.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Report report(double lower, double upper) {
  Report r;
  r.lower = lower;
  r.upper = upper;
  r.tolerance = 0x1p-6;
  r.diagonal_a = 10;
  r.has_witness = true;
  r.witness_a = {.face = 7, .barycentric = {0.25, 0.5, 0.25}, .point = {0.1, -0.0, 1e300}};
  r.witness_a.file_face = r.witness_b.file_face = 7;
  r.waves = 3;
  r.candidates = uint64_t{1} << 60;
  r.culled = {{"exact", 3}, {"u1", 4}};
  r.stages = {{.name = "morton", .gpu_ms = 0.1, .times = 1}};
  r.wave_stats = {{.wave = 2, .parents = 1, .lower = 0.5, .upper = kInfinity}};
  r.times = {.upload_ms = 0.1, .hierarchy_ms = 0.2, .solve_ms = 1.0 / 3, .wall_ms = 4};
  r.switched_on = {"u3"};
  return r;
}

DeviceDescription device_named(const char* name) {
  DeviceDescription device;
  device.index = 3;
  device.name = name;
  device.type = "cpu";
  device.memory_bytes = uint64_t{1} << 40;
  return device;
}

Answer distance() {
  Answer answer;
  answer.command = "distance";
  answer.words = {"distance", "a\n\xc3\xa4.ply", "b.ply"};
  answer.started = "2026-01-01T00:00:00Z";
  answer.host = "here";
  for (size_t i = 0; i < 2; ++i) {
    Input& input = answer.inputs[i];
    input.path = i == 0 ? "a\n\xc3\xa4.ply" : "b.ply";
    input.is_read = true;
    input.counts = {.vertices = 4, .faces = 2, .polygons = 1};
    input.place = {.delta = 0.1, .unit = "mm"};
    input.sha256 = std::string(64, i == 0 ? 'a' : 'b');
    input.notes = {{.code = NoteCode::kPolygons, .text = "so", .value = 0.1, .unit = "faces"}};
    input.box = Box{{0, 0, 0}, {1, 2, 2}};
  }
  answer.inputs[0].files = {{"a.bin", std::string(64, 'c')}, {"gone.bin", ""}};
  answer.notes = {{.code = NoteCode::kSize, .text = "odd", .file = "b.ply", .face = 3}};
  answer.unit = "mm";
  answer.tolerance = {.requested = "0.1%", .number = 0.001};
  answer.a_to_b = report(0.1, 0.1 + 0x1p-7);
  answer.a_to_b.device = device_named("a GPU");
  answer.a_to_b.device.driver = "x";
  answer.waits = {.read = 0.1, .start = 2, .total = 3};
  return answer;
}

Answer both_directions() {
  Answer answer = distance();
  answer.b_to_a = report(0.2, 0.2 + 0x1p-7);
  answer.b_to_a->diagonal_a = 3;  // of B's box
  return answer;
}

Answer gate(const char* limit, double within, double upper) {
  Answer answer = distance();
  answer.command = "gate";
  answer.a_to_b.upper = upper;
  answer.max = Asked{.length = parse_length("max", limit, PlainNumber::kFraction),
                     .limit = {within, within}};
  return answer;
}

Answer by_face() {
  Answer answer = gate("0.05mm", 0.05, 0.2);
  answer.a_to_b.status = Status::kLimit;
  answer.max->faces_a = FaceLimits{.path = "limits.csv",
                                   .sha256 = std::string(64, 'd'),
                                   .within = 1,
                                   .faces = 2,
                                   .runs = 3,
                                   .limit = {0.07, 0.07},
                                   .verdict = Verdict::kBeyond};
  return answer;
}

Statistics statistics() {
  Statistics s;
  s.area = 2.5;
  s.mean = {0.1, 0.2, 0.15};
  s.rms = {0.15, 0.25};
  s.bands = {{.distance = 0.1, .share = {0.3, 0.4, 0.3}, .jump = true}};
  s.percentiles = {{.share = 0.5, .distance = {0.1, kInfinity}},
                   {.share = 0.9, .distance = {0.1, 0.3, 0.2}, .jump = true}};
  s.curve = {{.distance = 0, .share = {0, 0.1}}, {.distance = 0.3, .share = {1, 1}}};
  return s;
}

Answer surveyed() {
  Answer answer = gate("0.1mm", 0.1, 0.2);
  answer.max->area = 0.95;
  answer.max->area_requested = "95%";
  SurveyResult survey;
  survey.faces = true;
  survey.field = {.lower = {0, 0.2, 0.1}, .upper = {0.05, 0.3, 0.15}};
  survey.statistics = statistics();
  survey.ended = SurveyEnd::kEffort;
  survey.effort = 10;
  survey.cells = 5;
  survey.bounded = 9;
  survey.ms = 0.7;
  answer.survey_a = survey;
  return answer;
}

SignedFigures sides() {
  SignedFigures s;
  s.over = {0.1, 0.15};
  s.under = {0.12, 0.15};
  SidedPoint far{.at = {}, .lower = 0.1};
  far.at.face = far.at.file_face = 7;
  far.at.barycentric = {0.25, 0.5, 0.25};
  far.at.point = {1, -2, 0.125};
  s.over_witness = far;
  s.inside = Inside::kOpen;
  s.inside_out = InsideOut::kPart;
  s.edges = {.open = 3, .uneven = 1};
  s.areas.emplace();
  s.areas->over = {0.4, 0.5};
  s.areas->doubts[2] = {0.1, 0.2};
  s.mean = {-0.1, 0.2};
  s.percentiles = {{.share = 0.01, .distance = {-kInfinity, -0.125}}};
  s.ms = 0.25;
  return s;
}

Answer on_sides() {
  Answer answer = gate("0.2mm", 0.2, 0.15);
  answer.max->sides = AskedSides{parse_length("max", "0.2mm", PlainNumber::kRefused),
                                 parse_length("max", "0.1mm", PlainNumber::kRefused),
                                 {{0.2, 0.2}, {0.1, 0.1}}};
  answer.survey_a.emplace();
  answer.survey_a->ended = SurveyEnd::kMet;
  answer.survey_a->sides = sides();
  return answer;
}

Answer proven() {
  Answer answer = distance();
  answer.proof_a = Proof{.upper = 0.2, .blocks = "leaves", .bytes = 6, .leaves = 3, .ms = 0.3};
  answer.a_to_b.witness_check = WitnessCheck{0.1, 0.11, true};
  answer.a_to_b.coverage_check = CoverageCheck{.whole = 2, .closed = 0.9, .holds = true};
  return answer;
}

Answer on_devices() {
  Answer answer = distance();
  answer.a_to_b.more_devices = {device_named("another"), device_named("a third")};
  return answer;
}

Answer part() {
  Answer answer = distance();
  answer.part = PartOf{0, 1};
  answer.inputs[0].files.clear();
  answer.a_to_b.status = Status::kPruned;
  return answer;
}

Answer merged() { return merge_parts({{"f", "line 1", Json::parse(to_json(part()))}}); }

/// An answer to a run that ended before anything was known.
Answer unread() {
  Answer answer;
  answer.command = "demo";
  answer.a_to_b.upper = kInfinity;
  answer.a_to_b.status = Status::kTime;
  answer.b_to_a = answer.a_to_b;
  return answer;
}

Answer placed() {
  Answer answer = distance();
  MeshTransform by{.numerator = 127, .denominator = 5};
  by.matrix = MatrixRows{{{0.1, -1, 0, 1.5}, {1, 0.1, -0.0, 1e-300}, {0, 0, 1, 3}}};
  answer.placed =
      PlacedInput{.by = by, .from = "in", .file = "m.txt", .sha256 = std::string(64, 'd')};
  return answer;
}

std::vector<Answer> all_kinds() {
  return {distance(),
          placed(),
          both_directions(),
          gate("0.2mm", 0.2, 0.15),
          gate("0.05mm", 0.05, 0.15),
          gate("0.12mm", 0.12, 0.15),
          by_face(),
          surveyed(),
          on_sides(),
          proven(),
          on_devices(),
          part(),
          merged(),
          unread()};
}

/// Calls `change` with the pointer of each member and element, the deepest ones included.
void for_each_value(const Json& json, const std::string& at,
                    const std::function<void(const std::string&, const Json&)>& take) {
  if (!at.empty()) take(at, json);
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) for_each_value(value, at + "/" + key, take);
}

/// A document that is not refused is read as an answer that has a document of its own.
bool is_refused(const Json& json) {
  std::string again;
  try {
    again = to_json(answer_from_json(json.dump()));
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    return true;
  }
  CHECK(to_json(answer_from_json(again)) == again);
  return false;
}

std::string refusal(const std::string& text) {
  try {
    answer_from_json(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "it was read";
}

TEST_CASE("every kind of answer is read back as the bytes that it was") {
  for (const Answer& answer : all_kinds()) {
    const std::string text = to_json(answer);
    CHECK(to_json(answer_from_json(text)) == text);
  }
}

TEST_CASE("an answer that was read has what JSON has of it") {
  const Answer read = answer_from_json(to_json(surveyed()));
  CHECK(read.a_to_b.lower == surveyed().a_to_b.lower);
  CHECK(read.max->length.of == Length::Of::kUnit);
  CHECK(verdict_of(read) == Verdict::kBeyond);
  CHECK(in_words(read) == in_words(surveyed()));
  CHECK(read.survey_a->summary->faces == 3);
  CHECK(read.inputs[0].notes == surveyed().inputs[0].notes);
  CHECK(read.a_to_b.witness_a.file_face == 7);
  CHECK(answer_from_json(to_json(gate("0.2mm", 0.2, 0.15))).notes == distance().notes);
}

// A decimal that reads as the same double may lie on either side of it: all digits are compared, as
// texts of numbers with as many digits before the point.
TEST_CASE("the decimals beside hexadecimal ends are rounded outward") {
  const std::regex end(
      "\"([a-z_]*)(lower|upper)\":(0[.][0-9]+),\"[a-z_]*_hex\":\"(0x[0-9a-fp.+-]+)\"");
  size_t inexact = 0;
  for (const Answer& answer : all_kinds()) {
    const std::string json = to_json(answer);
    for (std::sregex_iterator at(json.begin(), json.end(), end), none; at != none; ++at) {
      const std::string written = (*at)[3];
      const std::string exact =
          decimal(std::strtod((*at)[4].str().c_str(), nullptr), 800, Rounding::kDown);
      CAPTURE((*at)[0].str());
      CHECK(((*at)[2] == "lower" ? written <= exact : written >= exact));
      inexact += written != exact ? 1 : 0;
    }
  }
  CHECK(inexact > 10);
}

TEST_CASE("failures are read back") {
  const Failure failure{.code = 4, .message = "a: \"b\"", .file = "a", .place = ""};
  const std::string text = to_json(failure);
  CHECK(to_json(failure_from_json(text)) == text);
  CHECK(refusal(text) == "an error instead of an answer: a: \"b\"");
  CHECK_THROWS_AS(failure_from_json(to_json(distance())), InputError);
  CHECK_THROWS_AS(failure_from_json("[]"), InputError);
}

TEST_CASE("documents of other schemas are refused by name") {
  for (const char* text : {"", "{", "[]", "3", "null"}) CHECK(refusal(text) == "no JSON object");
  CHECK(refusal("{}") == "no schema; expected vkhausdorff.answer/2");
  Json old = Json::parse(to_json(distance()));
  old["schema"] = "vkhausdorff.answer/1";
  CHECK(refusal(old.dump()) == "the schema 'vkhausdorff.answer/1'; expected vkhausdorff.answer/2");
}

TEST_CASE("a bound that was changed is refused, wherever it is") {
  for (const Answer& answer : {both_directions(), surveyed(), proven()}) {
    const Json whole = Json::parse(to_json(answer));
    for_each_value(whole, "", [&](const std::string& at, const Json& value) {
      if (!at.ends_with("_hex") || value == "inf") return;
      Json changed = whole;
      changed[Json::json_pointer(at)] = "0x1.8p+7";
      CAPTURE(at);
      CHECK(refusal(changed.dump()).find("is another number than") != std::string::npos);
      changed[Json::json_pointer(at)] = value;
      changed[Json::json_pointer(at.substr(0, at.size() - 4))] = 17.5;
      CHECK(refusal(changed.dump()).find("is another number than") != std::string::npos);
    });
  }
}

TEST_CASE("what the rest contradicts is refused") {
  const auto refused = [](const Answer& answer, const char* pointer, const Json& value) {
    Json json = Json::parse(to_json(answer));
    json[Json::json_pointer(pointer)] = value;
    return refusal(json.dump());
  };
  const Json wide = {{"lower", 0.25}, {"lower_hex", "0x1p-2"},
                     {"upper", 0.5},  {"upper_hex", "0x1p-1"},
                     {"gap", 0.1},    {"unit", "mm"}};
  CHECK(refused(distance(), "/interval", wide) == "an interval that is not that of its directions");
  CHECK(refused(distance(), "/interval/gap", 0.5) == "a gap that is not that of its interval");
  CHECK(refused(both_directions(), "/directions/1/interval/gap", 0.5) ==
        "a gap that is not that of its interval");
  CHECK(refused(distance(), "/status", "time") == "a status that is not that of its directions");
  CHECK(refused(distance(), "/verdict", "pass") ==
        "a verdict without a limit, or a limit without one");
  CHECK(refused(gate("0.05mm", 0.05, 0.15), "/verdict", "pass") ==
        "a verdict that is not that of its bounds");
  CHECK(refused(distance(), "/options/symmetric", true) == "symmetric contradicts the directions");
  CHECK(refused(surveyed(), "/directions/0/survey/met", true) == "met contradicts ended");
  CHECK(refused(distance(), "/tolerance/requested", "much") == "requested 'much' is no length");
  CHECK(refused(distance(), "/tolerance/requested", "1mm") ==
        "requested '1mm' and diagonal_of contradict each other");
  CHECK(refused(distance(), "/directions/0/status", "happy") == "status 'happy'");
}

TEST_CASE("a stranger in place of any value is refused, or read as another answer") {
#ifdef VKH_SANITIZED  // a minute otherwise
  const std::vector<Json> strangers = {nullptr, -1, Json::array()};
#else
  const std::vector<Json> strangers = {nullptr,       true,           -1,   1.5, "x", "", 3,
                                       Json::array(), Json::object(), 1e300};
#endif
  for (const Answer& answer : all_kinds()) {
    const Json whole = Json::parse(to_json(answer));
    for_each_value(whole, "", [&](const std::string& at, const Json&) {
      for (const Json& stranger : strangers) {
        Json changed = whole;
        changed[Json::json_pointer(at)] = stranger;
        (void)is_refused(changed);
      }
    });
  }
}

TEST_CASE("a member that is missing is refused, unless it may be or says nothing new") {
  const std::set<std::string> dispensable = {
      "name",      "stop_reason", "to",    "code",         "text",        "value",
      "unit",                               // says nothing new
      "file",      "face",        "notes",  // or is of a note
      "part",      "parts",       "boxes", "more_devices", "barycentric", "certificate",
      "coverage",  "faces_a",     "field", "verified",     "exact",       "u1",
      "transform", "estimate",    "jump",  "inside_out",   "worst"};
  for (const Answer& answer : all_kinds()) {
    const Json whole = Json::parse(to_json(answer));
    for_each_value(whole, "", [&](const std::string& at, const Json&) {
      const Json::json_pointer pointer(at);
      Json without = whole;
      if (!without[pointer.parent_pointer()].is_object()) return;
      without[pointer.parent_pointer()].erase(pointer.back());
      if (is_refused(without) || dispensable.contains(pointer.back())) return;
      CAPTURE(at);
      CHECK(false);
    });
  }
}

}  // namespace
