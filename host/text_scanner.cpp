#include "host/text_scanner.h"

#include <algorithm>
#include <cstring>

namespace vkh {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// Lines end in LF or CR LF; only a file whose first line ends in a CR alone ends them so
// throughout (old Macintosh exports). Deciding once keeps a binary body's first LF out of it.
char line_terminator(std::string_view text) {
  const size_t end = text.find_first_of("\r\n");
  if (end == std::string_view::npos || text[end] == '\n') return '\n';
  return end + 1 < text.size() && text[end + 1] == '\n' ? '\n' : '\r';
}

}  // namespace

void reject(std::string_view name, const std::string& place, const std::string& what,
            const std::string& expected) {
  std::string line(name);
  line += ": " + place + ": " + what + "; expected " + expected;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, '?');
  throw InputError(line);
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

TextScanner::TextScanner(std::string_view text, std::string_view name, char comment)
    : text_(text), name_(name), comment_(comment), terminator_(line_terminator(text)) {}

std::string_view TextScanner::physical_line() {
  const char* begin = text_.data() + next_;
  const auto* end = static_cast<const char*>(std::memchr(begin, terminator_, bytes_left()));
  const size_t size = end ? static_cast<size_t>(end - begin) : bytes_left();
  next_ += size + (end ? 1 : 0);
  ++lines_taken_;
  return {begin, size};
}

bool TextScanner::next_line() {
  if (next_ == text_.size()) {
    skip_line();
    return false;
  }
  line_number_ = lines_taken_ + 1;
  line_ = physical_line();
  cursor_ = 0;
  return true;
}

bool TextScanner::next_full_line() {
  while (next_line()) {
    if (!word().empty()) {
      cursor_ = 0;
      return true;
    }
  }
  return false;
}

void TextScanner::join_continued_lines() {
  const auto continued = [](std::string_view& line) {
    while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
    if (line.empty() || line.back() != '\\') return false;
    line.remove_suffix(1);
    return true;
  };
  std::string_view part = line_;
  if (!continued(part)) return;
  joined_.assign(part);
  for (bool more = true; more && next_ < text_.size();) {
    part = physical_line();
    more = continued(part);
    joined_.append(" ").append(part);
  }
  line_ = joined_;
}

std::string_view TextScanner::word() {
  while (cursor_ < line_.size() && is_space(line_[cursor_])) ++cursor_;
  const size_t begin = cursor_;
  if (comment_ != '\0' && begin < line_.size() && line_[begin] == comment_) skip_line();
  while (cursor_ < line_.size() && !is_space(line_[cursor_])) ++cursor_;
  const bool comment = comment_ != '\0' && begin < line_.size() && line_[begin] == comment_;
  return comment ? std::string_view() : line_.substr(begin, cursor_ - begin);
}

std::string_view TextScanner::word_across_lines() {
  std::string_view found = word();
  while (found.empty() && next_line()) found = word();
  return found;
}

void TextScanner::fail(const std::string& what, const std::string& expected) const {
  reject(name_, place(), what, expected);
}

void TextScanner::fail_number(std::string_view word, const char* what, bool integer) const {
  const std::string found = word.empty() ? "no " : quoted(word) + " as ";
  fail(found + what, integer ? "a decimal integer" : "a finite decimal number such as -1.5e-3");
}

}  // namespace vkh
