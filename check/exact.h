// Exact numbers: integers of GMP, points of integers, squared distances as fractions of integers.
// No floating-point number is computed with here: a double's bits are taken apart, once.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <climits>
#include <cstdint>
#include <glm/vec3.hpp>

namespace vkh::check {

using Z = mpz_class;

inline Z integer(uint64_t value) {
  Z out;
  mpz_import(out.get_mpz_t(), 1, -1, sizeof value, 0, 0, &value);
  return out;
}

/// A finite double: mantissa * 2^exponent, and a sign.
struct Bits {
  uint64_t mantissa;
  int exponent;
  bool is_negative;
};

inline Bits bits_of(double value) {
  const auto bits = std::bit_cast<uint64_t>(value);
  const uint64_t fraction = bits & ((uint64_t{1} << 52) - 1);
  const int field = static_cast<int>(bits >> 52 & 2047);
  if (field == 0) return {fraction, -1074, bits >> 63 != 0};  // 0, or subnormal
  return {fraction | uint64_t{1} << 52, field - 1075, bits >> 63 != 0};
}

/// The largest e such that the double is an integer times 2^e; INT_MAX for 0.
inline int exponent_of(double value) {
  const Bits bits = bits_of(value);
  return bits.mantissa == 0 ? INT_MAX : bits.exponent + std::countr_zero(bits.mantissa);
}

/// value / 2^exponent, for an exponent of at most exponent_of(value).
inline Z integer(double value, int exponent) {
  const Bits bits = bits_of(value);
  const int shift = bits.exponent - exponent;
  Z out = integer(bits.mantissa);
  shift >= 0 ? out <<= static_cast<unsigned>(shift) : out >>= static_cast<unsigned>(-shift);
  return bits.is_negative ? Z(-out) : out;
}

struct Point {
  Z x, y, z;
};

inline Point point(const glm::dvec3& value, int exponent) {
  return {integer(value.x, exponent), integer(value.y, exponent), integer(value.z, exponent)};
}
inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator<<(const Point& a, unsigned shift) {
  return {a.x << shift, a.y << shift, a.z << shift};
}
/// m a + n b, for small m and n.
inline Point sum(unsigned m, const Point& a, unsigned n, const Point& b) {
  return {m * a.x + n * b.x, m * a.y + n * b.y, m * a.z + n * b.z};
}
inline Z dot(const Point& a, const Point& b) {
  Z out = a.x * b.x;
  out += a.y * b.y;
  return out += a.z * b.z;
}
inline Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// numerator / denominator, which is positive; not reduced.
struct Fraction {
  Z numerator = 0, denominator = 1;
};
inline bool operator<(const Fraction& a, const Fraction& b) {
  return Z(a.numerator * b.denominator) < Z(b.numerator * a.denominator);
}
/// fraction * 4^exponent.
inline Fraction scaled(Fraction fraction, int exponent) {
  Z& part = exponent >= 0 ? fraction.numerator : fraction.denominator;
  part <<= 2 * static_cast<unsigned>(exponent >= 0 ? exponent : -exponent);
  return fraction;
}

/// A triangle that many points are measured from. Corners may coincide or be collinear.
class Triangle {
 public:
  Triangle() = default;
  explicit Triangle(const std::array<Point, 3>& corners) : corner(corners) {
    for (size_t i = 0; i < 3; ++i) {
      edge_[i] = corner[(i + 1) % 3] - corner[i];
      length_[i] = dot(edge_[i], edge_[i]);
    }
    normal_ = cross(edge_[0], edge_[1]);
    area_ = dot(normal_, normal_);
    for (size_t i = 0; i < 3; ++i) inward_[i] = cross(normal_, edge_[i]);
  }
  std::array<Point, 3> corner;

  /// The exact squared distance of p / 2^shift. The nearest point is the foot of p on the plane if
  /// the foot is inside the triangle; otherwise it is on an edge. Without a plane it is on an edge,
  /// too.
  Fraction squared_distance(const Point& p, unsigned shift) const {
    std::array<Point, 3> from;
    for (size_t i = 0; i < 3; ++i) from[i] = p - (corner[i] << shift);
    if (is_inside(from)) {
      const Z height = dot(from[0], normal_);  // times |normal|
      return {height * height, area_ << 2 * shift};
    }
    Fraction best = from_edge(from, 0, shift);
    for (size_t i = 1; i < 3; ++i) best = std::min(best, from_edge(from, i, shift));
    best.denominator <<= 2 * shift;
    return best;
  }

 private:
  /// Whether the foot is on the triangle's side of each edge: inward_[i] is in the plane, is
  /// perpendicular to edge i and points to that side.
  bool is_inside(const std::array<Point, 3>& from) const {
    return area_ > 0 && dot(from[0], inward_[0]) >= 0 && dot(from[1], inward_[1]) >= 0 &&
           dot(from[2], inward_[2]) >= 0;
  }

  /// The distance from edge i: from its start, its end, or the point of it between them that is
  /// nearest, where Pythagoras gives |from|^2 - (from . edge)^2 / |edge|^2. An edge of length 0 is
  /// its start.
  Fraction from_edge(const std::array<Point, 3>& from, size_t i, unsigned shift) const {
    const Point& end = from[(i + 1) % 3];
    const Z along = dot(from[i], edge_[i]);
    if (along <= 0) return {dot(from[i], from[i]), 1};
    if (along >= Z(length_[i] << shift)) return {dot(end, end), 1};
    return {dot(from[i], from[i]) * length_[i] - along * along, length_[i]};
  }

  std::array<Point, 3> edge_, inward_;  ///< edge i from corner i
  Point normal_;
  std::array<Z, 3> length_;  ///< squares
  Z area_;                   ///< the normal's
};

}  // namespace vkh::check
