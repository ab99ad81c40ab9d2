// The form of every InputError's text.
#pragma once

#include <doctest/doctest.h>

#include <cctype>
#include <string>

namespace vkh::test {

inline bool names_a_place(const std::string& rest) {
  for (const std::string word :
       {"line ", "byte ", "face ", "vertex ", "triangle ", "row ", "scene ", "nodes[", "meshes[",
        "accessors[", "bufferViews[", "buffers["}) {
    if (rest.starts_with(word) && rest.size() > word.size() && std::isdigit(rest[word.size()])) {
      return true;
    }
  }
  return false;
}

/// One line that names the file, a place in it and the expected content.
inline void check_error_line(const std::string& line, const std::string& path) {
  CAPTURE(line);
  CHECK(line.find('\n') == std::string::npos);
  REQUIRE(line.starts_with(path + ": "));
  CHECK(names_a_place(line.substr(path.size() + 2)));
  const size_t expected = line.find("; expected ");
  REQUIRE(expected != std::string::npos);
  CHECK(line.size() > expected + 12);
}

}  // namespace vkh::test
