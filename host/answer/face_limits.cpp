#include "host/answer/face_limits.h"

#include <cmath>
#include <cstdint>
#include <fstream>

#include "host/base/byte_order_mark.h"
#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/base/system.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace vkh {
namespace {

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

Limit limit_of(const std::string& word, const std::string& file_unit, const Diagonal& of_a) {
  double number = 0;
  const std::string text = parse_number(word, number) ? word + "abs" : word;
  return limit_in_files(parse_length("max", text, PlainNumber::kRefused), "max", file_unit, of_a);
}

/// The faces' property `max`: a length in the files' unit, as the file has it.
std::vector<Limit> limits_in_ply(const std::string& path, uint64_t face_count) {
  const std::vector<double> values = read_face_property(path_of(path), "max");
  if (values.size() != face_count)
    reject(path, "element face", std::to_string(values.size()) + " faces",
           "those of the mesh, " + std::to_string(face_count));
  std::vector<Limit> limits;
  limits.reserve(values.size());
  for (const double value : values) {
    if (!(value > 0 && std::isfinite(value)))
      reject(path, "face " + std::to_string(limits.size()), "max is not positive and finite",
             "a length");
    limits.push_back({value, value});
  }
  return limits;
}

/// Expands one limit per face of the file to one per triangle.
std::vector<Limit> limits_of_triangles(const Mesh& mesh, std::vector<Limit> limits) {
  if (mesh.file_faces.are_triangles()) return limits;
  std::vector<Limit> out;
  out.reserve(mesh.faces.size());
  for (const uint32_t face : mesh.file_faces.of_all(mesh.faces.size())) out.push_back(limits[face]);
  return out;
}

}  // namespace

std::vector<Limit> read_face_limits(const std::string& path, const Mesh& mesh,
                                    const Limit& otherwise, const std::string& file_unit,
                                    const Diagonal& of_a) {
  const uint64_t face_count = mesh.file_faces.count(mesh.faces.size());
  std::ifstream file(path_of(path), std::ios::binary);
  if (!file) reject(path, "", "no file to be read", "a CSV of face, max");
  skip_byte_order_mark(file);
  // No CSV begins with a p. This is the only look at a CSV before it is read: it may be a pipe.
  if (file.peek() == 'p') return limits_of_triangles(mesh, limits_in_ply(path, face_count));
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
      limits[face] = limit_of(max, file_unit, of_a);
    } catch (const UsageError& error) {
      reject(path, place, vkh::quoted(max), std::string("face, max; ") + error.what());
    }
  }
  if (file.bad())
    throw InputError(
        {.file = path, .place = "line " + std::to_string(number), .problem = "cannot be read"});
  return limits_of_triangles(mesh, std::move(limits));
}

}  // namespace vkh
