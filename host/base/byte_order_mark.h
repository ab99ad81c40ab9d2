// The mark that Windows' editors and spreadsheets put before UTF-8 text, where it hides the first
// word.
#pragma once

#include <istream>
#include <string>
#include <string_view>

namespace vkh {

inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// Reads past the mark if the text begins with one. The text must be seekable.
inline void skip_byte_order_mark(std::istream& text) {
  const std::istream::pos_type begin = text.tellg();
  std::string head(kByteOrderMark.size(), '\0');
  if (text.read(head.data(), static_cast<std::streamsize>(head.size())) && head == kByteOrderMark)
    return;
  text.clear();  // a shorter text has ended
  text.seekg(begin);
}

}  // namespace vkh
