#include "vkhausdorff/place.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "host/base/byte_order_mark.h"
#include "host/base/decimal.h"
#include "host/base/parse_number.h"
#include "host/base/reject.h"
#include "host/base/rounding.h"
#include "host/base/system.h"
#include "host/read/corners_hash.h"
#include "host/read/transform.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/polygon.h"

namespace vkh {
namespace {

constexpr double kMostStretch = 1e-6;
constexpr const char* kAMatrix = "sixteen numbers, four rows of four, the last of them 0 0 0 1";

constexpr const char* kARotation = "a rotation and a shift";

bool is_between_numbers(char c) {
  return std::string_view(" \t\r\n\v\f,;[]()").find(c) != std::string_view::npos;
}

/// Reads the words of a text without comments as numbers.
std::vector<double> numbers_in(const std::string& name, std::string_view text) {
  std::vector<double> numbers;
  for (size_t at = 0; at < text.size();) {
    if (text[at] == '#') at = std::min(text.find('\n', at), text.size());
    if (at < text.size() && is_between_numbers(text[at])) ++at;
    size_t end = at;
    while (end < text.size() && text[end] != '#' && !is_between_numbers(text[end])) ++end;
    if (end == at) continue;
    double value = 0;
    const std::string_view word = text.substr(at, end - at);
    if (!parse_number(word, value))
      reject(name, "number " + std::to_string(numbers.size() + 1),
             "'" + std::string(word.substr(0, 40)) + "'", kAMatrix);
    numbers.push_back(value);
    at = end;
  }
  return numbers;
}

using Rows3 = std::array<std::array<Float128, 3>, 3>;

/// R^T R. Each entry is a sum of three products of doubles, which are exact in Float128; two sums
/// take 2^-113 of the terms' sum by size at most, each.
Rows3 squares_of(const MatrixRows& rows) {
  Rows3 squares{};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      for (const auto& row : rows) squares[i][j] += float128(row[i]) * float128(row[j]);
    }
  }
  return squares;
}

/// The determinant, and the sum of its six products by size.
struct Determinant {
  Float128 value = 0, terms = 0;
};

// Products of two doubles are exact in Float128, and each sum and each further product is off by
// 2^-113 of itself: a minor once, its product with an entry once more, two sums. So the value is
// off by at most 5 * 2^-113 of `terms`, whose own roundings the fifth covers.
Determinant determinant(const MatrixRows& m) {
  Determinant d;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Float128 entry = float128(m[0][i]);
    const Float128 one = float128(m[1][j]) * float128(m[2][k]);
    const Float128 other = float128(m[1][k]) * float128(m[2][j]);
    d.value += entry * (one - other);
    d.terms += magnitude(entry) * (magnitude(one) + magnitude(other));
  }
  return d;
}

double up(Float128 x) {
  const auto near = static_cast<double>(x);
  return float128(near) < x ? std::nextafter(near, std::numeric_limits<double>::infinity()) : near;
}

/// The factor by which the map lengthens at most, rounded up: its Frobenius norm.
double growth_of(const MeshTransform& placement) {
  constexpr double kOutward = 1 + 0x1p-50;  // a root, its argument, and the sums above
  if (placement.is_identity()) return 1;
  Float128 square = 1;
  if (placement.matrix) {
    const Rows3 squares = squares_of(*placement.matrix);
    square = squares[0][0] + squares[1][1] + squares[2][2];
  }
  const Float128 factor = float128(placement.numerator) / float128(placement.denominator);
  square = square * factor * factor;
  // A square may be beyond any double where its root is not. Powers of two change no bit.
  const int scale = square > float128(0x1p1000) ? 600 : 0;
  const Float128 by = float128(std::ldexp(1.0, scale));
  return std::ldexp(std::sqrt(up(square / by / by)) * kOutward, scale);
}

/// One coordinate times p / q, rounded to nearest (twice in rare cases), and a bound of its error.
struct Converted {
  double value, off;
};

// x p is hi + lo exactly, unless it underflows, and hi is value q + rest exactly. So the exact
// quotient is value + (rest + lo) / q. Both numbers are integers of at most 53 bits.
Converted converted(double x, double p, double q) {
  if (x == 0) return {x, 0};
  const double hi = x * p, lo = std::fma(x, p, -hi);
  const double value = hi / q, rest = std::fma(-value, q, hi);
  if (rest == 0 && lo == 0) return {value, std::abs(hi) < 0x1p-960 ? 0x1p-1060 : 0};
  constexpr double kOutward = 1 + 0x1p-50;  // two sums, a quotient
  return {value, (std::abs(rest) + std::abs(lo)) / q * kOutward + 0x1p-1060};
}

glm::dvec3 converted(const glm::dvec3& point, const MeshTransform& placement, double& delta) {
  glm::dvec3 to;
  double off = 0;  // over the three coordinates: no less than the distance
  for (int i = 0; i < 3; ++i) {
    const Converted one = converted(point[i], placement.numerator, placement.denominator);
    to[i] = one.value;
    off += one.off;
  }
  delta = std::max(delta, off * (1 + 0x1p-50));
  return to;
}

/// Returns the most that rounding moved a vertex.
double move_vertices(Mesh& mesh, const MeshTransform& placement) {
  double delta = 0;
  if (!placement.matrix) {
    for (DVec3& v : mesh.vertices) v = converted(v, placement, delta);
    return delta;
  }
  const scene::Affine map = scene::compose(
      {.m = *placement.matrix}, scene::scaling(placement.numerator, placement.denominator));
  const scene::Mover mover(map, 0);
  for (DVec3& v : mesh.vertices) v = mover(v, delta);
  return delta;
}

void check_finite(const Mesh& mesh, const std::string& unit) {
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    const DVec3& v = mesh.vertices[i];
    if (std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z)) continue;
    reject(mesh.name, "vertex " + std::to_string(i),
           "beyond any double where the unit or the matrix puts it" +
               (unit.empty() ? "" : ", in " + unit),
           "smaller coordinates");
  }
}

}  // namespace

MatrixRows read_matrix(const std::filesystem::path& path) {
  const std::string name = name_of(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) reject(name, "", "cannot be read", kAMatrix);
  constexpr std::streamsize kMost = 1 << 16;
  std::string text(static_cast<size_t>(kMost), '\0');
  file.read(text.data(), kMost);
  text.resize(static_cast<size_t>(file.gcount()));
  refuse_utf16(name, text);
  const size_t mark = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  const std::vector<double> numbers = numbers_in(name, std::string_view(text).substr(mark));
  const auto refuse = [&](const std::string& what) { reject(name, "", what, kAMatrix); };
  if (numbers.size() != 16) refuse(std::to_string(numbers.size()) + " numbers");
  const auto is_last = [&](size_t first, size_t step) {
    return numbers[first] == 0 && numbers[first + step] == 0 && numbers[first + 2 * step] == 0 &&
           numbers[first + 3 * step] == 1;
  };
  if (!is_last(12, 1))
    refuse(is_last(3, 4) ? "the last column is 0 0 0 1: it is written by columns"
                         : "another last row");
  MatrixRows rows;
  for (size_t i = 0; i < 12; ++i) rows[i / 4][i % 4] = numbers[i];
  return rows;
}

std::string matrix_text(const MatrixRows& rows) {
  std::string text;
  for (const auto& row : rows) {
    for (const double entry : row)
      text += (text.empty() || text.back() == '\n' ? "" : " ") +
              number_text(entry, std::chars_format::general, 17);
    text += '\n';
  }
  return text + "0 0 0 1\n";
}

double stretch_of(const MatrixRows& rows) {
  const Rows3 squares = squares_of(rows);
  Float128 most = 0;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j)
      most = std::max(most, magnitude(squares[i][j] - float128(i == j ? 1 : 0)));
  }
  return most == 0 ? 0 : up(most * float128(1 + 0x1p-50) + float128(0x1p-108));
}

void check_matrix(const std::string& name, const MatrixRows& rows, bool may_stretch) {
  const auto refuse = [&](const std::string& what, const char* expected) {
    reject(name, "", what, expected);
  };
  for (const auto& row : rows) {
    if (!std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); }))
      refuse("a number that is not finite", kAMatrix);
  }
  // A determinant of that size has its own sign: 2^-110 is eight times 2^-113.
  const auto [volume, terms] = determinant(rows);
  const bool has_sign = magnitude(volume) > terms * float128(0x1p-110);
  if (has_sign && volume < 0) refuse("mirrors (its determinant is negative)", kARotation);
  const double stretch = stretch_of(rows);
  if (!may_stretch && !(stretch <= kMostStretch))
    refuse(
        "stretches by more than 1e-6 (|R^T R - I| is " + decimal(stretch, 3, Rounding::kUp) + ")",
        "a rotation and a shift, or --scale, which allows any");
  if (!has_sign) refuse("flattens (its determinant is 0, or too near it for a sign)", kARotation);
}

void place(Mesh& mesh, const MeshTransform& placement, const std::string& unit, bool hash_corners) {
  PlacedFrom placed{.by = placement, .from = mesh.unit};
  if (hash_corners) placed.corners = sha256_of_corners(mesh);
  const double growth = growth_of(placement);
  placed.delta = mesh.delta == 0 ? 0 : up(float128(mesh.delta) * float128(growth));
  const double delta = move_vertices(mesh, placement);
  check_finite(mesh, unit);
  mesh.delta = add_up(placed.delta, delta);
  if (mesh.polygons.ambiguity > 0) mesh.polygons.ambiguity *= growth;
  mesh.unit = unit;
  mesh.placed = std::move(placed);
}

}  // namespace vkh
