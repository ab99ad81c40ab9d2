// Reads an answer from its JSON. Members that others imply are not taken but must agree with those,
// so that no line that a user changed passes for an answer.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "host/answer/json_object.h"
#include "host/base/float_environment.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

constexpr std::array kEveryStatus{Status::kClosed, Status::kPrecision, Status::kTime,
                                  Status::kWaves,  Status::kMemory,    Status::kCancelled,
                                  Status::kPruned, Status::kLimit};
constexpr std::array kEveryVerdict{Verdict::kWithin, Verdict::kBeyond, Verdict::kUndecided};
constexpr std::array kEverySurveyEnd{SurveyEnd::kMet,  SurveyEnd::kBits,      SurveyEnd::kEffort,
                                     SurveyEnd::kTime, SurveyEnd::kCancelled, SurveyEnd::kMemory};

constexpr std::array kEveryInside{Inside::kProven, Inside::kOpen, Inside::kCrossing,
                                  Inside::kWinding, Inside::kUndecided};
constexpr std::array kInsideOuts{InsideOut::kPart, InsideOut::kAll};

const Json& member_at(const Json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (found == object.end()) throw InputError(std::string("no ") + key);
  return *found;
}

[[noreturn]] void refuse_member(const char* key, const char* expected) {
  throw InputError(std::string(key) + " is no " + expected);
}

std::string text_at(const Json& object, const char* key) {
  const Json& value = member_at(object, key);
  if (!value.is_string()) refuse_member(key, "text");
  return value.get<std::string>();
}

std::string text_or_empty_at(const Json& object, const char* key) {
  return member_at(object, key).is_null() ? std::string() : text_at(object, key);
}

double number_at(const Json& object, const char* key) {
  const Json& value = member_at(object, key);
  if (!value.is_number()) refuse_member(key, "number");
  return value.get<double>();
}

// JSON has no infinity: the writer makes it null.
double number_or_infinity_at(const Json& object, const char* key) {
  if (member_at(object, key).is_null()) return std::numeric_limits<double>::infinity();
  return number_at(object, key);
}

// A length that waits for the meshes to be read is null.
double number_or_zero_at(const Json& object, const char* key) {
  return member_at(object, key).is_null() ? 0 : number_at(object, key);
}

bool truth_at(const Json& object, const char* key) {
  const Json& value = member_at(object, key);
  if (!value.is_boolean()) refuse_member(key, "truth value");
  return value.get<bool>();
}

uint32_t small_count_at(const Json& object, const char* key) {
  const uint64_t count = count_in(object, key);
  if (count > UINT32_MAX) refuse_member(key, "number under 2^32");
  return static_cast<uint32_t>(count);
}

const Json& array_at(const Json& object, const char* key) {
  const Json& value = member_at(object, key);
  if (!value.is_array()) refuse_member(key, "array");
  return value;
}

std::vector<std::string> texts_at(const Json& object, const char* key) {
  std::vector<std::string> texts;
  for (const Json& value : array_at(object, key)) {
    if (!value.is_string()) refuse_member(key, "array of texts");
    texts.push_back(value.get<std::string>());
  }
  return texts;
}

DVec3 vector_at(const Json& object, const char* key) {
  const Json& values = array_at(object, key);
  const bool is_vector =
      values.size() == 3 &&
      std::all_of(values.begin(), values.end(), [](const Json& v) { return v.is_number(); });
  if (!is_vector) refuse_member(key, "array of three numbers");
  return {values[0].get<double>(), values[1].get<double>(), values[2].get<double>()};
}

template <class Enum, size_t kCount>
Enum enumerator_at(const Json& object, const char* key, const std::array<Enum, kCount>& all,
                   const char* (*name_of)(Enum)) {
  const std::string name = text_at(object, key);
  const auto found =
      std::find_if(all.begin(), all.end(), [&](Enum one) { return name == name_of(one); });
  if (found == all.end()) throw InputError(std::string(key) + " '" + name + "'");
  return *found;
}

Status status_at(const Json& object) {
  return enumerator_at(object, "status", kEveryStatus, status_name);
}
Verdict verdict_at(const Json& object) {
  return enumerator_at(object, "verdict", kEveryVerdict, verdict_name);
}

// Reads the estimate, which lies within the interval.
Enclosure with_estimate(const Json& json, Enclosure e) {
  if (!json.contains("estimate")) return e;
  e.estimate = number_at(json, "estimate");
  if (!(*e.estimate >= e.lower && *e.estimate <= e.upper))
    throw InputError("an estimate that is not in its interval");
  return e;
}

Enclosure enclosure_of(const Json& json) {
  const Enclosure e{bound_in(json, "lower"), bound_in(json, "upper")};
  if (e.lower > e.upper || std::isinf(e.lower))
    throw InputError("an interval whose lower end is above its upper");
  return with_estimate(json, e);
}

bool is_jump(const Json& json) { return json.contains("jump") && truth_at(json, "jump"); }

Box box_at(const Json& boxes, const char* key) {
  const Json& box = member_at(boxes, key);
  return {vector_at(box, "min"), vector_at(box, "max")};
}

// The text is what was typed; the number in it is not written apart.
Length length_of(const Json& json) {
  const std::string text = text_at(json, "requested");
  const bool is_share = !member_at(json, "diagonal_of").is_null();
  Length length{.requested = text, .of = is_share ? Length::Of::kDiagonal : Length::Of::kFiles};
  if (text.empty()) return length;
  try {
    length = parse_length("requested", text, PlainNumber::kFraction);
  } catch (const UsageError&) {
    throw InputError("requested '" + text + "' is no length");
  }
  if ((length.of == Length::Of::kDiagonal) != is_share)
    throw InputError("requested '" + text + "' and diagonal_of contradict each other");
  return length;
}

std::vector<FileHash> files_beneath_of(const Json& input) {
  std::vector<FileHash> files;
  if (!input.is_object() || !input.contains("files"))
    throw InputError(
        "no word on files that were read besides A and B, as answers have since 0.2.0");
  if (input.at("files").is_null()) return files;
  for (const Json& file : array_at(input, "files"))
    files.push_back({text_at(file, "path"), text_or_empty_at(file, "sha256")});
  return files;
}

Input input_of(const Json& json) {
  Input input{.path = text_at(json, "path")};
  input.sha256 = text_or_empty_at(json, "sha256");
  input.files = files_beneath_of(json);
  input.is_read = !member_at(json, "faces").is_null();
  if (json.contains("points")) input.are_points = truth_at(json, "points");
  MeshCounts& counts = input.counts;
  for (const auto& [key, count] : {std::pair{"vertices", &counts.vertices},
                                   {"faces", &counts.faces},
                                   {"unreferenced", &counts.unreferenced},
                                   {"degenerate", &counts.degenerate},
                                   {"duplicate", &counts.duplicate},
                                   {"polygons", &counts.polygons}}) {
    if (input.is_read) *count = count_in(json, key);
    if (!input.is_read && !member_at(json, key).is_null())
      throw InputError(std::string(key) + " of a mesh that was not read");
  }
  input.place = {.delta = number_at(json, "delta"), .unit = text_or_empty_at(json, "unit")};
  input.notes = notes_in(json);
  for (Note& note : input.notes) {
    if (note.file == input.path) note.file.clear();
  }
  return input;
}

DeviceDescription device_of(const Json& json) {
  DeviceDescription device;
  if (json.is_null()) return device;
  device.index = small_count_at(json, "index");
  device.name = text_at(json, "name");
  device.type = text_at(json, "type");
  device.api_version = text_at(json, "api_version");
  device.memory_bytes = count_in(json, "memory_bytes");
  return device;
}

SurfacePoint point_of(const Json& json) {
  SurfacePoint point;
  point.face = point.file_face = count_in(json, "face");
  if (json.contains("barycentric")) point.barycentric = vector_at(json, "barycentric");
  point.point = vector_at(json, "point");
  return point;
}

void read_verified(const Json& json, Report& r) {
  r.witness_check = WitnessCheck{.distance_lower = bound_in(json, "distance_lower"),
                                 .distance_upper = bound_in(json, "distance_upper"),
                                 .holds = truth_at(json, "witness")};
  if (!json.contains("coverage")) return;
  const Json& faces = member_at(json, "faces");
  r.coverage_check = CoverageCheck{.whole = count_in(faces, "whole"),
                                   .waiting = count_in(faces, "waiting"),
                                   .wrong = count_in(faces, "wrong"),
                                   .closed = number_at(json, "closed"),
                                   .holds = truth_at(json, "coverage")};
}

void read_work(const Json& json, Report& r) {
  const Json& counts = member_at(json, "counts");
  r.waves = small_count_at(counts, "waves");
  r.candidates = count_in(counts, "candidates");
  r.queries = count_in(counts, "queries");
  r.peak_frontier = count_in(counts, "peak_frontier");
  r.workspace_bytes = count_in(counts, "workspace_bytes");
  const Json& times = member_at(json, "times");
  r.times = {.upload_ms = number_at(times, "upload_ms"),
             .hierarchy_ms = number_at(times, "hierarchy_ms"),
             .solve_ms = number_at(times, "solve_ms"),
             .wall_ms = number_at(times, "wall_ms")};
  for (const Json& stage : array_at(json, "stages"))
    r.stages.push_back({.name = text_at(stage, "name"),
                        .gpu_ms = number_at(stage, "gpu_ms"),
                        .times = count_in(stage, "times")});
  const Json& culled = member_at(json, "culled");
  if (!culled.is_object()) refuse_member("culled", "object");
  for (const auto& [name, count] : culled.items()) {
    (void)count;
    r.culled.push_back({name, count_in(culled, name)});
  }
}

void read_waves(const Json& json, Report& r) {
  for (const Json& wave : array_at(json, "wave_stats"))
    r.wave_stats.push_back({.wave = small_count_at(wave, "wave"),
                            .parents = count_in(wave, "parents"),
                            .candidates = count_in(wave, "candidates"),
                            .queries = count_in(wave, "queries"),
                            .survivors = count_in(wave, "survivors"),
                            .deferred = count_in(wave, "deferred"),
                            .lower = number_or_infinity_at(wave, "lower"),
                            .upper = number_or_infinity_at(wave, "upper")});
}

/// Reads a direction, but for its diagonal and tolerance.
Report report_at(const Json& json) {
  Report r;
  const Enclosure interval = enclosure_of(member_at(json, "interval"));
  r.lower = interval.lower;
  r.upper = interval.upper;
  r.status = status_at(json);
  r.known_lower = number_at(json, "known_lower");
  const Json& witness = member_at(json, "witness");
  r.has_witness = !witness.is_null();
  if (r.has_witness) {
    r.witness_a = point_of(member_at(witness, "from"));
    r.witness_b = point_of(member_at(witness, "to"));
  }
  if (json.contains("verified")) read_verified(json.at("verified"), r);
  read_work(json, r);
  read_waves(json, r);
  return r;
}

std::vector<AreaWithin> shares_at(const Json& json, const char* key) {
  std::vector<AreaWithin> shares;
  for (const Json& one : array_at(json, key))
    shares.push_back({number_or_infinity_at(one, "distance"), enclosure_of(member_at(one, "share")),
                      is_jump(one)});
  return shares;
}

Statistics statistics_of(const Json& json) {
  Statistics s;
  s.area = number_or_infinity_at(json, "area");
  if (json.contains("points")) s.points = count_in(json, "points");
  if (json.contains("kept")) {
    s.max_distance = number_at(json, "max_distance");
    s.kept = enclosure_of(json.at("kept"));
  }
  s.mean = enclosure_of(member_at(json, "mean"));
  s.rms = enclosure_of(member_at(json, "rms"));
  s.bands = shares_at(json, "bands");
  for (const Json& one : array_at(json, "percentiles"))
    s.percentiles.push_back(
        {number_at(one, "share"), enclosure_of(member_at(one, "distance")), is_jump(one)});
  s.curve = shares_at(json, "curve");
  return s;
}

// Its ends may be negative.
Enclosure signed_enclosure_of(const Json& json) {
  const Enclosure e{signed_bound_in(json, "lower"), signed_bound_in(json, "upper")};
  if (e.lower > e.upper) throw InputError("an interval whose lower end is above its upper");
  return with_estimate(json, e);
}

std::optional<SidedPoint> sided_point_at(const Json& object, const char* key) {
  const Json& json = member_at(object, key);
  if (json.is_null()) return std::nullopt;
  return SidedPoint{point_of(json), bound_in(json, "lower")};
}

SignedFigures::Areas side_areas_of(const Json& json) {
  SignedFigures::Areas areas;
  areas.over = enclosure_of(member_at(json, "over"));
  areas.under = enclosure_of(member_at(json, "under"));
  const Json& doubts = member_at(json, "unsigned");
  for (size_t k = 1; k < kDoubts; ++k)
    areas.doubts[k] = enclosure_of(member_at(doubts, doubt_name(static_cast<Doubt>(k))));
  return areas;
}

SignedFigures signed_of(const Json& json) {
  SignedFigures s;
  s.over = enclosure_of(member_at(json, "over"));
  s.under = enclosure_of(member_at(json, "under"));
  s.over_witness = sided_point_at(json, "over_witness");
  s.under_witness = sided_point_at(json, "under_witness");
  s.inside = enumerator_at(json, "inside", kEveryInside, inside_name);
  if (json.contains("inside_out"))
    s.inside_out = enumerator_at(json, "inside_out", kInsideOuts, inside_out_name);
  const Json& edges = member_at(json, "edges");
  s.edges.open = count_in(edges, "open");
  s.edges.uneven = count_in(edges, "uneven");
  if (!member_at(json, "areas").is_null()) s.areas = side_areas_of(json.at("areas"));
  if (!member_at(json, "mean").is_null()) s.mean = signed_enclosure_of(json.at("mean"));
  for (const Json& one : array_at(json, "percentiles"))
    s.percentiles.push_back(
        {number_at(one, "share"), signed_enclosure_of(member_at(one, "distance")), is_jump(one)});
  s.ms = number_at(json, "wall_ms");
  return s;
}

FieldSummary field_of(const Json& json, bool has_limit) {
  FieldSummary summary;
  summary.faces = count_in(json, "faces");
  summary.width = number_or_infinity_at(json, "width");
  if (!has_limit) return summary;
  summary.within = count_in(json, "within");
  summary.beyond = count_in(json, "beyond");
  summary.undecided = count_in(json, "undecided");
  return summary;
}

MapShares map_shares_of(const Json& json) {
  MapShares shares;
  shares.bar.low = number_at(json, "low");
  shares.bar.high = number_at(json, "high");
  shares.has_sides = truth_at(json, "signed");
  if (json.contains("limit")) shares.bar.limit = number_at(json, "limit");
  if (json.contains("limit_under")) shares.bar.limit_under = number_at(json, "limit_under");
  shares.above = number_at(json, "above");
  shares.below = number_at(json, "below");
  shares.no_side = number_at(json, "no_side");
  shares.left_out = number_at(json, "left_out");
  shares.unresolved = number_at(json, "unresolved");
  shares.within = number_at(json, "within");
  shares.mean = number_at(json, "mean");
  return shares;
}

std::optional<SurveyResult> survey_at(const Json& direction, bool has_limit) {
  if (!direction.contains("survey")) return std::nullopt;
  const Json& json = direction.at("survey");
  SurveyResult result;
  result.ended = enumerator_at(json, "ended", kEverySurveyEnd, survey_end_name);
  result.effort = count_in(json, "effort");
  result.cells = count_in(json, "cells");
  result.bounded = count_in(json, "bounded");
  result.ms = number_at(json, "wall_ms");
  if (truth_at(json, "met") != result.is_met()) throw InputError("met contradicts ended");
  result.faces = direction.contains("field");
  if (result.faces) result.summary = field_of(direction.at("field"), has_limit);
  if (direction.contains("statistics"))
    result.statistics = statistics_of(direction.at("statistics"));
  if (direction.contains("signed")) result.sides = signed_of(direction.at("signed"));
  if (direction.contains("map")) result.shares = map_shares_of(direction.at("map"));
  return result;
}

std::optional<Proof> proof_at(const Json& direction) {
  if (!direction.contains("certificate")) return std::nullopt;
  const Json& json = direction.at("certificate");
  Proof proof;
  proof.upper = bound_in(json, "upper");
  proof.leaves = count_in(json, "leaves");
  proof.cut_leaves = count_in(json, "cut_leaves");
  proof.unproven = count_in(json, "unproven");
  proof.asked_cells = count_in(json, "cells");
  proof.bytes = count_in(json, "bytes");
  proof.ms = number_at(json, "wall_ms");
  return proof;
}

std::optional<FaceLimits> face_limits_at(const Json& max, const char* key) {
  if (!max.contains(key)) return std::nullopt;
  const Json& json = max.at(key);
  return FaceLimits{.path = text_at(json, "path"),
                    .sha256 = text_or_empty_at(json, "sha256"),
                    .within = count_in(json, "within"),
                    .faces = count_in(json, "faces"),
                    .runs = count_in(json, "runs"),
                    .verdict = verdict_at(json)};
}

AskedSides asked_sides_of(const Json& json) {
  const Json &over = member_at(json, "over"), &under = member_at(json, "under");
  return {length_of(over),
          length_of(under),
          {{number_or_zero_at(over, "within"), number_or_zero_at(over, "beyond")},
           {number_or_zero_at(under, "within"), number_or_zero_at(under, "beyond")}}};
}

Asked asked_of(const Json& json) {
  Asked max{.length = length_of(json),
            .limit = {number_or_zero_at(json, "within"), number_or_zero_at(json, "beyond")},
            .faces_a = face_limits_at(json, "faces_a"),
            .faces_b = face_limits_at(json, "faces_b")};
  if (json.contains("area")) max.area = number_at(json, "area");
  if (json.contains("sides")) max.sides = asked_sides_of(json.at("sides"));
  if (json.contains("worst")) max.worst = truth_at(json, "worst");
  return max;
}

void read_question(const Json& json, Answer& answer) {
  answer.command = text_at(json, "command");
  answer.words = texts_at(json, "arguments");
  answer.started = text_at(json, "started");
  answer.host = text_at(json, "host");
  answer.version = text_at(json, "version");
  answer.first_line = text_at(json, "words");
  const Json& tolerance = member_at(json, "tolerance");
  answer.tolerance = length_of(tolerance);
  answer.unit = text_or_empty_at(tolerance, "unit");
  if (json.contains("max")) answer.max = asked_of(json.at("max"));
  if (json.contains("parts")) answer.parts = count_in(json, "parts");
  if (json.contains("part"))
    answer.part = PartOf{count_in(json.at("part"), "index"), count_in(json.at("part"), "count")};
}

MatrixRows matrix_of(const Json& json) {
  MatrixRows rows;
  if (json.size() != 4) refuse_member("matrix", "array of four rows");
  for (size_t i = 0; i < rows.size(); ++i) {
    if (!json[i].is_array() || json[i].size() != 4) refuse_member("matrix", "array of four rows");
    for (size_t j = 0; j < 4; ++j) {
      if (!json[i][j].is_number()) refuse_member("matrix", "array of rows of numbers");
      rows[i][j] = json[i][j].get<double>();
    }
  }
  if (json[3] != Json::array({0.0, 0.0, 0.0, 1.0})) refuse_member("matrix", "map of points");
  return rows;
}

/// The notes of the answer tell the rest.
FoundFit fit_of(const Json& json) {
  if (!truth_at(json, "found")) throw InputError("a transform with found false");
  return {.rms = number_at(json, "rms"),
          .share = number_at(json, "share"),
          .samples = count_in(json, "samples")};
}

PlacedInput placed_of(const Json& json, const std::string& unit) {
  PlacedInput placed{.by = {},
                     .from = text_or_empty_at(json, "from_unit"),
                     .file = text_or_empty_at(json, "path"),
                     .sha256 = text_or_empty_at(json, "sha256")};
  if (text_or_empty_at(json, "unit") != unit) throw InputError("units that contradict each other");
  const Json& factor = array_at(json, "factor");
  if (factor.size() != 2 || !factor[0].is_number() || !factor[1].is_number())
    refuse_member("factor", "array of two numbers");
  placed.by.numerator = factor[0].get<double>();
  placed.by.denominator = factor[1].get<double>();
  if (!member_at(json, "matrix").is_null()) placed.by.matrix = matrix_of(array_at(json, "matrix"));
  if (json.contains("found")) placed.fit = fit_of(json);
  return placed;
}

void read_meshes(const Json& json, Answer& answer) {
  const Json& inputs = array_at(json, "inputs");
  if (inputs.size() != 2) throw InputError("inputs are not two");
  for (size_t i = 0; i < 2; ++i) answer.inputs[i] = input_of(inputs[i]);
  answer.notes = notes_in(json);
  if (json.contains("transform")) answer.placed = placed_of(json.at("transform"), answer.unit);
  if (!json.contains("boxes")) return;
  answer.inputs[0].box = box_at(json.at("boxes"), "a");
  answer.inputs[1].box = box_at(json.at("boxes"), "b");
}

/// The diagonal by which the gap of B's direction is what it is: B's, or A's if it was not run.
double diagonal_of_back(const Json& direction, const Answer& answer) {
  const double gap = number_or_infinity_at(direction.at("interval"), "gap");
  const std::optional<Box>& box = answer.inputs[1].box;
  const Report& back = *answer.b_to_a;
  const double from_b = box ? diagonal(*box) : answer.a_to_b.diagonal_a;
  return gap_of(back.lower, back.upper, from_b) == gap ? from_b : answer.a_to_b.diagonal_a;
}

void read_directions(const Json& json, Answer& answer) {
  const Json& directions = array_at(json, "directions");
  if (directions.empty() || directions.size() > 2)
    throw InputError("directions are not one or two");
  for (const Json& direction : directions) {
    const bool back = &direction != &directions[0];
    if (text_at(direction, "from") != (back ? "b" : "a"))
      throw InputError("directions are not A's and B's");
    if (back) answer.b_to_a.emplace();
    Report& r = back ? *answer.b_to_a : answer.a_to_b;
    r = report_at(direction);
    (back ? answer.survey_b : answer.survey_a) = survey_at(direction, answer.max.has_value());
    (back ? answer.proof_b : answer.proof_a) = proof_at(direction);
    r.tolerance = number_or_zero_at(member_at(json, "tolerance"), "absolute");
    r.diagonal_a = number_or_zero_at(json.at("tolerance"), "diagonal");
    if (back) r.diagonal_a = diagonal_of_back(direction, answer);
  }
}

void read_run(const Json& json, Answer& answer) {
  Report& r = answer.a_to_b;
  const Json& options = member_at(json, "options");
  if (truth_at(options, "symmetric") != answer.b_to_a.has_value())
    throw InputError("symmetric contradicts the directions");
  r.preset = text_at(options, "preset");
  r.switched_on = texts_at(options, "switched_on");
  r.switched_off = texts_at(options, "switched_off");
  r.device = device_of(member_at(json, "device"));
  r.device.driver = text_or_empty_at(json, "driver");
  if (json.contains("more_devices")) {
    for (const Json& device : array_at(json, "more_devices"))
      r.more_devices.push_back(device_of(device));
  }
  const Json& times = member_at(json, "times");
  answer.waits = {.read = number_at(times, "read_ms"),
                  .start = number_at(times, "start_ms"),
                  .total = number_at(times, "total_ms")};
}

void check_interval(const Json& json, const CertifiedInterval& implied) {
  const Json& interval = member_at(json, "interval");
  const Enclosure whole = enclosure_of(interval);
  if (whole.lower != implied.lower || whole.upper != implied.upper)
    throw InputError("an interval that is not that of its directions");
  if (number_or_infinity_at(interval, "gap") != implied.gap)
    throw InputError("a gap that is not that of its interval");
  if (status_at(json) != implied.status)
    throw InputError("a status that is not that of its directions");
}

/// Metrics that are known have the answer's interval as their first figure.
void check_metrics(const Answer& answer) {
  if (!answer.metrics) return;
  const Enclosure& whole = answer.metrics->hausdorff.value;
  const CertifiedInterval implied = interval_of(answer);
  const bool is_known = std::isfinite(whole.upper);
  if (is_known && (whole.lower != implied.lower || whole.upper != implied.upper))
    throw InputError("metrics: hausdorff is not the answer's interval");
}

/// Compares what the answer implies with what is written.
void check_implied(const Json& json, Answer& answer) {
  for (const Report* r : {&answer.a_to_b, answer.b_to_a ? &*answer.b_to_a : nullptr}) {
    if (r == nullptr) continue;
    const Json& direction = json.at("directions").at(r == &answer.a_to_b ? 0 : 1);
    check_interval(direction, {r->lower, r->upper, r->gap(), r->status});
  }
  check_interval(json, interval_of(answer));
  check_metrics(answer);
  if (json.contains("verdict") != answer.max.has_value())
    throw InputError("a verdict without a limit, or a limit without one");
  if (answer.max && verdict_at(json) != verdict_of(answer))
    throw InputError("a verdict that is not that of its bounds");
}

/// Takes out the note that notes_of() adds.
void drop_implied_notes(Answer& answer) {
  std::erase_if(answer.notes, [](const Note& note) { return note.code == NoteCode::kOneWay; });
}

void check_schema(const Json& json) {
  if (!json.is_object()) throw InputError("no JSON object");
  const auto found = json.find("schema");
  if (found == json.end() || !found->is_string() || *found != kAnswerSchema)
    throw InputError({.problem = found != json.end() && found->is_string()
                                     ? "the schema '" + found->get<std::string>() + "'"
                                     : "no schema",
                      .expected = kAnswerSchema});
}

}  // namespace

Answer answer_from(const Json& json) {
  const FloatEnvironment ours;
  check_schema(json);
  if (json.contains("error"))
    throw InputError("an error instead of an answer: " + text_at(json.at("error"), "message"));
  check_bounds(json);
  Answer answer;
  read_question(json, answer);
  read_meshes(json, answer);
  read_directions(json, answer);
  if (json.contains("metrics")) answer.metrics = metrics_from(json.at("metrics"));
  read_run(json, answer);
  check_implied(json, answer);
  drop_implied_notes(answer);
  return answer;
}

Answer answer_from_json(std::string_view text) {
  return answer_from(Json::parse(text, nullptr, false));
}

Failure failure_from_json(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  check_schema(json);
  const Json& error = member_at(json, "error");
  const uint64_t code = count_in(error, "code");
  if (code > kExitInternal) throw InputError("code " + std::to_string(code));
  return {.code = static_cast<int>(code),
          .message = text_at(error, "message"),
          .file = text_or_empty_at(error, "file"),
          .place = text_or_empty_at(error, "place")};
}

}  // namespace vkh
