#include "host/batch/list.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <unordered_map>

#include "host/base/error.h"
#include "host/base/text_scanner.h"
#include "host/record/csv.h"
#include "host/system/system.h"

namespace vkh {
namespace {

constexpr const char* kExpected = "id, a, b and perhaps tol, max, unit, symmetric";

bool truth_of(const std::string& text) {
  if (text == "true" || text == "1" || text == "yes") return true;
  if (text == "false" || text == "0" || text == "no") return false;
  throw InputError("'" + text + "': expected true or false for symmetric");
}

/// False: a batch knows no such member.
bool put(Entry& entry, const std::string& name, const std::string& text) {
  constexpr std::array kNames{"id", "a", "b", "tol", "max", "unit"};
  const std::array<std::string*, 6> places{&entry.id,        &entry.a,   &entry.b,
                                           &entry.tolerance, &entry.max, &entry.unit};
  for (size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i]) return *places[i] = text, true;
  }
  if (name != "symmetric") return false;
  if (!text.empty()) entry.symmetric = truth_of(text);
  return true;
}

/// What is collected while a list is read.
class Collected {
 public:
  explicit Collected(std::string path)
      : path_(std::move(path)), folder_(path_of(path_).parent_path()) {}

  void take(Entry entry, uint64_t line) {
    for (const auto& [name, text] :
         {std::pair{"id", &entry.id}, {"a", &entry.a}, {"b", &entry.b}}) {
      if (text->empty()) refuse(line, std::string("no ") + name + "; expected " + kExpected);
    }
    const auto [known, is_new] = lines_.emplace(entry.id, line);
    if (!is_new)
      refuse(line, "the id '" + entry.id + "' is that of line " + std::to_string(known->second));
    entry.file_a = name_of(folder_ / path_of(entry.a));
    entry.file_b = name_of(folder_ / path_of(entry.b));
    list.entries.push_back(std::move(entry));
  }
  void note_stranger(const std::string& name) {
    if (strangers_.insert(name).second)
      list.notes.push_back(path_ + ": '" + name + "' is not used; a batch knows " + kExpected);
  }
  [[noreturn]] void refuse(uint64_t line, const std::string& what) const {
    throw InputError(path_ + ": line " + std::to_string(line) + ": " + what);
  }

  PairList list;

 private:
  std::string path_;
  std::filesystem::path folder_;
  std::unordered_map<std::string, uint64_t> lines_;
  std::set<std::string> strangers_;
};

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
  if ((*heading)[0].starts_with("\xef\xbb\xbf")) (*heading)[0].erase(0, 3);  // spreadsheets' mark
  while (const auto row = next()) {
    if (row->size() != heading->size())
      to.refuse(rows.line(), std::to_string(row->size()) + " cells; expected " +
                                 std::to_string(heading->size()) + ", as the heading has");
    Entry entry;
    for (size_t i = 0; i < row->size(); ++i) {
      try {
        if (!put(entry, (*heading)[i], (*row)[i])) to.note_stranger((*heading)[i]);
      } catch (const InputError& error) {
        to.refuse(rows.line(), error.what());
      }
    }
    to.take(std::move(entry), rows.line());
  }
}

// Numbers and truths may be written as such.
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
      to.refuse(number, std::string("no JSON object; expected one with ") + kExpected);
    Entry entry;
    for (const auto& [name, value] : json.items()) {
      if (value.is_structured()) {
        to.note_stranger(name);
        continue;
      }
      try {
        if (!put(entry, name, text_of(value))) to.note_stranger(name);
      } catch (const InputError& error) {
        to.refuse(number, error.what());
      }
    }
    to.take(std::move(entry), number);
  }
}

}  // namespace

PairList read_list(const std::string& path) {
  std::ifstream file(path_of(path), std::ios::binary);
  if (!file) throw InputError(path + ": cannot be read; expected a list of pairs");
  Collected collected(path);
  std::string ending = path.substr(std::min(path.size(), path.find_last_of('.')));
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".csv") {
    read_csv(file, collected);
  } else {
    read_jsonl(file, collected);
  }
  if (file.bad()) throw InputError(path + ": cannot be read");
  if (collected.list.entries.empty())
    throw InputError(path + ": line 1: no pair; expected " + kExpected);
  return std::move(collected.list);
}

PairList list_against(const std::string& b, const std::vector<std::string>& parts) {
  PairList list;
  std::set<std::string> ids;
  for (const std::string& part : parts) {
    if (!ids.insert(part).second) throw UsageError("'" + part + "' is named twice");
    list.entries.push_back({.id = part,
                            .a = part,
                            .b = b,
                            .file_a = part,
                            .file_b = b,
                            .tolerance = {},
                            .max = {},
                            .unit = {},
                            .symmetric = {}});
  }
  return list;
}

bool Shard::has(const std::string& id) const {
  uint64_t hash = 0xcbf29ce484222325;
  for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  hash = (hash ^ (hash >> 33)) * 0xff51afd7ed558ccd;  // MurmurHash3's finalizer
  return (hash ^ (hash >> 33)) % count == index;
}

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
