#include "host/read/point_columns.h"

#include <algorithm>
#include <cctype>
#include <span>

#include "host/base/blanks.h"
#include "host/base/parse_number.h"

namespace vkh {
namespace {

// The names that writers give x, without signs, blanks and units; y and z likewise. ParaView
// numbers axes.
constexpr std::array<std::string_view, 10> kAxis = {
    "@",      "coord@",  "@coord", "coordinate@", "@coordinate",
    "point@", "points@", "pos@",   "position@",   "@pos"};
constexpr std::array<std::string_view, 6> kUnits = {"um", "mm", "cm", "m", "in", "ft"};

// Words that name a column which is no coordinate. Another word of a comment may name one, or be a
// part of a sentence.
constexpr std::array<std::string_view, 44> kKnown = {
    "id",    "pointid",    "point3did", "ptid",  "index",      "idx",   "no",
    "nr",    "num",        "number",    "name",  "label",      "class", "classification",
    "code",  "time",       "timestamp", "t",     "gpstime",    "scan",  "ring",
    "r",     "g",          "b",         "a",     "red",        "green", "blue",
    "alpha", "intensity",  "i",         "nx",    "ny",         "nz",    "rgb",
    "error", "range",      "return",    "angle", "reflection", "rf",    "gf",
    "bf",    "reflectance"};

// Names of other coordinates: angles, or axes that may be meant in another order.
constexpr std::array<std::string_view, 12> kPlaces = {
    "lat",      "latitude", "lon",   "long",     "longitude", "easting",
    "northing", "east",     "north", "eastings", "northings", "altitude"};

template <size_t kCount>
bool has(const std::array<std::string_view, kCount>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string_view unquoted(std::string_view cell) {
  const bool is_quoted = cell.size() > 1 && cell.front() == '"' && cell.back() == '"';
  return is_quoted ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

// Letters and digits, in lower case, before a unit in brackets.
std::string letters_of(std::string_view name) {
  const size_t bracket = name.find_first_of("([");
  if (bracket != 0) name = name.substr(0, bracket);
  std::string letters;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || byte >= 0x80) letters += static_cast<char>(std::tolower(byte));
  }
  return letters;
}

// Whether the name is the pattern with the axis' letter, or ParaView's number, in place of @,
// perhaps with a unit behind it.
bool is_axis(std::string_view name, std::string_view pattern, int axis) {
  const size_t at = pattern.find('@');
  const std::string_view before = pattern.substr(0, at), behind = pattern.substr(at + 1);
  if (name.size() <= at || !name.starts_with(before)) return false;
  const bool is_letter = name[at] == "xyz"[axis];
  const bool is_number = pattern == "points@" && name[at] == "012"[axis];
  if (!is_letter && !is_number) return false;
  const std::string_view rest = name.substr(at + 1);
  return rest == behind || (rest.starts_with(behind) && has(kUnits, rest.substr(behind.size())));
}

// Cuts off a comment, which begins at a # that begins a word outside quotes.
std::string_view without_comment(std::string_view row) {
  bool is_quoted = false;
  size_t from = 0;
  for (size_t at = row.find('#'); at != std::string_view::npos; at = row.find('#', at + 1)) {
    for (; from < at; ++from) is_quoted = is_quoted != (row[from] == '"');
    if (!is_quoted && (at == 0 || is_space(row[at - 1]))) return row.substr(0, at);
  }
  return row;
}

}  // namespace

PointCells::PointCells(std::string_view row, char separator)
    : rest_(trimmed(without_comment(row))), separator_(separator) {}

std::optional<std::string_view> PointCells::next() {
  if (rest_.empty()) return std::nullopt;
  bool is_quoted = false;
  size_t end = 0;
  for (; end < rest_.size(); ++end) {
    const char c = rest_[end];
    if (c == '"') is_quoted = !is_quoted;
    if (!is_quoted && (separator_ == ' ' ? is_space(c) : c == separator_)) break;
  }
  const std::string_view cell = trimmed(rest_.substr(0, end));
  rest_ = rest_.substr(std::min(end + 1, rest_.size()));
  if (separator_ == ' ') rest_ = trimmed(rest_);
  return unquoted(cell);
}

size_t PointCells::count_rest() {
  size_t count = 0;
  while (next()) ++count;
  return count;
}

std::optional<std::string_view> comment_in(std::string_view line) {
  line = trimmed(line);
  if (!line.starts_with('#') && !line.starts_with("//") && !line.starts_with(';'))
    return std::nullopt;
  const size_t text = line.find_first_not_of("#/;!* \t");
  return line.substr(std::min(text, line.size()));
}

ColumnNames::Name ColumnNames::name_of(std::string_view text) {
  double number = 0;
  if (parse_number(text, number)) return Name::kNumber;
  if (text.find("[]") != std::string_view::npos) return Name::kList;
  const std::string letters = letters_of(text);
  for (const int axis : {0, 1, 2}) {
    for (const std::string_view pattern : kAxis) {
      if (is_axis(letters, pattern, axis)) return static_cast<Name>(axis);
    }
  }
  if (has(kPlaces, letters)) return Name::kPlace;
  return has(kKnown, letters) ? Name::kKnown : Name::kUnknown;
}

ColumnNames::Names ColumnNames::names_between(std::string_view text, char separator) {
  Names names;
  PointCells cells(text, separator);
  while (const auto cell = cells.next()) {
    if (separator != ' ' || !letters_of(*cell).empty() || cell->find('[') != cell->npos)
      names.push_back(name_of(*cell));
  }
  return names;
}

// In a comment, a label such as "columns:" before the names is no name, nor is an explanation
// behind a colon.
ColumnNames::ColumnNames(std::string_view text, From from, size_t line) : from_(from), line_(line) {
  const size_t colon = text.find(": ");
  if (from == From::kComment && colon != std::string_view::npos) {
    names_ = names_between(text.substr(0, colon), ' ');
    text = std::any_of(names_.begin(), names_.end(), is_axis_name) ? text.substr(0, colon)
                                                                   : text.substr(colon + 1);
  }
  for (const char separator : {';', ',', '\t'}) {
    if (text.find(separator) == std::string_view::npos) continue;
    names_ = names_between(text, separator);
    separator_ = separator;
    if (has_axes()) return;
  }
  std::string words(text);
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
  names_ = names_between(words, ' ');
  separator_ = ' ';
}

void ColumnNames::Readings::add(const std::array<size_t, 3>& axes) {
  are_several = are_several || (first && *first != axes);
  first = axes;
}

bool ColumnNames::has_axes() const {
  const auto holds = [&](Name name) {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
  };
  return holds(Name::kX) && holds(Name::kY) && holds(Name::kZ);
}

bool ColumnNames::is_axis_name(Name name) { return name <= Name::kZ; }

bool ColumnNames::is_title() const {
  return names_.size() < 3 && std::none_of(names_.begin(), names_.end(), [](Name name) {
           return is_axis_name(name) || name == Name::kPlace;
         });
}

bool ColumnNames::names_others() const {
  return !has_axes() && std::count(names_.begin(), names_.end(), Name::kPlace) > 1 &&
         std::count(names_.begin(), names_.end(), Name::kNumber) == 0;
}

bool ColumnNames::has_neighbouring_axes() const {
  for (size_t i = 0; i + 2 < names_.size(); ++i) {
    if (std::all_of(&names_[i], &names_[i] + 3, is_axis_name)) return true;
  }
  return false;
}

// Adds the places of x, y and z in each run of as many names as there are columns. If there are
// fewer names, they belong to the first columns. Counts what enters and leaves a run: lines may be
// long.
void ColumnNames::add_readings(std::span<const Name> names, size_t count, Readings& readings) {
  constexpr std::array kInOrder = {Name::kX, Name::kY, Name::kZ};
  if (names.size() < count) {
    if (names.size() >= 3 && std::equal(kInOrder.begin(), kInOrder.end(), names.begin()))
      readings.add({0, 1, 2});
    return;
  }
  std::array<size_t, 3> times{}, places{};
  for (size_t end = 0; end < names.size() && !readings.are_several; ++end) {
    if (is_axis_name(names[end])) {
      ++times[static_cast<size_t>(names[end])];
      places[static_cast<size_t>(names[end])] = end;
    }
    if (end + 1 < count) continue;
    const size_t begin = end + 1 - count;
    if (times == std::array<size_t, 3>{1, 1, 1})
      readings.add({places[0] - begin, places[1] - begin, places[2] - begin});
    if (is_axis_name(names[begin])) --times[static_cast<size_t>(names[begin])];
  }
}

// The places of x, y and z by the names before a list: a row is as long as its list.
PointColumns ColumnNames::columns_before_list(size_t list, size_t count) const {
  Readings readings;
  if (list <= count) add_readings(std::span(names_).first(list), list, readings);
  if (!readings.first) throw UnclearColumns();
  return {.count = list, .may_be_longer = true, .are_named = true, .axes = *readings.first};
}

// A comment may be a sentence: words before x that are no names may belong to no column. Only one
// reading may be possible.
std::optional<PointColumns> ColumnNames::columns(size_t count) const {
  const auto number = std::find(names_.begin(), names_.end(), Name::kNumber);
  if (!is_heading() && (!has_axes() || number != names_.end())) return std::nullopt;
  const auto list = std::find(names_.begin(), names_.end(), Name::kList);
  if (list != names_.end())
    return columns_before_list(static_cast<size_t>(list - names_.begin()), count);
  const bool may_be_words = !is_heading() && separator_ == ' ';
  const auto axis = std::find_if(names_.begin(), names_.end(), is_axis_name);
  Readings readings;
  add_readings(names_, count, readings);
  if (may_be_words && std::count(names_.begin(), axis, Name::kUnknown) > 0)
    add_readings(std::span(axis, names_.end()), count, readings);
  if (!readings.first && !is_heading() && !has_neighbouring_axes()) return std::nullopt;
  if (!readings.first || readings.are_several) throw UnclearColumns();
  const bool are_names =
      !may_be_words || std::count(names_.begin(), names_.end(), Name::kUnknown) == 0;
  return PointColumns{
      .count = count, .are_named = are_names && names_.size() == count, .axes = *readings.first};
}

std::string example_heading(size_t columns, char separator, bool with_number) {
  constexpr size_t kMost = 7;
  std::string text = with_number ? "id" : "x";
  for (size_t i = 1; i < std::clamp(columns, size_t{3}, kMost); ++i) {
    text += separator;
    const size_t name = i - (with_number ? 1 : 0);
    text += name < 3 ? "xyz"[name] : static_cast<char>('a' + (name - 3));
  }
  return text + (columns > kMost ? std::string(1, separator) + "..." : "");
}

}  // namespace vkh
