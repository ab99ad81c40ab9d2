// An answer's JSON, read back: byte for byte what was written, and nothing that was changed since.
#include <doctest/doctest.h>

#include <cstdlib>
#include <functional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "host/answer/json_object.h"
#include "host/base/decimal.h"
#include "tests/support/answer_kinds.h"
#include "tests/support/sanitized.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using namespace vkh::test;

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
  for (const Answer& answer : all_kinds_of_answers()) {
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
  CHECK(answer_from_json(to_json(gate_answer("0.2mm", 0.2, 0.15))).notes ==
        distance_answer().notes);
}

// A decimal that reads as the same double may lie on either side of it: all digits are compared, as
// texts of numbers with as many digits before the point.
TEST_CASE("the decimals beside hexadecimal ends are rounded outward") {
  const std::regex end(
      "\"([a-z_]*)(lower|upper)\":(0[.][0-9]+),\"[a-z_]*_hex\":\"(0x[0-9a-fp.+-]+)\"");
  size_t inexact = 0;
  for (const Answer& answer : all_kinds_of_answers()) {
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
  CHECK_THROWS_AS(failure_from_json(to_json(distance_answer())), InputError);
  CHECK_THROWS_AS(failure_from_json("[]"), InputError);
}

TEST_CASE("documents of other schemas are refused by name") {
  for (const char* text : {"", "{", "[]", "3", "null"}) CHECK(refusal(text) == "no JSON object");
  CHECK(refusal("{}") == "no schema; expected vkhausdorff.answer/2");
  Json old = Json::parse(to_json(distance_answer()));
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
  CHECK(refused(distance_answer(), "/interval", wide) ==
        "an interval that is not that of its directions");
  CHECK(refused(distance_answer(), "/interval/gap", 0.5) ==
        "a gap that is not that of its interval");
  CHECK(refused(both_directions(), "/directions/1/interval/gap", 0.5) ==
        "a gap that is not that of its interval");
  CHECK(refused(distance_answer(), "/status", "time") ==
        "a status that is not that of its directions");
  CHECK(refused(distance_answer(), "/verdict", "pass") ==
        "a verdict without a limit, or a limit without one");
  CHECK(refused(gate_answer("0.05mm", 0.05, 0.15), "/verdict", "pass") ==
        "a verdict that is not that of its bounds");
  CHECK(refused(distance_answer(), "/options/symmetric", true) ==
        "symmetric contradicts the directions");
  CHECK(refused(surveyed(), "/directions/0/survey/met", true) == "met contradicts ended");
  CHECK(refused(distance_answer(), "/tolerance/requested", "much") ==
        "requested 'much' is no length");
  CHECK(refused(distance_answer(), "/tolerance/requested", "1mm") ==
        "requested '1mm' and diagonal_of contradict each other");
  CHECK(refused(distance_answer(), "/directions/0/status", "happy") == "status 'happy'");
}

TEST_CASE("what this version says of the rest is compared where this version has said it") {
  Json json = Json::parse(to_json(both_directions()));
  json["words"] = "all is well";
  CHECK(refusal(json.dump()) == "words are not those of the answer");
  json["version"] = "0.2.0";
  CHECK(in_words(answer_from_json(json.dump())) == "all is well");
  json["stop_reason"] = "it was tired";
  CHECK(refusal(json.dump()) == "it was read");
  json["version"] = program_version();
  CHECK(refusal(json.dump()) != "it was read");
  json = Json::parse(to_json(by_face()));  // the limits of its faces are not in it
  json["words"] = "all is well";
  CHECK(refusal(json.dump()) == "it was read");
}

TEST_CASE("a member that came with a version is missing in older answers alone") {
  Json json = Json::parse(to_json(both_directions()));
  CHECK(json["tolerance"]["diagonal_b"] == 3);
  json["tolerance"].erase("diagonal_b");
  CHECK(refusal(json.dump()) == "no diagonal_b");
  for (const char* version : {"0.2.0", "0.2.9", "0", "0.2"}) {
    json["version"] = version;
    CHECK(answer_from_json(json.dump()).b_to_a->diagonal_a == 3);
  }
  for (const char* version : {"0.3.0", "0.10.0", "1", ""}) {
    json["version"] = version;
    CHECK(refusal(json.dump()) == "no diagonal_b");
  }
}

TEST_CASE("a stranger in place of any value is refused, or read as another answer") {
  const std::vector<Json> strangers = {nullptr,       true,           -1,   1.5, "x", "", 3,
                                       Json::array(), Json::object(), 1e300};
  size_t turn = 0;  // of the sanitizers, where a value meets one of them
  for (const Answer& answer : all_kinds_of_answers()) {
    const Json whole = Json::parse(to_json(answer));
    for_each_value(whole, "", [&](const std::string& at, const Json&) {
      for (const Json& stranger : strangers) {
        if (kIsSanitized && turn++ % (strangers.size() + 1) != 0) continue;
        Json changed = whole;
        changed[Json::json_pointer(at)] = stranger;
        (void)is_refused(changed);
      }
    });
  }
}

TEST_CASE("a member that is missing is refused, unless it may be or says nothing new") {
  const std::set<std::string> dispensable = {
      "name",      "to",       "code",  "text",         "value",
      "unit",                            // says nothing new
      "file",      "face",     "notes",  // or is of a note
      "part",      "parts",    "boxes", "more_devices", "barycentric", "certificate",
      "coverage",  "faces_a",  "field", "verified",     "exact",       "u1",
      "transform", "estimate", "jump",  "inside_out",   "worst"};
  for (const Answer& answer : all_kinds_of_answers()) {
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
