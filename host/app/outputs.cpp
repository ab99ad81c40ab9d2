#include "host/app/outputs.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "host/answer/exit_code.h"
#include "host/answer/quantities.h"
#include "host/answer/simplified.h"
#include "host/base/system.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/place.h"

namespace vkh {
namespace {

/// Finds the places for an answer among words that may be misspelt, and collects the other words.
Outputs outputs_in(const Words& words, Words& others) {
  Outputs outputs;
  for (size_t i = 1; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--json") {
      outputs.json = true;
    } else if (word == "--github") {
      outputs.github = true;
    } else if (word.starts_with("--json=")) {
      outputs.json_file = word.substr(7);
    } else if (word.starts_with("--junit=")) {
      outputs.junit = word.substr(8);
    } else if (word == "--junit" && i + 1 < words.size()) {
      outputs.junit = words[++i];
    } else {
      others.push_back(word.starts_with("--") ? word.substr(word.find('=') + 1) : word);
    }
  }
  if (outputs.junit == outputs.json_file) outputs.junit.reset();
  return outputs;
}

/// The limit as a good run names it, where it can be read.
std::string max_text(const std::string& typed) {
  try {
    const std::optional<SidedMax> sides = parse_sided("--max", typed);
    return sides ? sided_text(sides->over, sides->under) : typed;
  } catch (const UsageError&) {
    return typed;
  }
}

/// Names the test case of words that may be misspelt, as a good run names it if the files come
/// first.
std::string name_in(const Words& words) {
  constexpr const char* kUnknown = "vkhausdorff";
  const bool has_files =
      words.size() > 2 && !words[1].starts_with("--") && !words[2].starts_with("--");
  if (!has_files) return kUnknown;
  std::string max;
  bool both = false;
  for (size_t i = 3; i < words.size(); ++i) {
    both = both || words[i] == "--symmetric";
    if (words[i].starts_with("--max=")) max = words[i].substr(6);
    if (words[i] == "--max" && i + 1 < words.size()) max = words[i + 1];
  }
  return pair_name(words[1], words[2], both, max_text(max));
}

/// The matrix by which A was placed, as a file has it.
std::string placed_text(const Answer& answer) {
  if (!answer.placed || !answer.placed->by.matrix)
    throw OutputError("--save-transform: the run ended before A was placed");
  return matrix_text(*answer.placed->by.matrix);
}

}  // namespace

Destinations::Destinations(const Outputs& outputs, const std::vector<std::string>& inputs,
                           std::string name, bool is_verbose)
    : outputs_(outputs), name_(std::move(name)), is_verbose_(is_verbose) {
  std::vector<std::string> taken;
  for (const std::string& input : inputs) {
    if (!input.empty()) taken.push_back(input);
  }
  if (outputs.json_file) json_.emplace("--json", *outputs.json_file, taken);
  if (outputs.junit) junit_.emplace("--junit", *outputs.junit, taken);
  if (outputs.transform) transform_.emplace("--save-transform", *outputs.transform, taken);
}

std::string Destinations::write(const Answer& answer) {
  std::string not_written;
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const OutputError& error) {
      not_written += (not_written.empty() ? "" : "; ") + std::string(error.what());
    }
  };
  if (json_) attempt([&] { json_->write(to_json(answer) + '\n'); });
  if (junit_) attempt([&] { junit_->write(to_junit(answer)); });
  if (transform_) attempt([&] { transform_->write(placed_text(answer)); });
  if (outputs_.github) attempt([&] { append_github_summary(github_summary(answer)); });
  // GitHub's runner reads commands from both streams. With --json, stdout holds one object and
  // nothing else.
  if (outputs_.github) (outputs_.json ? std::cerr : std::cout) << github_annotation(answer);
  if (outputs_.json) {
    std::cout << to_json(answer) << '\n';
  } else {
    print_table(std::cout, answer, is_verbose_);
  }
  std::cout.flush();
  return not_written;
}

void Destinations::write(const Failure& failure, const std::string& json) {
  if (outputs_.github)
    (outputs_.json ? std::cerr : std::cout) << github_annotation(failure) << std::flush;
  if (outputs_.json) std::cout << json << std::endl;
  try {
    if (json_) json_->write(json + '\n');
    if (junit_) junit_->write(to_junit(failure, name_));
  } catch (const OutputError&) {
  }
}

void append_github_summary(const std::string& text) {
  const char* file = std::getenv("GITHUB_STEP_SUMMARY");
  if (file == nullptr || *file == '\0') return;
  std::ofstream out(path_of(file), std::ios::app | std::ios::binary);
  out << text;
  if (!out.flush())
    throw OutputError(
        {.option = "$GITHUB_STEP_SUMMARY", .file = file, .problem = "cannot be written"});
}

void report_misuse(const Words& words, const UsageError& error) {
  const bool is_batch = !words.empty() && words[0] == "batch";
  if (is_batch && std::find(words.begin(), words.end(), "--github") != words.end())
    std::cout << github_annotation(failure_of(error)) << std::flush;
  constexpr std::array kWithOneAnswer{"distance", "gate", "metrics", "simplify", "demo"};
  if (words.empty() ||
      std::find(kWithOneAnswer.begin(), kWithOneAnswer.end(), words[0]) == kWithOneAnswer.end())
    return;
  Words others;
  const Outputs outputs = outputs_in(words, others);
  for (const std::optional<std::string>& file : {outputs.json_file, outputs.junit}) {
    if (file && std::find(others.begin(), others.end(), *file) != others.end()) return;
  }
  const Failure failure = failure_of(error);
  try {
    Destinations(outputs, others, name_in(words))
        .write(failure, words[0] == "simplify" ? to_simplify_json(failure) : to_json(failure));
  } catch (const UsageError&) {  // `error` is reported
  }
}

}  // namespace vkh
