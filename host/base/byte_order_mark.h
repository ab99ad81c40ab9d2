// The mark that Windows' editors and spreadsheets put before UTF-8 text, where it hides the first
// word.
#pragma once

#include <istream>
#include <string_view>

namespace vkh {

inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// Reads past the mark, where the text begins with one. No other text begins with its first byte
/// alone and is UTF-8.
inline void skip_byte_order_mark(std::istream& text) {
  if (text.peek() != static_cast<unsigned char>(kByteOrderMark.front())) return;
  text.ignore(static_cast<std::streamsize>(kByteOrderMark.size()));
}

}  // namespace vkh
