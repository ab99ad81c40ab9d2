#include "host/answer/csv.h"

#include "vkhausdorff/error.h"

namespace vkh {

bool CsvReader::separates(int c) {
  if (!is_decided_ && (c == ',' || c == ';')) {
    separator_ = static_cast<char>(c);
    is_decided_ = true;
  }
  return c == separator_;
}

// Returns true if the row goes on after the cell.
bool CsvReader::read_cell(std::string& cell) {
  const bool is_quoted = text_.peek() == '"';
  if (is_quoted) text_.get();
  bool is_within = is_quoted;
  for (int c; (c = text_.get()) != std::istream::traits_type::eof();) {
    if (c == '\n') ++lines_read_;
    if (is_within && c == '"' && text_.peek() == '"') {
      cell += static_cast<char>(text_.get());
    } else if (is_within && c == '"') {
      is_within = false;
    } else if (!is_within && separates(c)) {
      return true;
    } else if (!is_within && c == '\n') {
      if (cell.ends_with('\r')) cell.pop_back();
      return false;
    } else {
      cell += static_cast<char>(c);
    }
  }
  if (is_within) throw InputError("a quote does not end");
  if (cell.ends_with('\r')) cell.pop_back();
  return false;
}

std::optional<std::vector<std::string>> CsvReader::next() {
  while (text_.peek() != std::istream::traits_type::eof()) {
    line_ = lines_read_ + 1;
    std::vector<std::string> row;
    bool goes_on = true;
    while (goes_on) goes_on = read_cell(row.emplace_back());
    if (row.size() == 1 && row[0].empty()) continue;
    is_decided_ = true;
    return row;
  }
  return std::nullopt;
}

}  // namespace vkh
