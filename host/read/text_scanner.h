// The readers' cursor over a file's bytes: lines, words and numbers, never past the end, and errors
// that name the file and the line.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

#include "host/base/blanks.h"
#include "host/base/parse_number.h"

namespace vkh {

/// The treatment of a line of text with the other terminator in its midst: a carriage return among
/// lines that end in LF, or the reverse. Some readers take the rest as a line of its own, and
/// others as part of a comment or a name.
enum class MixedLineEnds { kRefused, kIgnored };

/// Whether a word is what C libraries print for a float that is no number, or infinite: nan,
/// -nan(ind), 1.#QNAN, inf.
bool is_printed_nan(std::string_view word);

/// Lines end in LF or CR LF (or CR CR LF); only a text whose first line ends in a CR alone ends
/// them so throughout (old Macintosh exports).
char line_terminator(std::string_view text);

class TextScanner {
 public:
  /// `comment` ends a line's words wherever it begins one; '\0' for formats without comments.
  TextScanner(std::string_view text, std::string_view name, char comment = '\0',
              MixedLineEnds mixed = MixedLineEnds::kRefused)
      : TextScanner(text, name, comment, line_terminator(text), mixed) {}
  /// Scans a part of a text, with the text's line_terminator.
  TextScanner(std::string_view part, std::string_view name, char comment, char terminator,
              MixedLineEnds mixed = MixedLineEnds::kRefused);

  /// Goes to the next line; false at the end of the text.
  bool next_line();
  /// Goes to the next line that holds a word.
  bool next_full_line();
  /// Whether the current line ends in a backslash outside of a comment.
  bool is_continued() const;
  /// Appends the lines that continue the current one. Fails if a backslash splits a word: some
  /// readers take '2\' and '4' as one number, others as two.
  void join_continued_lines();

  /// The next word of the current line, empty at its end.
  std::string_view word();
  /// The rest of the current line.
  std::string_view rest() const { return line_.substr(cursor_); }
  /// The first character of the next word of the current line; '\0' at its end.
  char peek() const;
  /// The next word of this line or a later one, empty at the end of the text.
  std::string_view word_across_lines();
  /// Skips the rest of the current line.
  void skip_line() { cursor_ = line_.size(); }

  /// Reads a number from the current line; fails if there is none. `what` names it in the error.
  template <class T>
  T number(const char* what) {
    return number_in<T>(word(), what);
  }
  /// Reads the number that a word is; fails if it is none.
  template <class T>
  T number_in(std::string_view text, const char* what) const {
    T value{};
    if (!parse_number(text, value)) fail_number(text, what, std::is_integral_v<T>);
    return value;
  }

  /// Reads a coordinate as C libraries print it, from the current line: also one that is no number
  /// or infinite, for scanners and exporters leave such vertices where no face uses them.
  double coordinate() { return coordinate_in(word()); }
  double coordinate_in(std::string_view text) const {
    double value = 0;
    return parse_number(text, value) ? value : nan_in(text);
  }

  size_t line_number() const { return line_number_; }
  /// The byte after the current line and its terminator.
  size_t offset() const { return next_; }
  size_t bytes_left() const { return text_.size() - next_; }

  std::string place() const { return "line " + std::to_string(line_number_); }
  [[noreturn]] void fail(const std::string& what, const std::string& expected) const;

 private:
  std::string_view physical_line();
  void check_line_end(std::string_view line) const;
  bool cut_continuation(std::string_view& line) const;
  double nan_in(std::string_view word) const;
  [[noreturn]] void fail_number(std::string_view word, const char* what, bool integer) const;

  std::string_view text_;
  std::string_view name_;
  char comment_;
  char terminator_;
  char other_terminator_;
  bool checks_line_ends_;
  std::string_view line_;
  std::string joined_;
  size_t cursor_ = 0;
  size_t next_ = 0;
  size_t line_number_ = 0;
  size_t lines_taken_ = 0;
};

}  // namespace vkh
