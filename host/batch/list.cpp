#include "host/batch/list.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <unordered_map>

#include "host/answer/csv.h"
#include "host/answer/json_text.h"
#include "host/answer/name_meant.h"
#include "host/answer/option_values.h"
#include "host/base/byte_order_mark.h"
#include "host/base/id_hash.h"
#include "host/base/meant.h"
#include "host/base/reject.h"
#include "host/base/system.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

/// A column that each row has.
struct NamedColumn {
  const char* name;
  std::string Entry::*text;
};
constexpr std::array kNeeded{NamedColumn{"id", &Entry::id}, NamedColumn{"a", &Entry::a},
                             NamedColumn{"b", &Entry::b}};

std::string Entry::*needed(const std::string& name) {
  const auto* const found = std::find_if(kNeeded.begin(), kNeeded.end(),
                                         [&](const NamedColumn& c) { return name == c.name; });
  return found == kNeeded.end() ? nullptr : found->text;
}

/// Returns the column that an unknown name may mean; else nothing.
std::string meant_by(const std::string& name) {
  std::vector<KnownName> known;
  known.reserve(kNeeded.size() + options().size());
  for (const NamedColumn& column : kNeeded) known.push_back({.name = column.name});
  for (const Option& option : options()) {
    if (!option.is_column) continue;
    const bool has_unit = option.kind == Kind::kLength || option.kind == Kind::kTolerance;
    known.push_back({column_name(option), option.also, has_unit});
  }
  return name_meant(name, known);
}

/// Returns false for a member that a batch does not know.
bool put(Entry& entry, const std::string& name, const std::string& text) {
  if (const auto member = needed(name); member != nullptr) {
    entry.*member = text;
    return true;
  }
  const Option* option = column_of(name);
  if (option == nullptr || text.empty()) return option != nullptr;
  if (option->kind == Kind::kFlag) check_truth(name, text);
  entry.options.emplace_back(option, text);
  return true;
}

bool is_named_csv(std::string path) {
  std::transform(path.begin(), path.end(), path.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return path.ends_with(".csv");
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
    for (const NamedColumn& column : kNeeded) {
      if ((entry.*column.text).empty())
        refuse(line, std::string("no ") + column.name + "; expected " + list_columns());
    }
    // A result could not hold such an id: two of them might become one there.
    if (!is_utf8(entry.id)) refuse(line, "the id '" + entry.id + "' is no UTF-8");
    const auto [known, is_new] = lines_.emplace(entry.id, line);
    if (!is_new)
      refuse(line, "the id '" + entry.id + "' is that of line " + std::to_string(known->second));
    entry.file_a = name_of(folder_ / path_of(entry.a));
    entry.file_b = name_of(folder_ / path_of(entry.b));
    for (auto& [option, text] : entry.options) {
      if (option->kind == Kind::kInput) text = name_of(folder_ / path_of(text));
    }
    list.entries.push_back(std::move(entry));
  }
  /// Refuses a name that is nearly a known one: a limit that is ignored would give no verdict.
  void note_stranger(const std::string& name, uint64_t line) {
    const std::string meant = meant_by(name);
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
  return needed(name) != nullptr || column_of(name) != nullptr;
}

// Requires each of the three columns once, and no name that nearly is a column's.
void check_heading(const std::vector<std::string>& heading, uint64_t line, Collected& to) {
  for (const std::string& name : heading) {
    if (!is_column(name)) to.note_stranger(name, line);
  }
  for (const NamedColumn& column : kNeeded) {
    const char* const name = column.name;
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
  const Option* option = column_of(name);
  const bool is_length =
      option != nullptr && (option->kind == Kind::kLength || option->kind == Kind::kTolerance);
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
  for (const NamedColumn& column : kNeeded)
    text.append(text.empty() ? "" : ", ").append(column.name);
  const char* between = " and perhaps ";
  for (const Option& option : options()) {
    if (option.is_column) text.append(std::exchange(between, ", ")).append(column_name(option));
  }
  return text;
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
  if (is_named_csv(path)) {
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

bool is_in(const PartOf& shard, const std::string& id) {
  return hash_of_id(id) % shard.count == shard.index;
}

}  // namespace vkh
