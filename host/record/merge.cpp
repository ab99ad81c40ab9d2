#include "host/record/merge.h"

#include <fstream>

#include "host/base/error.h"
#include "host/system/system.h"

namespace vkh {
namespace {

bool is_failure(ExitCode code) { return code == kExitUsage || code > kExitNotClosed; }

}  // namespace

void Results::add(const std::string& path) {
  std::ifstream file(path_of(path), std::ios::binary);
  if (!file) throw InputError(path + ": cannot be read; expected a batch's results");
  std::map<std::string, Place> of_file;
  uint64_t at = 0, number = 0;
  for (std::string line; std::getline(file, line) && !file.eof(); at += line.size() + 1) {
    ++number;
    try {
      const Record record = read_record(line);
      of_file[record.name.id] = {.file = files_.size(),
                                 .begin = at,
                                 .size = line.size(),
                                 .key = record.name.key,
                                 .code = record.code,
                                 .width = record.upper - record.lower};
    } catch (const InputError& error) {
      throw InputError(path + ": line " + std::to_string(number) + ": " + error.what());
    }
  }
  if (file.bad()) throw InputError(path + ": cannot be read");
  files_.push_back(path);
  put(of_file);
}

void Results::put(const std::map<std::string, Place>& of_file) {
  for (const auto& [id, place] : of_file) {
    const auto [known, is_new] = places_.try_emplace(id, place);
    if (is_new) continue;
    Place& older = known->second;
    if (older.key != place.key && is_failure(older.code) == is_failure(place.code))
      throw InputError(files_[place.file] + ": '" + id + "' has other inputs or options than in " +
                       files_[older.file]);
    if (is_better(place, older)) older = place;
  }
}

// The same whatever the files' order.
bool Results::is_better(const Place& x, const Place& y) const {
  if (is_failure(x.code) != is_failure(y.code)) return is_failure(y.code);
  if (x.code != y.code) return worse(x.code, y.code) == y.code;
  if (x.width != y.width) return x.width < y.width;
  return text_of(x) < text_of(y);
}

std::string Results::text_of(const Place& place) const {
  std::ifstream file(path_of(files_[place.file]), std::ios::binary);
  std::string text(place.size, '\0');
  file.seekg(static_cast<std::streamoff>(place.begin));
  if (!file.read(text.data(), static_cast<std::streamsize>(text.size())))
    throw InputError(files_[place.file] + ": cannot be read any more");
  return text;
}

void Results::for_each(
    const std::function<void(const Record&, const std::string& line)>& take) const {
  for (const auto& [id, place] : places_) {
    const std::string line = text_of(place);
    take(read_record(line), line);
  }
}

}  // namespace vkh
