#include "host/answer/record.h"

#include <algorithm>
#include <cmath>

#include "host/answer/json_object.h"
#include "host/base/rounding.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

constexpr const char* kPairSchema = "vkhausdorff.pair/2";
constexpr const char* kRun = ",\"run\":{";

void begin(JsonObject& json, const RecordName& name, ExitCode code) {
  json.add("schema", kPairSchema);
  json.add("version", program_version());
  json.add("id", name.id);
  json.add("key", name.key);
  json.add("code", static_cast<int>(code));
}

double gpu_ms(const Answer& answer) {
  double sum = 0;
  for (const Report* r : {&answer.a_to_b, answer.b_to_a ? &*answer.b_to_a : nullptr}) {
    if (r != nullptr) sum += r->times.hierarchy_ms + r->times.solve_ms;
  }
  return sum;
}

void add_run(JsonObject& json, const Answer& answer) {
  JsonObject run;
  add_device(run, answer);
  run.add("times", {{"read_ms", answer.waits.read},
                    {"gpu_ms", gpu_ms(answer)},
                    {"total_ms", answer.waits.total}});
  run.add("host", answer.host);
  run.add("started", answer.started);
  json.add_text("run", run.text());
}

Json name_and_hash(const char* name, const Input& input) {
  Json json = {{"name", name}, {"path", input.path}};
  add_hashes(json, input);
  return json;
}

// Treats members that are missing, or null, as unknown.
const Json& member(const Json& json, const char* key) {
  static const Json null;
  const auto found = json.is_object() ? json.find(key) : json.end();
  return found == json.end() ? null : *found;
}
std::string text_in(const Json& json, const char* key) {
  const Json& value = member(json, key);
  return value.is_string() ? value.get<std::string>() : std::string();
}
double number_in(const Json& json, const char* key, double otherwise) {
  const Json& value = member(json, key);
  return value.is_number() ? value.get<double>() : otherwise;
}

Bounds bounds_in(const Json& interval) {
  const Bounds bounds{bound_in(interval, "lower"), bound_in(interval, "upper")};
  if (!(bounds.lower <= bounds.upper) || std::isinf(bounds.lower))
    throw InputError("an interval whose lower end is above its upper");
  return bounds;
}

Record::Side side_of(const Json& input) {
  return {.path = text_in(input, "path"),
          .sha256 = text_in(input, "sha256"),
          .faces = member(input, "faces").is_null() ? 0 : count_in(input, "faces"),
          .names_files = input.is_object() && input.contains("files"),
          .notes = notes_in(input)};
}

Enclosure enclosure_in(const Json& json) {
  return {signed_bound_in(json, "lower"), signed_bound_in(json, "upper")};
}

double unsigned_share(const Enclosure& over, const Enclosure& under) {
  return std::max(add_up(add_up(1, -over.lower), -under.lower), 0.0);
}

std::optional<Record::Signed> signed_in(const Json& direction) {
  const Json& json = member(direction, "signed");
  if (!json.is_object()) return std::nullopt;
  Record::Signed sides{.over = enclosure_in(member(json, "over")),
                       .under = enclosure_in(member(json, "under"))};
  if (member(json, "mean").is_object()) sides.mean = enclosure_in(json["mean"]);
  const Json& percentiles = member(json, "percentiles");
  for (size_t i = 0; percentiles.is_array() && i < percentiles.size(); ++i)
    sides.percentiles.push_back(
        {number_in(percentiles[i], "share", 0), enclosure_in(member(percentiles[i], "distance"))});
  const Json& areas = member(json, "areas");
  if (areas.is_object())
    sides.unsigned_share =
        unsigned_share(enclosure_in(member(areas, "over")), enclosure_in(member(areas, "under")));
  return sides;
}

void read_answer(const Json& json, Record& record) {
  const Json& interval = member(json, "interval");
  check_bounds(json);
  const Bounds whole = bounds_in(interval);
  const Json& directions = member(json, "directions");
  for (size_t i = 0; directions.is_array() && i < std::min<size_t>(directions.size(), 2); ++i)
    record.directions[i] = bounds_in(member(directions[i], "interval"));
  if (directions.is_array() && !directions.empty()) record.sides = signed_in(directions[0]);
  if (member(json, "metrics").is_object()) record.metrics = metrics_from(json.at("metrics"));
  record.status = text_in(json, "status");
  record.verdict = text_in(json, "verdict");
  record.lower = whole.lower;
  record.upper = whole.upper;
  record.gap = number_in(interval, "gap", 0);
  record.unit = text_in(interval, "unit");
  const Json& max = member(json, "max");
  record.limit = {number_in(max, "within", 0), number_in(max, "beyond", 0)};
  record.is_by_area = member(max, "area").is_number();
  record.diagonal = number_in(member(json, "tolerance"), "diagonal", 0);
  record.words = text_in(json, "words");
  record.notes = notes_in(json);
}

}  // namespace

std::string to_record(const RecordName& name, const Answer& answer) {
  JsonObject json;
  begin(json, name, code_of(answer));
  add_answer(json, answer, Detail::kBrief);
  add_run(json, answer);
  return json.text();
}

std::string to_record(const RecordName& name, const Failure& failure, const Answer& known) {
  JsonObject json;
  begin(json, name, static_cast<ExitCode>(failure.code));
  json.add("error", {{"code", failure.code},
                     {"message", failure.message},
                     {"file", text_or_null(failure.file)},
                     {"place", text_or_null(failure.place)}});
  json.add("inputs",
           Json::array({name_and_hash("a", known.inputs[0]), name_and_hash("b", known.inputs[1])}));
  add_run(json, known);
  return json.text();
}

namespace {

Record begun(const RecordName& name, ExitCode code, const Answer& answer) {
  Record record;
  record.name = name;
  record.code = code;
  for (size_t i = 0; i < 2; ++i) {
    record.inputs[i].path = answer.inputs[i].path;
    record.inputs[i].sha256 = answer.inputs[i].sha256;
    record.inputs[i].names_files = true;
  }
  record.total_ms = answer.waits.total;
  record.gpu_ms = gpu_ms(answer);
  record.host = answer.host;
  record.started = answer.started;
  return record;
}

std::optional<Record::Signed> signed_of(const Answer& answer) {
  const SignedFigures* found = sides_of(answer, false);
  if (found == nullptr) return std::nullopt;
  Record::Signed sides{.over = found->over,
                       .under = found->under,
                       .mean = found->mean,
                       .percentiles = found->percentiles};
  if (found->areas) sides.unsigned_share = unsigned_share(found->areas->over, found->areas->under);
  return sides;
}

Record::Side with_mesh(Record::Side side, const Input& input) {
  side.faces = input.is_read ? input.counts.faces : 0;
  side.notes = input.notes;
  for (Note& note : side.notes) {
    if (note.file.empty()) note.file = input.path;
  }
  return side;
}

}  // namespace

Record record_of(const RecordName& name, const Answer& answer) {
  const CertifiedInterval whole = interval_of(answer);
  Record record = begun(name, code_of(answer), answer);
  for (size_t i = 0; i < 2; ++i) record.inputs[i] = with_mesh(record.inputs[i], answer.inputs[i]);
  record.status = status_name(whole.status);
  if (answer.max) {
    record.verdict = verdict_name(verdict_of(answer));
    record.limit = answer.max->limit;
    record.is_by_area = answer.max->area.has_value();
  }
  record.lower = whole.lower;
  record.upper = whole.upper;
  record.directions[0] = {answer.a_to_b.lower, answer.a_to_b.upper};
  if (answer.b_to_a) record.directions[1] = {answer.b_to_a->lower, answer.b_to_a->upper};
  record.gap = std::isfinite(whole.gap) ? whole.gap : 0;
  record.diagonal = answer.a_to_b.diagonal_a;
  record.unit = answer.unit;
  record.sides = signed_of(answer);
  record.metrics = answer.metrics;
  record.notes = notes_of(answer);
  record.words = in_words(answer);
  return record;
}

Record record_of(const RecordName& name, const Failure& failure, const Answer& known) {
  Record record = begun(name, static_cast<ExitCode>(failure.code), known);
  record.words = failure.message;
  record.error_file = failure.file;
  return record;
}

// Quotes in a text are escaped, so no text in the line has these characters in this order.
std::string without_run(const std::string& line) {
  const size_t run = line.rfind(kRun);
  return run == std::string::npos ? line : line.substr(0, run) + "}";
}

bool Record::is_final() const {
  const bool is_read = !inputs[0].sha256.empty() && !inputs[1].sha256.empty();
  return is_read && code != kExitDevice && code != kExitNotWritten && code != kExitInternal;
}

Record read_record(std::string_view line) {
  const Json json = Json::parse(line, nullptr, false);
  if (json.is_discarded() || !json.is_object()) throw InputError("no JSON object");
  if (text_in(json, "schema") != kPairSchema)
    throw InputError(std::string("no result of a batch: expected the schema ") + kPairSchema);
  Record record;
  record.name = {text_in(json, "id"), text_in(json, "key")};
  const Json& code = member(json, "code");
  if (record.name.id.empty() || !code.is_number_integer())
    throw InputError("a result without an id or a code");
  const auto number = code.get<int64_t>();
  const bool is_known = (number >= 0 && number <= kExitNotWritten) || number == kExitInternal;
  if (!is_known) throw InputError("a result with the code " + std::to_string(number));
  record.code = static_cast<ExitCode>(number);
  const Json& error = member(json, "error");
  if (!error.is_object() && text_in(json, "status").empty())
    throw InputError("a result with neither a status nor an error");
  if (error.is_object()) {
    record.words = text_in(error, "message");
    record.error_file = text_in(error, "file");
  } else {
    read_answer(json, record);
  }
  const Json& inputs = member(json, "inputs");
  for (size_t i = 0; inputs.is_array() && i < std::min<size_t>(inputs.size(), 2); ++i)
    record.inputs[i] = side_of(inputs[i]);
  const Json &run = member(json, "run"), &times = member(run, "times");
  record.total_ms = number_in(times, "total_ms", 0);
  record.gpu_ms = number_in(times, "gpu_ms", 0);
  record.host = text_in(run, "host");
  record.started = text_in(run, "started");
  return record;
}

}  // namespace vkh
