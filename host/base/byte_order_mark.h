// The mark that Windows' editors and spreadsheets put before UTF-8 text, where it hides the first
// word.
#pragma once

#include <istream>
#include <string>
#include <string_view>

#include "host/base/reject.h"

namespace vkh {

inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// Throws InputError for a text that begins with UTF-16's mark.
inline void refuse_utf16(std::string_view name, std::string_view begin) {
  if (begin.starts_with("\xff\xfe") || begin.starts_with("\xfe\xff"))
    reject(name, "byte 0", "UTF-16 text", "ASCII or UTF-8");
}

/// Reads past the mark if the text begins with one, and refuses UTF-16's. A text without a mark may
/// be a pipe.
inline void skip_byte_order_mark(std::istream& text, std::string_view name) {
  const int first = text.peek();
  if (first == 0xff || first == 0xfe) {
    std::string mark(2, '\0');
    text.read(mark.data(), 2);
    refuse_utf16(name, mark);
  }
  if (first != 0xef) return;
  const std::istream::pos_type begin = text.tellg();
  std::string head(kByteOrderMark.size(), '\0');
  if (text.read(head.data(), static_cast<std::streamsize>(head.size())) && head == kByteOrderMark)
    return;
  text.clear();  // a shorter text has ended
  text.seekg(begin);
}

}  // namespace vkh
