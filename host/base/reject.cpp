#include "host/base/reject.h"

#include <algorithm>

#include "host/base/error.h"

namespace vkh {

void reject(std::string_view name, const std::string& place, const std::string& what,
            const std::string& expected) {
  std::string line(name);
  if (!place.empty()) line += ": " + place;
  line += ": " + what + "; expected " + expected;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, '?');
  throw InputError(line);
}

std::string place_in(std::string_view line, std::string_view name) {
  if (!line.starts_with(name)) return "";
  const size_t begin = std::min(name.size() + 2, line.size());
  const size_t end = std::min(line.find(": ", begin), line.size());
  return end < line.find("; expected ", begin) && end < line.size()
             ? std::string(line.substr(begin, end - begin))
             : std::string();
}

std::string quoted(std::string_view word) {
  constexpr size_t kLongest = 32;
  constexpr const char* kHex = "0123456789abcdef";
  std::string out = "'";
  for (const char c : word.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      out += c;
    } else {
      out += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return out + (word.size() > kLongest ? "...'" : "'");
}

}  // namespace vkh
