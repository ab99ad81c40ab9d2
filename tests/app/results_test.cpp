// Results of several files as one: the rules for merging lines.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "host/answer/json_object.h"
#include "host/answer/merge.h"
#include "host/answer/rank.h"
#include "tests/support/files.h"
#include "vkhausdorff/error.h"

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
  return to_line(result_of({"the id", said.key}, answer));
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
  results.for_each([&](const Result& result, const std::string&) {
    upper += std::to_string(interval_of(result.answer).upper);
  });
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

namespace {

struct Shown {
  const char* id;
  ExitCode code;
  double lower, upper, limit;
  const char* unit = "";
};

Result shown_result(const Shown& shown) {
  Result result;
  result.name.id = shown.id;
  result.code = shown.code;
  const bool has_answer = shown.code <= kExitNotClosed && shown.code != kExitUsage;
  if (!has_answer)
    result.failure = Failure{.code = shown.code, .message = {}, .file = {}, .place = {}};
  Answer& answer = result.answer;
  answer.a_to_b.lower = shown.lower;
  answer.a_to_b.upper = shown.upper;
  answer.unit = shown.unit;
  if (shown.limit > 0) answer.max = Asked{.length = {}, .limit = {shown.limit, shown.limit}};
  return result;
}

std::vector<std::string> ranked(const std::vector<Shown>& shown) {
  std::vector<Rank> ranks;
  for (const Shown& one : shown) ranks.push_back(rank_of(shown_result(one)));
  std::sort(ranks.begin(), ranks.end(), is_worse);
  std::vector<std::string> ids;
  for (const Rank& rank : ranks) ids.push_back(rank.id);
  return ids;
}

}  // namespace

TEST_CASE("results are ranked by verdict, then by the lower end over the limit") {
  using Ids = std::vector<std::string>;
  CHECK(ranked({{"pass", kExitClosed, 0.09, 0.1, 0.1},
                {"closed", kExitClosed, 5, 5, 0},
                {"open", kExitNotClosed, 0, 9, 0.1},
                {"bad", kExitBadInput, 0, 0, 0},
                {"wrong", kExitUsage, 0, 0, 0},
                {"fail", kExitBeyond, 0.2, 0.3, 0.1}}) ==
        Ids{"fail", "bad", "wrong", "open", "closed", "pass"});
  // The upper end of a run that ended beyond its limit was not sought.
  CHECK(ranked({{"far", kExitBeyond, 0.2, 117, 0.1},
                {"farther", kExitBeyond, 0.3, 0.4, 0.1},
                {"small limit", kExitBeyond, 0.1, 0.4, 0.01}}) ==
        Ids{"small limit", "farther", "far"});
  CHECK(ranked({{"b", kExitBeyond, 0.2, 1, 0.1}, {"a", kExitBeyond, 0.2, 2, 0.1}}) ==
        Ids{"a", "b"});
  CHECK(ranked({{"mm", kExitClosed, 2, 2, 0, "mm"},
                {"in", kExitClosed, 1, 1, 0, "in"},
                {"m", kExitClosed, 0.001, 0.001, 0, "m"},
                {"unknown", kExitClosed, 1.5, 1.5, 0}}) == Ids{"in", "mm", "unknown", "m"});
}

TEST_CASE("the share of a limit is rounded down") {
  const Result third = shown_result({"x", kExitBeyond, 1, 2, 3});
  CHECK(share_of_limit(third) < 1.0 / 3);
  CHECK(share_of_limit(third) > 1.0 / 3 * (1 - 0x1p-51));
  CHECK(share_of_limit_text(third) == "0.333");
  CHECK(share_of_limit_text(shown_result({"x", kExitBeyond, 0.3, 1, 0.1})) == "2.99");
  CHECK(share_of_limit_text(shown_result({"x", kExitClosed, 0, 1, 1})) == "0");
  CHECK(share_of_limit_text(shown_result({"x", kExitClosed, 1, 1, 0})).empty());
  CHECK(share_of_limit_text(shown_result({"x", kExitBadInput, 0, 1, 1})).empty());
  CHECK(share_of_limit(shown_result({"x", kExitBeyond, 1e308, 1e308, 1e-300})) <
        std::numeric_limits<double>::infinity());
}
