// Comma-separated values (RFC 4180), as spreadsheets write them: where the comma is the decimal
// point, by semicolons.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace vkh {

class CsvReader {
 public:
  explicit CsvReader(std::istream& text) : text_(text) {}
  /// The next row that is not empty; none at the end. Cells in quotes may hold separators, doubled
  /// quotes and line ends. Throws InputError for a quote that does not end.
  std::optional<std::vector<std::string>> next();
  uint64_t line() const { return line_; }  ///< the line where that row begins, from 1
  /// A comma, or a semicolon if that comes first in the first row, outside quotes.
  char separator() const { return separator_; }

 private:
  bool read_cell(std::string& cell);
  bool separates(int c);
  std::istream& text_;
  uint64_t line_ = 0, lines_read_ = 0;
  char separator_ = ',';
  bool is_decided_ = false;  // the first separator, or the end of the first row, was read
};

}  // namespace vkh
