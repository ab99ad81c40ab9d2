#include "host/batch/list.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <unordered_map>

#include "host/answer/csv.h"
#include "host/base/byte_order_mark.h"
#include "host/base/closest_name.h"
#include "host/base/id_hash.h"
#include "host/base/meant.h"
#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/base/system.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

/// A member of a list's row: its name, and the member of Entry that takes it, as text or as a
/// truth.
struct Column {
  const char* name;
  std::string Entry::*text = nullptr;
  std::optional<bool> Entry::*truth = nullptr;
};
constexpr std::array kColumns{Column{"id", &Entry::id},
                              Column{"a", &Entry::a},
                              Column{"b", &Entry::b},
                              Column{"tol", &Entry::tolerance},
                              Column{"max", &Entry::max},
                              Column{"unit", &Entry::unit},
                              Column{"unit_a", &Entry::unit_a},
                              Column{"unit_b", &Entry::unit_b},
                              Column{"transform", &Entry::transform},
                              Column{"align", nullptr, &Entry::align},
                              Column{"points", &Entry::points},
                              Column{"symmetric", nullptr, &Entry::symmetric},
                              Column{"signed", nullptr, &Entry::is_signed}};
constexpr size_t kNeeded = 3;  // the first ones

std::string lower_word(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// A name that people give to a column, in lower case and without blanks, and ours.
struct Synonym {
  const char* name;
  const char* meant;
};
constexpr std::array kSynonyms{Synonym{"limit", "max"},          Synonym{"maximum", "max"},
                               Synonym{"threshold", "max"},      Synonym{"maxdistance", "max"},
                               Synonym{"maxdeviation", "max"},   Synonym{"tolerance", "max or tol"},
                               Synonym{"bothways", "symmetric"}, Synonym{"matrix", "transform"},
                               Synonym{"sign", "signed"},        Synonym{"aligned", "align"},
                               Synonym{"pointcloud", "points"}};

/// Leaves the letters and digits of a name, in lower case.
std::string letters_of(const std::string& name) {
  std::string letters = lower_word(name);
  std::erase_if(letters, [](char c) {
    return std::string_view(" \t_-.()[]:").find(c) != std::string_view::npos;
  });
  return letters;
}

/// A length's column with its unit, such as "max (mm)".
bool is_with_unit(const std::string& letters, const std::string& column) {
  if (!letters.starts_with(column) || (column != "max" && column != "tol")) return false;
  const std::string unit = letters.substr(column.size());
  return !unit.empty() && unit_meant(unit) == unit;
}

/// Returns the column that a name which is none may mean, such as max for Max, maxx and limit; else
/// nothing.
std::string column_meant(const std::string& name) {
  const std::string letters = letters_of(name);
  for (const Column& column : kColumns) {
    const std::string known = letters_of(column.name);
    if (letters == known || is_with_unit(letters, known)) return column.name;
  }
  for (const Synonym& synonym : kSynonyms) {
    if (letters == synonym.name) return synonym.meant;
  }
  // One letter too many at the end is a slip, of short names the only one: mat and map are not max,
  // nor is tool tol.
  std::vector<std::string> names;
  for (const Column& column : kColumns) {
    const std::string known = letters_of(column.name);
    if (known.size() >= 3 && letters.starts_with(known) && letters.size() == known.size() + 1)
      return column.name;
    if (known.size() > 3) names.push_back(known);
  }
  const std::vector<std::string> near = closest_names(letters, names, 1);
  const auto* const column = std::find_if(kColumns.begin(), kColumns.end(), [&](const Column& c) {
    return !near.empty() && letters_of(c.name) == near.front();
  });
  return column == kColumns.end() ? "" : column->name;
}

// Accepts TRUE too, as spreadsheets write it.
bool truth_of(const std::string& name, const std::string& text) {
  const std::string word = lower_word(text);
  if (word == "true" || word == "1" || word == "yes") return true;
  if (word == "false" || word == "0" || word == "no") return false;
  throw InputError("'" + text + "': expected true or false for " + name);
}

/// Returns false for a member that a batch does not know.
bool put(Entry& entry, const std::string& name, const std::string& text) {
  const auto* const column = std::find_if(kColumns.begin(), kColumns.end(),
                                          [&](const Column& c) { return name == c.name; });
  if (column == kColumns.end()) return false;
  if (column->text != nullptr) {
    entry.*column->text = text;
  } else if (!text.empty()) {
    entry.*column->truth = truth_of(name, text);
  }
  return true;
}

/// The folder that a list's names start from: a pipe's (/dev/fd/63) is not its writer's.
std::filesystem::path folder_of_list(const std::string& path) {
  std::error_code none;
  const bool is_pipe = std::filesystem::exists(path_of(path), none) &&
                       !std::filesystem::is_regular_file(path_of(path), none);
  return is_pipe ? std::filesystem::path() : path_of(path).parent_path();
}

/// The entries and notes that are collected while a list is read.
class Collected {
 public:
  explicit Collected(std::string path) : path_(std::move(path)), folder_(folder_of_list(path_)) {}

  void take(Entry entry, uint64_t line) {
    for (size_t i = 0; i < kNeeded; ++i) {
      if ((entry.*kColumns[i].text).empty())
        refuse(line, std::string("no ") + kColumns[i].name + "; expected " + list_columns());
    }
    // A result could not hold such an id: two of them might become one there.
    if (!is_utf8(entry.id)) refuse(line, "the id '" + entry.id + "' is no UTF-8");
    const auto [known, is_new] = lines_.emplace(entry.id, line);
    if (!is_new)
      refuse(line, "the id '" + entry.id + "' is that of line " + std::to_string(known->second));
    entry.file_a = name_of(folder_ / path_of(entry.a));
    entry.file_b = name_of(folder_ / path_of(entry.b));
    if (!entry.transform.empty()) entry.transform = name_of(folder_ / path_of(entry.transform));
    list.entries.push_back(std::move(entry));
  }
  /// Refuses a name that nearly is one of ours: a limit that is passed over gives no verdict.
  void note_stranger(const std::string& name, uint64_t line) {
    const std::string meant = column_meant(name);
    if (!meant.empty())
      refuse(line, "'" + name + "': did you mean " + meant + "? expected " + list_columns());
    if (strangers_.insert(name).second)
      list.notes.push_back(path_ + ": '" + name + "' is not used; a batch knows " + list_columns());
  }
  [[noreturn]] void refuse(uint64_t line, const std::string& what) const {
    throw InputError({.file = path_, .place = "line " + std::to_string(line), .problem = what});
  }

  PairList list;

 private:
  std::string path_;
  std::filesystem::path folder_;
  std::unordered_map<std::string, uint64_t> lines_;
  std::set<std::string> strangers_;
};

bool is_column(const std::string& name) {
  return std::any_of(kColumns.begin(), kColumns.end(),
                     [&](const Column& column) { return name == column.name; });
}

// Requires each of the three columns once, and no name that nearly is a column's.
void check_heading(const std::vector<std::string>& heading, uint64_t line, Collected& to) {
  for (const std::string& name : heading) {
    if (!is_column(name)) to.note_stranger(name, line);
  }
  for (size_t i = 0; i < kNeeded; ++i) {
    const char* const name = kColumns[i].name;
    const auto times = std::count(heading.begin(), heading.end(), name);
    if (times == 1) continue;
    to.refuse(line, std::string(times == 0 ? "no" : "more than one") + " column '" + name +
                        "'; expected a heading with " + list_columns() +
                        ", between commas or semicolons");
  }
}

/// Refuses a decimal comma, which spreadsheets write where they separate by semicolons: 1,000mm may
/// be one or a thousand. A comma before a sign is between limits of two sides.
void check_decimal_point(const std::string& name, const std::string& text, char separator) {
  const bool is_length = name == "tol" || name == "max";
  const size_t comma = text.find(',');
  if (separator != ';' || !is_length || comma == std::string::npos) return;
  const size_t behind = text.find_first_not_of(' ', comma + 1);
  const bool is_of_sides = comma == text.rfind(',') && behind != std::string::npos &&
                           (text[behind] == '+' || text[behind] == '-');
  if (is_of_sides) return;
  const std::string meant = length_meant(text);
  throw InputError(name + " '" + text +
                   "': " + (meant.empty() ? "" : "did you mean " + meant + "? ") +
                   "expected a decimal point");
}

void read_csv(std::istream& text, Collected& to) {
  CsvReader rows(text);
  std::optional<std::vector<std::string>> heading;
  const auto next = [&] {
    try {
      return rows.next();
    } catch (const InputError& error) {
      to.refuse(rows.line(), error.what());
    }
  };
  heading = next();
  if (!heading) return;
  check_heading(*heading, rows.line(), to);
  while (const auto row = next()) {
    if (row->size() != heading->size())
      to.refuse(rows.line(), std::to_string(row->size()) + " cells; expected " +
                                 std::to_string(heading->size()) + ", as the heading has");
    Entry entry;
    for (size_t i = 0; i < row->size(); ++i) {
      try {
        check_decimal_point((*heading)[i], (*row)[i], rows.separator());
        (void)put(entry, (*heading)[i], (*row)[i]);
      } catch (const InputError& error) {
        to.refuse(rows.line(), error.what());
      }
    }
    to.take(std::move(entry), rows.line());
  }
}

// Accepts numbers and truth values that are not quoted.
std::string text_of(const nlohmann::json& value) {
  if (value.is_null()) return "";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void read_jsonl(std::istream& text, Collected& to) {
  uint64_t number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (!json.is_object())
      to.refuse(number, std::string("no JSON object; expected one with ") + list_columns());
    Entry entry;
    for (const auto& [name, value] : json.items()) {
      if (value.is_structured()) {
        to.note_stranger(name, number);
        continue;
      }
      try {
        if (!put(entry, name, text_of(value))) to.note_stranger(name, number);
      } catch (const InputError& error) {
        to.refuse(number, error.what());
      }
    }
    to.take(std::move(entry), number);
  }
}

}  // namespace

std::string list_columns() {
  std::string text;
  for (size_t i = 0; i < kColumns.size(); ++i)
    text += (i == 0 ? "" : i == kNeeded ? " and perhaps " : ", ") + std::string(kColumns[i].name);
  return text;
}

bool is_utf8(const std::string& text) {
  try {
    (void)nlohmann::json(text).dump();
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

PairList read_list(const std::string& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path_of(path), none))
    throw UsageError("'" + path +
                     "' is a folder: expected a list of pairs; batch takes two folders whose "
                     "meshes have the same names");
  std::ifstream file(path_of(path), std::ios::binary);
  if (!file) reject(path, "", "cannot be read", "a list of pairs");
  Collected collected(path);
  skip_byte_order_mark(file, path);
  if (lower_word(path).ends_with(".csv")) {
    read_csv(file, collected);
  } else {
    read_jsonl(file, collected);
  }
  if (file.bad()) throw InputError({.file = path, .problem = "cannot be read"});
  if (collected.list.entries.empty()) reject(path, "line 1", "no pair", list_columns());
  return std::move(collected.list);
}

PairList list_against(const std::string& b, const std::vector<std::string>& parts) {
  PairList list;
  std::set<std::string> ids;
  for (const std::string& part : parts) {
    if (!ids.insert(part).second) throw UsageError("'" + part + "' is named twice");
    if (!is_utf8(part))
      throw UsageError("'" + part + "' is no UTF-8, as an id must be: name it in a list");
    Entry& entry = list.entries.emplace_back();
    entry.id = entry.a = entry.file_a = part;
    entry.b = entry.file_b = b;
  }
  return list;
}

bool Shard::has(const std::string& id) const { return hash_of_id(id) % count == index; }

Shard parse_shard(const std::string& text) {
  const size_t slash = text.find('/');
  Shard shard;
  const bool is_read = slash != std::string::npos &&
                       parse_number(text.substr(0, slash), shard.index) &&
                       parse_number(text.substr(slash + 1), shard.count);
  if (!is_read || shard.index >= shard.count)
    throw UsageError("--shard '" + text +
                     "': expected i/n with i from 0 and under n, such as 3/64");
  return shard;
}

}  // namespace vkh
