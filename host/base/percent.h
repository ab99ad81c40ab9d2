// Percents in URIs (RFC 3986, section 2.1).
#pragma once

#include <string>
#include <string_view>

namespace vkh {

/// Returns -1 for a character that is no hexadecimal digit.
constexpr int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// Turns "my%20part" into "my part"; a percent before anything but two digits stands for itself.
inline std::string without_percents(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool has_two = text[i] == '%' && i + 2 < text.size();
    const int high = has_two ? hex_digit(text[i + 1]) : -1;
    const int low = has_two ? hex_digit(text[i + 2]) : -1;
    const bool is_escape = high >= 0 && low >= 0;
    out += is_escape ? static_cast<char>(16 * high + low) : text[i];
    if (is_escape) i += 2;
  }
  return out;
}

}  // namespace vkh
