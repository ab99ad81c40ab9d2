// The JSON that the program writes.
#pragma once

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "vkhausdorff/answer.h"

namespace vkh::test {

/// Parses the text's only line, an answer or a failure, and checks that it is read back as the same
/// bytes.
inline nlohmann::json answer_in(const std::string& text) {
  REQUIRE(text.ends_with('\n'));
  const std::string line = text.substr(0, text.size() - 1);
  CHECK(line.find('\n') == std::string::npos);
  REQUIRE(nlohmann::json::accept(line));
  nlohmann::json answer = nlohmann::json::parse(line);
  const bool has_failed = answer.contains("error");
  CHECK((has_failed ? to_json(failure_from_json(line)) : to_json(answer_from_json(line))) == line);
  return answer;
}

}  // namespace vkh::test
