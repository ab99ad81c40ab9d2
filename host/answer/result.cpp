#include "host/answer/result.h"

#include <algorithm>
#include <utility>

#include "host/answer/json_reader.h"
#include "host/answer/json_text.h"
#include "host/answer/member_writer.h"
#include "host/base/float_environment.h"

namespace vkh {
namespace {

constexpr const char* kPairSchema = "vkhausdorff.pair/2";
constexpr const char* kRun = ",\"run\":{";

double gpu_ms(const Answer& answer) {
  double sum = 0;
  for (const Report* r : {&answer.a_to_b, answer.b_to_a ? &*answer.b_to_a : nullptr}) {
    if (r != nullptr) sum += r->times.hierarchy_ms + r->times.solve_ms;
  }
  return sum;
}

bool lacks(const Result& result, const char* key) {
  return std::find(result.lacking.begin(), result.lacking.end(), key) != result.lacking.end();
}

void check_line(const Json& json) {
  if (json.is_discarded() || !json.is_object()) throw InputError("no JSON object");
  if (!json.contains("schema") || json["schema"] != kPairSchema)
    throw InputError(std::string("no result of a batch: expected the schema ") + kPairSchema);
  for (const char* key : {"id", "code"}) {
    if (!json.contains(key)) throw InputError("a result without an id or a code");
  }
  if (!json.contains("error") && !json.contains("status"))
    throw InputError("a result with neither a status nor an error");
}

}  // namespace

bool Result::is_final() const {
  const bool is_read = !answer.inputs[0].sha256.empty() && !answer.inputs[1].sha256.empty();
  return is_read && code != kExitDevice && code != kExitNotWritten && code != kExitInternal &&
         lacking.empty();
}

bool Result::is_upper_sought() const {
  const CertifiedInterval whole = interval_of(answer);
  return vkh::is_upper_sought(answer, whole.lower, whole.upper);
}

bool Result::names_files() const { return !lacks(*this, "files"); }

Result result_of(ResultName name, Answer answer) {
  const ExitCode code = code_of(answer);
  const double ms = gpu_ms(answer);
  return {.name = std::move(name),
          .code = code,
          .answer = std::move(answer),
          .failure = {},
          .gpu_ms = ms};
}

Result result_of(ResultName name, Failure failure, Answer known) {
  const auto code = static_cast<ExitCode>(failure.code);
  const double ms = gpu_ms(known);
  return {.name = std::move(name),
          .code = code,
          .answer = std::move(known),
          .failure = std::move(failure),
          .gpu_ms = ms};
}

std::string to_line(const Result& result) {
  return json_object([&](JsonText& json) {
    MemberWriter writer(json, Detail::kBrief);
    writer.text("schema", kPairSchema);
    visit(writer, result);
  });
}

// Quotes in a text are escaped, so no text in the line has these characters in this order.
std::string without_run(const std::string& line) {
  const size_t run = line.rfind(kRun);
  return run == std::string::npos ? line : line.substr(0, run) + "}";
}

Result read_result(std::string_view line) {
  const FloatEnvironment ours;
  const Json json = parse_json(line);
  check_line(json);
  JsonReader reader(json, Detail::kBrief, Missing::kNoted);
  Result result;
  visit(reader, result);
  if (result.name.id.empty()) throw InputError("a result without an id or a code");
  fill_in_reverse(json, result.answer);
  result.lacking = reader.lacking();
  if (!result.lacking.empty()) return result;
  reader.compare();
  visit(reader, result);
  return result;
}

}  // namespace vkh
