// Exact numbers: integers of GMP, points of integers, squared distances as fractions of integers.
// No floating-point number is computed with here: a double's bits are taken apart, once.
#pragma once

#include <gmp.h>

#include <array>
#include <bit>
#include <climits>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

namespace vkh::check {

/// An integer. Its memory is kept from one use to the next.
class Z {
 public:
  Z() { mpz_init(z_); }
  Z(const Z& other) { mpz_init_set(z_, other.z_); }
  Z& operator=(const Z& other) {
    mpz_set(z_, other.z_);
    return *this;
  }
  ~Z() { mpz_clear(z_); }
  operator mpz_ptr() { return z_; }
  operator mpz_srcptr() const { return z_; }

 private:
  mpz_t z_;
};

inline int sign(const Z& z) { return mpz_sgn(static_cast<mpz_srcptr>(z)); }

using Point = std::array<Z, 3>;

inline void set(Z& out, uint64_t value) { mpz_import(out, 1, -1, sizeof value, 0, 0, &value); }

/// A finite double: mantissa * 2^exponent, and a sign.
struct Bits {
  uint64_t mantissa;
  int exponent;
  bool is_negative;
};
static_assert(sizeof(double) == 8 && std::numeric_limits<double>::is_iec559);

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

/// out = value / 2^exponent, for an exponent of at most exponent_of(value).
inline void set(Z& out, double value, int exponent) {
  const Bits bits = bits_of(value);
  set(out, bits.mantissa);
  const int shift = bits.exponent - exponent;
  if (shift >= 0) mpz_mul_2exp(out, out, static_cast<mp_bitcnt_t>(shift));
  if (shift < 0) mpz_tdiv_q_2exp(out, out, static_cast<mp_bitcnt_t>(-shift));  // only zeros go
  if (bits.is_negative) mpz_neg(out, out);
}

inline void set(Point& out, const glm::dvec3& value, int exponent) {
  set(out[0], value.x, exponent);
  set(out[1], value.y, exponent);
  set(out[2], value.z, exponent);
}

/// out = a - b * 2^shift.
inline void subtract(Point& out, const Point& a, const Point& b, unsigned shift) {
  for (size_t i = 0; i < 3; ++i) {
    mpz_mul_2exp(out[i], b[i], shift);
    mpz_sub(out[i], a[i], out[i]);
  }
}

inline void dot(Z& out, const Point& a, const Point& b) {
  mpz_mul(out, a[0], b[0]);
  mpz_addmul(out, a[1], b[1]);
  mpz_addmul(out, a[2], b[2]);
}

/// `out` is another point than a and b.
inline void cross(Point& out, const Point& a, const Point& b) {
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    mpz_mul(out[i], a[j], b[k]);
    mpz_submul(out[i], a[k], b[j]);
  }
}

/// numerator / denominator, which is positive; not reduced.
struct Fraction {
  Z numerator, denominator;
  Fraction() { mpz_set_ui(denominator, 1); }
};

inline int compare(const Fraction& a, const Fraction& b) {
  thread_local Z left, right;
  mpz_mul(left, a.numerator, b.denominator);
  mpz_mul(right, b.numerator, a.denominator);
  return mpz_cmp(left, right);
}

inline void swap(Fraction& a, Fraction& b) {
  mpz_swap(a.numerator, b.numerator);
  mpz_swap(a.denominator, b.denominator);
}

/// fraction * 4^exponent.
inline void scale(Fraction& fraction, int exponent) {
  Z& part = exponent >= 0 ? fraction.numerator : fraction.denominator;
  mpz_mul_2exp(part, part, 2 * static_cast<mp_bitcnt_t>(exponent >= 0 ? exponent : -exponent));
}

/// A triangle that many points are measured from. Corners may coincide or be collinear.
class Triangle {
 public:
  Point corner[3];

  /// To be called when the corners are set.
  void prepare() {
    for (size_t i = 0; i < 3; ++i) {
      subtract(edge_[i], corner[(i + 1) % 3], corner[i], 0);
      dot(length_[i], edge_[i], edge_[i]);
    }
    cross(normal_, edge_[0], edge_[1]);
    dot(area_, normal_, normal_);
    for (size_t i = 0; i < 3; ++i) cross(inward_[i], normal_, edge_[i]);
  }

  /// The exact squared distance of p / 2^shift. The nearest point is the foot of p on the plane
  /// where the foot is inside the triangle; otherwise it is on an edge. Without a plane it is on
  /// one, too.
  void measure(Fraction& out, const Point& p, unsigned shift) {
    for (size_t i = 0; i < 3; ++i) subtract(from_[i], p, corner[i], shift);
    if (is_inside()) {
      dot(out.numerator, from_[0], normal_);  // the height times |normal|
      mpz_mul(out.numerator, out.numerator, out.numerator);
      mpz_set(out.denominator, area_);
    } else {
      for (size_t i = 0; i < 3; ++i) dot(square_[i], from_[i], from_[i]);
      measure_edge(out, 0, shift);
      for (size_t i = 1; i < 3; ++i) {
        measure_edge(other_, i, shift);
        if (compare(other_, out) < 0) swap(out, other_);
      }
    }
    mpz_mul_2exp(out.denominator, out.denominator, 2 * shift);
  }

 private:
  /// Whether the foot is on the triangle's side of each edge: inward_[i] is in the plane, is
  /// perpendicular to edge i and points to that side.
  bool is_inside() {
    if (sign(area_) == 0) return false;
    for (size_t i = 0; i < 3; ++i) {
      dot(side_, from_[i], inward_[i]);
      if (sign(side_) < 0) return false;
    }
    return true;
  }

  /// From edge i: from its start, its end, or the point of it between them that is nearest, where
  /// Pythagoras says |from|^2 - (from . edge)^2 / |edge|^2. An edge of length 0 is its start.
  void measure_edge(Fraction& out, size_t i, unsigned shift) {
    dot(along_, from_[i], edge_[i]);
    mpz_mul_2exp(end_, length_[i], shift);
    mpz_set_ui(out.denominator, 1);
    if (sign(along_) <= 0) {
      mpz_set(out.numerator, square_[i]);
    } else if (mpz_cmp(along_, end_) >= 0) {
      mpz_set(out.numerator, square_[(i + 1) % 3]);
    } else {
      mpz_mul(out.numerator, square_[i], length_[i]);
      mpz_submul(out.numerator, along_, along_);
      mpz_set(out.denominator, length_[i]);
    }
  }

  Point edge_[3], normal_, inward_[3];  ///< edge i from corner i
  Z length_[3], area_;                  ///< squares: of the edges, of the normal
  Point from_[3];                       ///< p minus the corners
  Z square_[3], side_, along_, end_;
  Fraction other_;
};

}  // namespace vkh::check
