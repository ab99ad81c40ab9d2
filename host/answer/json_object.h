// JSON whose bounds are written as they were rounded.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "host/base/decimal.h"
#include "vkhausdorff/answer.h"

namespace vkh {

using Json = nlohmann::ordered_json;

inline constexpr const char* kAnswerSchema = "vkhausdorff.answer/2";

/// Members in order. nlohmann cannot write a number in a given form, and the bounds must be written
/// as they were rounded, so the outermost object is put together as text.
class JsonObject {
 public:
  void add_text(const char* key, const std::string& json) {
    members_ += (members_.empty() ? "\"" : ",\"") + std::string(key) + "\":" + json;
  }
  // Replaces bytes of a file name that are no UTF-8: they must not cost the answer.
  void add(const char* key, const Json& value) {
    add_text(key, value.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  void add_bound(const std::string& key, double value, Rounding rounding) {
    add_text(key.c_str(),
             std::isfinite(value) ? decimal(value, kJsonDigits, rounding) : std::string("null"));
    add((key + "_hex").c_str(), hex_float(value));
  }
  /// Both ends, and the estimate between them, which is read back as the same double.
  void add_enclosure(const Enclosure& e) {
    add_bound("lower", e.lower, Rounding::kDown);
    add_bound("upper", e.upper, Rounding::kUp);
    if (e.estimate) add_text("estimate", decimal_between(*e.estimate, e.lower, e.upper));
  }
  std::string text() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

/// Writes an error in place of an answer of this schema.
std::string failure_json(const Failure& failure, const char* schema);

inline Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

/// Adds the files that an input was read from: `sha256`, null if it is not known, and `files`, the
/// other files, which are null with it.
void add_hashes(Json& json, const Input& input);

/// Writes the notes as answers and records have them. `file`: the file of notes that name none.
Json notes_json(std::span<const Note> notes, const std::string& file);
/// Reads the notes of an answer or an input: objects, or texts that begin with a code, as they were
/// before 0.3.0. Skips codes that are not known.
std::vector<Note> notes_in(const Json& object);

/// The lower or upper end `key` of an interval, from its hexadecimal digits, which give the double
/// itself. Throws InputError where they are missing or malformed, negative or another double than
/// the decimal beside them.
double bound_in(const Json& interval, const std::string& key);
/// The same for a bound of signed distances, which may be negative.
double signed_bound_in(const Json& interval, const std::string& key);
/// Checks every bound of an answer that was read, as bound_in does, and as signed_bound_in does
/// within a member `signed`.
void check_bounds(const Json& answer);
/// The answer of a document that is parsed, as answer_from_json().
Answer answer_from(const Json& json);
/// A whole number of 0 or more. Throws InputError that names `key` for anything else: 1.9, true.
uint64_t count_in(const Json& object, const std::string& key);

/// kBrief leaves out times, stages, waves and workspace, which only one run or machine has.
enum class Detail { kFull, kBrief };

/// Adds the survey of one direction's mesh: `survey`, and `field`, `statistics` and `signed` where
/// they were asked for.
void add_survey(JsonObject& json, const SurveyResult& survey, const Answer& answer, Detail detail);

/// Adds `metrics` of an answer that has some, and reads them back. Reading throws InputError.
void add_metrics(JsonObject& json, const Answer& answer);
Metrics metrics_from(const Json& json);

/// Adds an answer's members in docs/schema/answer.schema.json from `words` to `options`.
void add_answer(JsonObject& json, const Answer& answer, Detail detail);
/// Adds `device` and `driver`; `times`.
void add_device(JsonObject& json, const Answer& answer);
void add_waits(JsonObject& json, const Waits& waits);

}  // namespace vkh
