#include "host/job/face_limits.h"

#include <cstdint>
#include <fstream>

#include "host/base/error.h"
#include "host/base/text_scanner.h"
#include "host/system/system.h"

namespace vkh {
namespace {

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

Limit limit_of(const std::string& word, const std::string& file_unit, double diagonal_a) {
  double number = 0;
  const std::string text = parse_number(word, number) ? word + "abs" : word;
  return in_files(parse_length("max", text, PlainNumber::kRefused), "max", file_unit, diagonal_a);
}

}  // namespace

std::vector<Limit> read_face_limits(const std::string& path, size_t face_count,
                                    const Limit& otherwise, const std::string& file_unit,
                                    double diagonal_a) {
  std::ifstream file(path_of(path), std::ios::binary);
  if (!file) throw InputError(path + ": byte 0: cannot be read; expected a CSV of face, max");
  std::vector<Limit> limits(face_count, otherwise);
  std::vector<bool> named(face_count);
  uint64_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    line = trimmed(line);
    const size_t comma = line.find(',');
    if (line.empty() || line[0] == '#') continue;
    const std::string place = "line " + std::to_string(number);
    const std::string word = trimmed(line.substr(0, comma));
    const std::string max = comma == std::string::npos ? "" : trimmed(line.substr(comma + 1));
    if (number == 1 && word == "face" && max == "max") continue;
    uint64_t face = 0;
    if (!parse_number(word, face) || face >= face_count)
      reject(path, place, vkh::quoted(word), "a face from 0 to " + std::to_string(face_count - 1));
    if (named[face]) reject(path, place, "face " + word + " once more", "each face once");
    named[face] = true;
    try {
      limits[face] = limit_of(max, file_unit, diagonal_a);
    } catch (const UsageError& error) {
      reject(path, place, vkh::quoted(max), std::string("face, max; ") + error.what());
    }
  }
  if (file.bad()) throw InputError(path + ": line " + std::to_string(number) + ": cannot be read");
  return limits;
}

}  // namespace vkh
