// The example programs as people run them: their output.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <string>

#include "tests/support/program.h"

namespace {

using namespace vkh::test;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

Outcome run_example(const char* name, Words words) {
  REQUIRE_MESSAGE(!environment(name).empty(), name);
  setenv("VKH_PROGRAM", environment(name).c_str(), 1);
  if (!environment("VKH_VALIDATION").empty()) words.push_back("--validation");
  const Outcome outcome = run(words);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);  // not 0 if the validation layer reported anything
  return outcome;
}

/// The text between two lines that hold `mark`, or after it in the next block of code.
std::string between_marks(const std::string& text, const std::string& from, const std::string& to) {
  const size_t start = text.find(from);
  REQUIRE(start != std::string::npos);
  const size_t first = start + from.size();
  const size_t last = text.find(to, first);
  REQUIRE(last != std::string::npos);
  return text.substr(first, last - first);
}

using Rows = std::vector<std::vector<std::string>>;
Rows parse_csv(const std::string& text) {
  Rows rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

}  // namespace

TEST_CASE("the page quotes the embedding example to the letter, and it is about thirty lines") {
  const std::string source = read_file(VKH_SOURCE_DIR "/examples/embed.cpp");
  const std::string page = read_file(VKH_SOURCE_DIR "/docs/embedding.md");
  const std::string example = between_marks(source, "// [embed]\n", "// [embed]\n");
  CHECK(between_marks(page, "<!-- examples/embed.cpp -->\n```cpp\n", "```\n") == example);
  const auto lines = std::count(example.begin(), example.end(), '\n');
  CHECK(lines >= 20);
  CHECK(lines <= 31);
}

TEST_CASE("the embedding example prints an interval that holds the height of a pyramid") {
  const Outcome outcome = run_example("VKH_EXAMPLE_EMBED", {});
  const char* text = outcome.out.c_str();
  char* rest = nullptr;
  const double lower = std::strtod(text, &rest);
  const std::string middle = " <= h(pyramid, base) <= ";
  REQUIRE(std::string(rest).compare(0, middle.size(), middle) == 0);
  const double upper = std::strtod(rest + middle.size(), nullptr);
  CHECK(lower <= 1.0);
  CHECK(upper >= 1.0);
  CHECK(upper - lower <= 2e-5);
}

TEST_CASE("vkh_frames: every mode of every frame closes, and the modes agree") {
  const Outcome outcome =
      run_example("VKH_EXAMPLE_FRAMES", {"--frames", "3", "--cells", "32", "24"});
  const Rows rows = parse_csv(outcome.out);
  constexpr std::array kModes{"warm", "cold", "rebuild", "faces"};
  REQUIRE(rows.size() == 1 + 3 * kModes.size());
  CHECK(outcome.out.rfind("frame,mode,gpu_ms,wall_ms,lower,upper,closed,waves\n", 0) == 0);
  for (size_t frame = 0; frame < 3; ++frame) {
    double lower = 0, upper = 1e30;
    for (size_t mode = 0; mode < kModes.size(); ++mode) {
      const auto& row = rows[1 + kModes.size() * frame + mode];
      REQUIRE(row.size() == 8);
      CHECK(row[1] == kModes[mode]);
      CHECK(std::stod(row[2]) > 0);
      CHECK(row[6] == "1");
      lower = std::max(lower, std::stod(row[4]));
      upper = std::min(upper, std::stod(row[5]));
    }
    CHECK(lower > 0.01);
    CHECK(lower <= upper);
  }
  CHECK(outcome.err.find("1536 faces against 384") != std::string::npos);
  for (const char* word : {"warm", "cold", "rebuild", "faces: ", "median", "p99", "0 not closed"})
    CHECK(outcome.err.find(word) != std::string::npos);
}
