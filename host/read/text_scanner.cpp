#include "host/read/text_scanner.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <limits>

#include "host/base/reject.h"

namespace vkh {

bool is_printed_nan(std::string_view word) {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  if (word.starts_with("1.#")) return true;
  std::string lower(word);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower == "nan" || lower == "inf" || lower == "infinity" ||
         (lower.starts_with("nan(") && lower.ends_with(')'));
}

// Decides once, which keeps a binary body's first LF out of it.
char line_terminator(std::string_view text) {
  const size_t end = text.find_first_of("\r\n");
  if (end == std::string_view::npos) return '\n';
  const size_t after = text.find_first_not_of('\r', end);
  return after != std::string_view::npos && text[after] == '\n' ? '\n' : '\r';
}

TextScanner::TextScanner(std::string_view part, std::string_view name, char comment,
                         char terminator, MixedLineEnds mixed)
    : text_(part), name_(name), comment_(comment), terminator_(terminator) {
  // Searches the whole text once, so that the lines of most texts need no search.
  other_terminator_ = terminator_ == '\n' ? '\r' : '\n';
  checks_line_ends_ =
      mixed == MixedLineEnds::kRefused && part.find(other_terminator_) != std::string_view::npos;
}

std::string_view TextScanner::physical_line() {
  const char* begin = text_.data() + next_;
  const auto* end = static_cast<const char*>(std::memchr(begin, terminator_, bytes_left()));
  const size_t size = end ? static_cast<size_t>(end - begin) : bytes_left();
  next_ += size + (end ? 1 : 0);
  ++lines_taken_;
  const std::string_view line(begin, size);
  if (checks_line_ends_) check_line_end(line);
  return line;
}

// Accepts the other terminator at the end of a line as blank space: CR LF, or CR CR LF.
void TextScanner::check_line_end(std::string_view line) const {
  const size_t at = line.find(other_terminator_);
  if (at == std::string_view::npos) return;
  if (std::all_of(line.begin() + static_cast<std::ptrdiff_t>(at), line.end(), is_space)) return;
  reject(name_, "line " + std::to_string(lines_taken_),
         other_terminator_ == '\r' ? "a carriage return inside the line"
                                   : "a line feed inside the line",
         "lines that all end alike");
}

// Cuts off the backslash that continues a line, and any comment, and the blanks before them.
bool TextScanner::cut_continuation(std::string_view& line) const {
  const auto trim = [&line] {
    while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
  };
  trim();
  if (line.empty() || line.back() != '\\') return false;
  for (size_t at = line.find(comment_); at < line.size(); at = line.find(comment_, at + 1)) {
    if (at > 0 && !is_space(line[at - 1])) continue;
    line = line.substr(0, at);
    trim();
    return false;
  }
  line.remove_suffix(1);
  return true;
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

bool TextScanner::is_continued() const {
  std::string_view line = line_;
  return cut_continuation(line);
}

void TextScanner::join_continued_lines() {
  std::string_view part = line_;
  if (!cut_continuation(part)) return;
  joined_.assign(part);
  for (bool more = true; more && next_ < text_.size();) {
    const bool in_word = !joined_.empty() && !is_space(joined_.back());
    part = physical_line();
    if (in_word && !part.empty() && !is_space(part.front())) {
      fail("a backslash splits a word", "a blank before it");
    }
    more = cut_continuation(part);
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

char TextScanner::peek() const {
  size_t at = cursor_;
  while (at < line_.size() && is_space(line_[at])) ++at;
  return at < line_.size() ? line_[at] : '\0';
}

std::string_view TextScanner::word_across_lines() {
  std::string_view found = word();
  while (found.empty() && next_line()) found = word();
  return found;
}

void TextScanner::fail(const std::string& what, const std::string& expected) const {
  reject(name_, place(), what, expected);
}

double TextScanner::nan_in(std::string_view word) const {
  if (!is_printed_nan(word)) fail_number(word, "coordinate", false);
  const bool is_infinite =
      word.find_first_of("iI") <= 1 && word.find('#') == std::string_view::npos;
  if (!is_infinite) return std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  return word.starts_with('-') ? -infinity : infinity;
}

void TextScanner::fail_number(std::string_view word, const char* what, bool integer) const {
  const std::string found = word.empty() ? "no " : quoted(word) + " as ";
  fail(found + what, integer ? "a decimal integer" : "a finite decimal number such as -1.5e-3");
}

}  // namespace vkh
