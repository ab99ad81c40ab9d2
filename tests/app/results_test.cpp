// Results of several files as one: the rules for merging lines.
#include <doctest/doctest.h>

#include <array>
#include <string>

#include "host/answer/json_object.h"
#include "host/answer/merge.h"
#include "host/base/error.h"
#include "tests/support/files.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr const char* kKey = "a key";

struct Said {
  double lower, upper;
  double back_lower = 0, back_upper = 0;
  std::string key = kKey;
};

std::string line_of(const Said& said) {
  Answer answer;
  answer.a_to_b.lower = said.lower;
  answer.a_to_b.upper = said.upper;
  answer.b_to_a = answer.a_to_b;
  answer.b_to_a->lower = said.back_lower;
  answer.b_to_a->upper = said.back_upper;
  for (Input& input : answer.inputs) input.sha256 = std::string(64, 'a');
  return to_record({"the id", said.key}, answer);
}

std::string without_files(const std::string& line) {
  Json json = Json::parse(line);
  for (Json& input : json["inputs"]) input.erase("files");
  return json.dump();
}

/// Merges one line each, in one file each; returns the refusal, or the upper end that counts.
std::string merged(const std::vector<std::string>& lines) {
  Results results;
  try {
    for (size_t i = 0; i < lines.size(); ++i)
      results.add(write_file(std::to_string(i) + ".jsonl", lines[i] + "\n"));
  } catch (const InputError& error) {
    return error.what();
  }
  std::string upper;
  results.for_each(
      [&](const Record& record, const std::string&) { upper += std::to_string(record.upper); });
  return upper;
}

void check_refused(const std::vector<std::string>& lines, const std::string& why) {
  const std::string said = merged(lines);
  CAPTURE(said);
  CHECK(said.find("'the id'") != std::string::npos);
  CHECK(said.find(why) != std::string::npos);
}

}  // namespace

TEST_CASE("of two true intervals of one question the narrower counts") {
  CHECK(merged({line_of({0.5, 1}), line_of({0.75, 1})}) == "1.000000");
  CHECK(merged({line_of({0.5, 0.75}), line_of({0.75, 1.5})}) == "0.750000");  // they touch
}

TEST_CASE("intervals of one key that do not meet are refused, in several files and in one") {
  const std::string near = line_of({0.25, 0.5}), far = line_of({7, 7});
  check_refused({near, far}, "[7, 7] does not meet the [0.25, 0.5]");
  check_refused({near + "\n" + far}, "does not meet");
  check_refused({far, near}, "does not meet");
  // The larger of both directions is the same, and one direction is not.
  check_refused({line_of({0.25, 0.5, 7, 7}), line_of({0.75, 1, 7, 7})}, "does not meet");
  check_refused({line_of({7, 7, 0.25, 0.5}), line_of({7, 7, 0.75, 1})}, "does not meet");
}

TEST_CASE("a later line of one file replaces what was of other inputs") {
  CHECK(merged({line_of({0.25, 0.5}) + "\n" +
                line_of({.lower = 7, .upper = 7, .key = "another"})}) == "7.000000");
  check_refused({line_of({0.25, 0.5}), line_of({.lower = 0.25, .upper = 0.5, .key = "another"})},
                "other inputs or options");
}

TEST_CASE("keys that do not say which files were read go with no other line") {
  const std::string line = line_of({0.25, 0.5});
  CHECK(merged({without_files(line)}) == "0.500000");
  check_refused({line, without_files(line)}, "nothing tells that both are of the same files");
  check_refused({without_files(line), without_files(line)}, "nothing tells");
  const std::string none = line_of({.lower = 0.25, .upper = 0.5, .key = ""});
  check_refused({none, none}, "nothing tells");
}
