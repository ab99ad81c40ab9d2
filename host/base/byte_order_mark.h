// The mark that Windows' editors and spreadsheets put before UTF-8 text, where it hides the first
// word.
#pragma once

#include <istream>
#include <string_view>

namespace vkh {

inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// Reads past the mark if the text, which can be searched, begins with one.
inline void skip_byte_order_mark(std::istream& text) {
  const std::istream::pos_type begin = text.tellg();
  for (const char expected : kByteOrderMark) {
    if (text.peek() == static_cast<unsigned char>(expected)) {
      text.ignore(1);
      continue;
    }
    text.clear();  // of a text that ends there
    text.seekg(begin);
    return;
  }
}

}  // namespace vkh
