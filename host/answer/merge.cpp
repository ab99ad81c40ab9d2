#include "host/answer/merge.h"

#include <fstream>

#include "host/base/decimal.h"
#include "host/base/reject.h"
#include "host/base/system.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

bool is_failure(ExitCode code) { return code == kExitUsage || code > kExitNotClosed; }

std::string in_brackets(const auto& bounds) {
  return "[" + decimal(bounds.lower, 7, Rounding::kDown) + ", " +
         decimal(bounds.upper, 7, Rounding::kUp) + "]";
}

}  // namespace

void Results::add(const std::string& path) {
  std::ifstream file(path_of(path), std::ios::binary);
  if (!file) reject(path, "", "cannot be read", "a batch's results");
  std::map<std::string, Place> of_file;
  uint64_t at = 0, number = 0;
  for (std::string line; std::getline(file, line) && !file.eof(); at += line.size() + 1) {
    ++number;
    try {
      const Result result = read_result(line);
      const Place place = place_of(result, files_.size(), at, line.size());
      const auto [known, is_new] = of_file.try_emplace(result.name.id, place);
      const std::string wrong = is_new ? "" : contradiction(place, known->second, path);
      if (!wrong.empty()) throw InputError("'" + result.name.id + "': " + wrong);
      known->second = place;
    } catch (const InputError& error) {
      throw InputError(
          {.file = path, .place = "line " + std::to_string(number), .problem = error.what()});
    }
  }
  if (file.bad()) throw InputError({.file = path, .problem = "cannot be read"});
  files_.push_back(path);
  put(of_file);
}

Results::Place Results::place_of(const Result& result, size_t file, uint64_t begin, uint64_t size) {
  const Answer& answer = result.answer;
  const CertifiedInterval whole = interval_of(answer);
  return {
      .file = file,
      .begin = begin,
      .size = size,
      .key = result.name.key,
      .code = result.code,
      .is_answer = result.has_answer(),
      .names_files = result.names_files(),
      .bounds = {Bounds{whole.lower, whole.upper},
                 {answer.a_to_b.lower, answer.a_to_b.upper},
                 answer.b_to_a ? Bounds{answer.b_to_a->lower, answer.b_to_a->upper} : Bounds{}}};
}

std::string Results::contradiction(const Place& place, const Place& older,
                                   const std::string& file) {
  if (place.key != older.key || !place.is_answer || !older.is_answer) return "";
  for (size_t i = 0; i < place.bounds.size(); ++i) {
    const Bounds &here = place.bounds[i], &there = older.bounds[i];
    if (!here.meets(there))
      return "the interval " + in_brackets(here) + " does not meet the " + in_brackets(there) +
             " of a line of " + file + " with the same key: one of both is wrong";
  }
  return "";
}

void Results::check_same(const std::string& id, const Place& older, const Place& place) const {
  const std::string& file = files_[place.file];
  if (is_failure(older.code) != is_failure(place.code)) return;
  if (older.key != place.key)
    throw InputError(
        {.file = file,
         .problem = "'" + id + "' has other inputs or options than in " + files_[older.file]});
  const bool is_of_all = !place.key.empty() && older.names_files && place.names_files;
  if (place.is_answer && older.is_answer && !is_of_all)
    throw InputError(
        {.file = file,
         .problem = "'" + id + "' is in " + files_[older.file] +
                    ", too, and nothing tells that both are of the same files: expected keys of "
                    "all files that were read, as batch writes since 0.2.0 where it has SHA-256"});
  const std::string wrong = contradiction(place, older, files_[older.file]);
  if (!wrong.empty()) throw InputError({.file = file, .problem = "'" + id + "': " + wrong});
}

void Results::put(const std::map<std::string, Place>& of_file) {
  for (const auto& [id, place] : of_file) {
    const auto [known, is_new] = places_.try_emplace(id, place);
    if (is_new) continue;
    Place& older = known->second;
    check_same(id, older, place);
    if (is_better(place, older)) older = place;
  }
}

// Gives the same order for any order of the files.
bool Results::is_better(const Place& x, const Place& y) const {
  if (is_failure(x.code) != is_failure(y.code)) return is_failure(y.code);
  if (x.code != y.code) return worse(x.code, y.code) == y.code;
  if (x.width() != y.width()) return x.width() < y.width();
  return text_of(x) < text_of(y);
}

std::string Results::text_of(const Place& place) const {
  std::ifstream file(path_of(files_[place.file]), std::ios::binary);
  std::string text(place.size, '\0');
  file.seekg(static_cast<std::streamoff>(place.begin));
  if (!file.read(text.data(), static_cast<std::streamsize>(text.size())))
    throw InputError({.file = files_[place.file], .problem = "cannot be read any more"});
  return text;
}

void Results::for_each(
    const std::function<void(const Result&, const std::string& line)>& take) const {
  for (const auto& [id, place] : places_) {
    const std::string line = text_of(place);
    take(read_result(line), line);
  }
}

}  // namespace vkh
