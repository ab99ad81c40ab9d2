#include "host/answer/face_limits.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <optional>
#include <utility>

#include "host/answer/csv.h"
#include "host/base/blanks.h"
#include "host/base/byte_order_mark.h"
#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/base/system.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"

namespace vkh {
namespace {

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

/// A row of a CSV: a face, and the text of its limit.
struct FaceRow {
  std::string face, max;
};

/// Joins the cells behind the face to the text of its limit, which need not be a length.
FaceRow row_of(const std::vector<std::string>& cells, char separator) {
  FaceRow row{.face = std::string(trimmed(cells[0])), .max = {}};
  size_t end = cells.size();
  while (end > 2 && trimmed(cells[end - 1]).empty()) --end;
  for (size_t i = 1; i < end; ++i) row.max += (i == 1 ? "" : std::string(1, separator)) + cells[i];
  row.max = std::string(trimmed(row.max));
  return row;
}

bool is_heading(const FaceRow& row) {
  const auto is = [](const std::string& word, std::string_view name) {
    return std::equal(word.begin(), word.end(), name.begin(), name.end(), [](char a, char b) {
      return std::tolower(static_cast<unsigned char>(a)) == b;
    });
  };
  return is(row.face, "face") && is(row.max, "max");
}

/// Reads the rows of a CSV, in the order of the file.
class FaceRows {
 public:
  FaceRows(std::istream& text, const std::string& path) : path_(path), csv_(text, '#') {}

  std::optional<FaceRow> next() {
    try {
      auto cells = csv_.next();
      if (!cells) return std::nullopt;
      FaceRow row = row_of(*cells, csv_.separator());
      const bool is_first = std::exchange(is_first_, false);
      return is_first && is_heading(row) ? next() : row;
    } catch (const InputError& error) {
      reject(path_, place(), error.what(), "a CSV of face, max");
    }
  }
  std::string place() const { return "line " + std::to_string(csv_.line()); }

 private:
  const std::string& path_;
  CsvReader csv_;
  bool is_first_ = true;
};

}  // namespace

std::vector<Limit> read_face_limits(const std::string& path, const Mesh& mesh,
                                    const Limit& otherwise, const std::string& file_unit,
                                    const Diagonal& of_a) {
  const uint64_t face_count = mesh.file_faces.count(mesh.faces.size());
  std::ifstream file(path_of(path), std::ios::binary);
  if (!file) reject(path, "", "no file to be read", "a CSV of face, max");
  skip_byte_order_mark(file, path);
  // No CSV begins with a p. This is the only look at a CSV before it is read: it may be a pipe.
  if (file.peek() == 'p') return limits_of_triangles(mesh, limits_in_ply(path, face_count));
  std::vector<Limit> limits(face_count, otherwise);
  std::vector<bool> named(face_count);
  FaceRows rows(file, path);
  while (const auto row = rows.next()) {
    uint64_t face = 0;
    if (!parse_number(row->face, face) || face >= face_count)
      reject(path, rows.place(), vkh::quoted(row->face),
             "a face from 0 to " + std::to_string(face_count - 1));
    if (named[face])
      reject(path, rows.place(), "face " + row->face + " once more", "each face once");
    named[face] = true;
    try {
      limits[face] = limit_of(row->max, file_unit, of_a);
    } catch (const UsageError& error) {
      reject(path, rows.place(), vkh::quoted(row->max), std::string("face, max; ") + error.what());
    }
  }
  if (file.bad())
    throw InputError({.file = path, .place = rows.place(), .problem = "cannot be read"});
  return limits_of_triangles(mesh, std::move(limits));
}

}  // namespace vkh
