#include "host/app/help_text.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace vkh {
namespace {

/// The column where an option's description begins: after the first gap of two spaces.
size_t text_column(const std::string& line) {
  const size_t name = line.find_first_not_of(' ');
  if (name == std::string::npos) return 0;
  const size_t gap = line.find("  ", name);
  if (gap == std::string::npos) return name;
  const size_t text = line.find_first_not_of(' ', gap);
  return text == std::string::npos ? name : text;
}

}  // namespace

std::string wrapped(const std::string& text, size_t columns) {
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    const std::string indent(std::min(text_column(line), columns / 2), ' ');
    while (line.size() > columns) {
      const size_t space = line.rfind(' ', columns);
      if (space == std::string::npos || space <= indent.size()) break;
      out.append(line, 0, space).append("\n");
      line.replace(0, space + 1, indent);
    }
    out += line + "\n";
  }
  return out;
}

size_t terminal_columns() {
  constexpr size_t kLeast = 60, kOtherwise = 100;
  const char* given = std::getenv("COLUMNS");
  size_t columns = 0;
  if (given == nullptr ||
      std::from_chars(given, given + std::strlen(given), columns).ec != std::errc())
    return kOtherwise;
  return std::clamp(columns, kLeast, kOtherwise);
}

}  // namespace vkh
