// An answer as JSON, written and read by its members.
#include <cmath>

#include "host/answer/json_reader.h"
#include "host/answer/json_text.h"
#include "host/answer/member_writer.h"
#include "host/base/float_environment.h"

namespace vkh {
namespace {

void check_schema(const Json& json) {
  if (!json.is_object()) throw InputError("no JSON object");
  const auto found = json.find("schema");
  if (found == json.end() || !found->is_string() || *found != kAnswerSchema)
    throw InputError({.problem = found != json.end() && found->is_string()
                                     ? "the schema '" + found->get<std::string>() + "'"
                                     : "no schema",
                      .expected = kAnswerSchema});
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

Failure failure_in(const Json& json) {
  if (!json.contains("error")) throw InputError("no error");
  JsonReader reader(json, Detail::kFull, Missing::kRefused);
  Failure failure;
  reader.object("error", [&] { visit(reader, failure); });
  if (failure.code > kExitInternal) throw InputError("code " + std::to_string(failure.code));
  return failure;
}

}  // namespace

std::vector<Note> notes_with_file(const Input& input) {
  std::vector<Note> notes = input.notes;
  for (Note& note : notes) {
    if (note.file.empty()) note.file = input.path;
  }
  return notes;
}

std::string to_json(const Answer& answer) {
  return json_object([&](JsonText& json) {
    MemberWriter writer(json, Detail::kFull);
    writer.text("schema", kAnswerSchema);
    visit(writer, answer);
  });
}

Answer answer_from(const Json& json) {
  const FloatEnvironment ours;
  check_schema(json);
  if (json.contains("error"))
    throw InputError("an error instead of an answer: " + failure_in(json).message);
  JsonReader reader(json, Detail::kFull, Missing::kRefused);
  Answer answer;
  visit(reader, answer);
  fill_in_reverse(json, answer);
  reader.compare();
  visit(reader, answer);
  check_metrics(answer);
  return answer;
}

Answer answer_from_json(std::string_view text) { return answer_from(parse_json(text)); }

Failure failure_of(const Error& error) {
  const bool is_of_input = error.parts().option.empty();
  return {.code = code_of(error.kind()),
          .message = error.what(),
          .file = is_of_input ? error.file() : "",
          .place = is_of_input ? error.place() : ""};
}

std::string to_json(const Failure& failure) { return failure_json(failure, kAnswerSchema); }

std::string failure_json(const Failure& failure, const char* schema) {
  return json_object([&](JsonText& json) {
    MemberWriter writer(json, Detail::kFull);
    writer.text("schema", schema);
    writer.text("version", program_version());
    writer.object("error", [&] { visit(writer, failure); });
  });
}

Failure failure_from_json(std::string_view text) {
  const Json json = parse_json(text);
  check_schema(json);
  return failure_in(json);
}

}  // namespace vkh
