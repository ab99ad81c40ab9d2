// Numbers of 113 bits: exact enough to check a certificate of 24 or 48 bits with room to spare.
// They are integers underneath, so that every compiler and processor gives the same bits, in every
// rounding mode.
#pragma once

#include <compare>
#include <cstdint>
#include <glm/vec3.hpp>

#include "host/base/uint128.h"

namespace vkh {

/// A binary floating-point number like IEEE 754's binary128, except that its exponent has 32 bits,
/// whose range is never exhausted here. Sums, products and quotients are rounded to nearest, ties
/// to even, and so off by 2^-113 of themselves at most. Infinities, NaN and zeros of two signs
/// behave as those of double. A double becomes one exactly.
class Float128 {
 public:
  constexpr Float128() = default;
  Float128(double x);  // implicit, as between the language's own numbers: nothing is lost

  /// Rounds to nearest, ties to even; to infinity where it overflows.
  explicit operator double() const;

  Float128 operator-() const;
  friend Float128 operator+(const Float128& a, const Float128& b);
  friend Float128 operator-(const Float128& a, const Float128& b) { return a + -b; }
  friend Float128 operator*(const Float128& a, const Float128& b);
  friend Float128 operator/(const Float128& a, const Float128& b);
  Float128& operator+=(const Float128& b) { return *this = *this + b; }
  Float128& operator-=(const Float128& b) { return *this = *this - b; }

  friend bool operator==(const Float128& a, const Float128& b) { return (a <=> b) == 0; }
  friend std::partial_ordering operator<=>(const Float128& a, const Float128& b);

 private:
  static constexpr int32_t kExponentOfZero = INT32_MIN, kExponentBeyond = INT32_MAX;

  Float128(bool is_negative, int32_t exponent, const UInt128& size)
      : size_(size), exponent_(exponent), is_negative_(is_negative) {}
  static Float128 rounded(bool is_negative, int32_t exponent, UInt128 size);
  bool is_zero() const { return exponent_ == kExponentOfZero; }
  bool is_finite() const { return exponent_ != kExponentBeyond; }
  bool is_nan() const { return !is_finite() && size_.low != 0; }
  double stand_in() const;

  // The size is size_ * 2^(exponent_ - 127); the top bit of size_ is set and the last 15 are not. A
  // zero has kExponentOfZero; kExponentBeyond is an infinity, or NaN if size_.low is not 0.
  UInt128 size_;
  int32_t exponent_ = kExponentOfZero;
  bool is_negative_ = false;
};

struct Float128Vector {
  Float128 x = 0, y = 0, z = 0;
};

inline Float128 float128(double x) { return Float128(x); }
inline Float128Vector float128(const glm::dvec3& p) {
  return {float128(p.x), float128(p.y), float128(p.z)};
}

inline Float128Vector operator+(const Float128Vector& a, const Float128Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Float128Vector operator-(const Float128Vector& a, const Float128Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Float128Vector operator*(const Float128& s, const Float128Vector& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Float128 dot(const Float128Vector& a, const Float128Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Float128Vector cross(const Float128Vector& a, const Float128Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Float128 magnitude(const Float128& x) { return x < 0 ? -x : x; }
inline Float128 magnitude(const Float128Vector& a) {  ///< magnitude of the largest coordinate
  const Float128 x = magnitude(a.x), y = magnitude(a.y), z = magnitude(a.z);
  return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

}  // namespace vkh
