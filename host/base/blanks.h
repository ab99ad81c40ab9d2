// Blank space in texts that people write.
#pragma once

#include <string_view>

namespace vkh {

/// Whether C's isspace() holds for it in the locale C.
inline bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// The text without the blank space around it.
inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace vkh
