#include "host/answer/csv.h"

#include <algorithm>
#include <cmath>

#include "vkhausdorff/error.h"

namespace vkh {
namespace {

// Quotes the cell if it has to.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

}  // namespace

std::string csv_line(const std::vector<std::string>& cells, const char* end) {
  std::string line;
  for (const std::string& text : cells) line += (&text == cells.data() ? "" : ",") + cell(text);
  return line + end;
}

std::string csv_bound(double value, Rounding rounding) {
  return std::isfinite(value) ? decimal(value, kJsonDigits, rounding) : "";
}

bool CsvReader::separates(int c) {
  if (!is_decided_ && (c == ',' || c == ';')) {
    separator_ = static_cast<char>(c);
    is_decided_ = true;
  }
  return c == separator_;
}

// Returns true if the row goes on after the cell.
bool CsvReader::read_cell(std::string& cell) {
  bool was_quoted = false, is_within = false;
  for (int c; (c = text_.get()) != std::istream::traits_type::eof();) {
    if (c == '\n') ++lines_read_;
    if (is_within && c == '"' && text_.peek() == '"') {
      cell += static_cast<char>(text_.get());
    } else if (is_within && c == '"') {
      is_within = false;
    } else if (c == '"' && !was_quoted && cell.find_first_not_of(" \t") == std::string::npos) {
      cell.clear();
      was_quoted = is_within = true;
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

bool CsvReader::skip_comment() {
  if (comment_ == '\0') return false;
  while (text_.peek() == ' ' || text_.peek() == '\t') text_.get();
  if (text_.peek() != comment_) return false;
  std::string line;
  std::getline(text_, line);
  ++lines_read_;
  return true;
}

std::optional<std::vector<std::string>> CsvReader::next() {
  while (text_.peek() != std::istream::traits_type::eof()) {
    if (skip_comment()) continue;
    line_ = lines_read_ + 1;
    std::vector<std::string> row;
    bool goes_on = true;
    while (goes_on) goes_on = read_cell(row.emplace_back());
    if (std::all_of(row.begin(), row.end(), [](const auto& cell) { return cell.empty(); }))
      continue;
    is_decided_ = true;
    return row;
  }
  return std::nullopt;
}

}  // namespace vkh
