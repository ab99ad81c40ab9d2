// Comma-separated values (RFC 4180), as spreadsheets write them: with semicolons where the comma is
// the decimal point.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "host/base/decimal.h"

namespace vkh {

/// A row of these cells, in quotes where they have to be, with `end` behind it.
std::string csv_line(const std::vector<std::string>& cells, const char* end = "\n");
/// An end of an enclosure with JSON's digits; empty where it is infinite.
std::string csv_bound(double value, Rounding rounding);

class CsvReader {
 public:
  /// Rows that begin with `comment` are skipped; '\0' for files without comments.
  explicit CsvReader(std::istream& text, char comment = '\0') : text_(text), comment_(comment) {}
  /// Returns the next row that has a cell which is not empty; nothing at the end. Cells in quotes
  /// may hold separators, doubled quotes and line ends. Throws InputError for a quote that does not
  /// end.
  std::optional<std::vector<std::string>> next();
  uint64_t line() const { return line_; }  ///< the line where that row begins, from 1
  /// A comma, or a semicolon if that comes first in the first row, outside quotes.
  char separator() const { return separator_; }

 private:
  bool read_cell(std::string& cell);
  bool separates(int c);
  bool skip_comment();
  std::istream& text_;
  char comment_;
  uint64_t line_ = 0, lines_read_ = 0;
  char separator_ = ',';
  bool is_decided_ = false;  // the first separator, or the end of the first row, was read
};

}  // namespace vkh
