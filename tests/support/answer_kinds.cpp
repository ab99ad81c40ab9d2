#include "tests/support/answer_kinds.h"

#include <limits>
#include <string>

#include "host/answer/json_object.h"
#include "host/answer/merge_parts.h"

namespace vkh::test {
namespace {

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

}  // namespace

Answer distance_answer() {
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
  Answer answer = distance_answer();
  answer.b_to_a = report(0.2, 0.2 + 0x1p-7);
  answer.b_to_a->diagonal_a = 3;  // of B's box
  return answer;
}

Answer gate_answer(const char* limit, double within, double upper) {
  Answer answer = distance_answer();
  answer.command = "gate";
  answer.a_to_b.upper = upper;
  answer.max = Asked{.length = parse_length("max", limit, PlainNumber::kFraction),
                     .limit = {within, within}};
  return answer;
}

Answer by_face() {
  Answer answer = gate_answer("0.05mm", 0.05, 0.2);
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

namespace {

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

}  // namespace

Answer surveyed() {
  Answer answer = gate_answer("0.1mm", 0.1, 0.2);
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

namespace {

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
  Answer answer = gate_answer("0.2mm", 0.2, 0.15);
  answer.max->sides = AskedSides{parse_length("max", "0.2mm", PlainNumber::kRefused),
                                 parse_length("max", "0.1mm", PlainNumber::kRefused),
                                 {{0.2, 0.2}, {0.1, 0.1}}};
  answer.survey_a.emplace();
  answer.survey_a->ended = SurveyEnd::kMet;
  answer.survey_a->sides = sides();
  return answer;
}

}  // namespace

Answer proven() {
  Answer answer = distance_answer();
  answer.proof_a = Proof{.upper = 0.2, .blocks = "leaves", .bytes = 6, .leaves = 3, .ms = 0.3};
  answer.a_to_b.witness_check = WitnessCheck{0.1, 0.11, true};
  answer.a_to_b.coverage_check = CoverageCheck{.whole = 2, .closed = 0.9, .holds = true};
  return answer;
}

namespace {

Answer on_devices() {
  Answer answer = distance_answer();
  answer.a_to_b.more_devices = {device_named("another"), device_named("a third")};
  return answer;
}

Answer part() {
  Answer answer = distance_answer();
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
  Answer answer = distance_answer();
  MeshTransform by{.numerator = 127, .denominator = 5};
  by.matrix = MatrixRows{{{0.1, -1, 0, 1.5}, {1, 0.1, -0.0, 1e-300}, {0, 0, 1, 3}}};
  answer.placed =
      PlacedInput{.by = by, .from = "in", .file = "m.txt", .sha256 = std::string(64, 'd')};
  return answer;
}

}  // namespace

std::vector<Answer> all_kinds_of_answers() {
  return {distance_answer(),
          placed(),
          both_directions(),
          gate_answer("0.2mm", 0.2, 0.15),
          gate_answer("0.05mm", 0.05, 0.15),
          gate_answer("0.12mm", 0.12, 0.15),
          by_face(),
          surveyed(),
          on_sides(),
          proven(),
          on_devices(),
          part(),
          merged(),
          unread()};
}

}  // namespace vkh::test
