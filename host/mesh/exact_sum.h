// Sums and signs without rounding, of products of doubles.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "host/base/uint128.h"

namespace vkh {

/// Splits |x|, which is result * 2^exponent: exponent in [-1074, 971], result < 2^53.
inline uint64_t mantissa_of(double x, int& exponent) {
  const auto bits = std::bit_cast<uint64_t>(x);
  const auto field = static_cast<int>(bits >> 52 & 0x7ff);
  const uint64_t fraction = bits & ((uint64_t{1} << 52) - 1);
  exponent = std::max(field, 1) - 1075;
  return field == 0 ? fraction : fraction | uint64_t{1} << 52;
}

/// An integer of 64 kLimbs bits in two's complement, which begins as 0.
template <size_t kLimbs>
class WideInteger {
 public:
  bool is_zero() const {
    return std::all_of(limbs_.begin(), limbs_.end(), [](uint64_t limb) { return limb == 0; });
  }
  /// -1, 0 or 1.
  int sign() const { return limbs_.back() >> 63 != 0 ? -1 : is_zero() ? 0 : 1; }

 protected:
  /// Adds `value` * 2^shift, or subtracts it. The value's parts are its words of 64 bits, the least
  /// first; shifted by up to 63 bits it covers one more.
  template <size_t kParts>
  void add(const std::array<uint64_t, kParts>& value, unsigned shift, bool negative) {
    const unsigned bit = shift % 64;
    std::array<uint64_t, kParts + 1> parts{};
    for (size_t i = 0; i < kParts; ++i) {
      parts[i] |= value[i] << bit;
      if (bit != 0) parts[i + 1] = value[i] >> (64 - bit);
    }
    uint64_t carry = negative ? 1 : 0;
    for (size_t i = shift / 64, part = 0; i < kLimbs; ++i, ++part) {
      const uint64_t added = part < parts.size() ? parts[part] : 0;
      const UInt128 sum =
          UInt128{0, limbs_[i]} + UInt128{0, negative ? ~added : added} + UInt128{0, carry};
      limbs_[i] = sum.low;
      carry = sum.high;
    }
  }

 private:
  std::array<uint64_t, kLimbs> limbs_{};
};

/// Sums products of doubles of any exponents without rounding. Every finite double is an
/// integer times 2^-1074, so a product is one times 2^-2148, less than 2^2048 in size; bit 0 is
/// worth 2^-2148, and at least 60 bits are left at the top.
class ExactSum : public WideInteger<67> {
 public:
  void add_product(double a, double b, bool negative) {
    int exponent_a = 0, exponent_b = 0;
    const auto mantissa_a = mantissa_of(a, exponent_a);
    const auto mantissa_b = mantissa_of(b, exponent_b);
    const UInt128 product = multiply(mantissa_a, mantissa_b);
    add(std::array<uint64_t, 2>{product.low, product.high},
        static_cast<unsigned>(exponent_a + exponent_b + 2148),
        negative != (std::signbit(a) != std::signbit(b)));
  }
};

/// a b c without rounding, in words of 64 bits, the least first.
inline std::array<uint64_t, 3> product_of(uint64_t a, uint64_t b, uint64_t c) {
  const UInt128 ab = multiply(a, b), low = multiply(ab.low, c);
  const UInt128 high = multiply(ab.high, c) + UInt128{0, low.high};
  return {low.low, high.low, high.high};
}

/// Sums products of three doubles without rounding, as ExactSum does those of two: bit 0 is worth
/// 2^-3222, a product is under 2^3072, and 100 limbs leave 106 bits at the top.
class ExactVolume : public WideInteger<100> {
 public:
  void add_product(double a, double b, double c, bool negative) {
    int ea = 0, eb = 0, ec = 0;
    const uint64_t ma = mantissa_of(a, ea), mb = mantissa_of(b, eb), mc = mantissa_of(c, ec);
    add(product_of(ma, mb, mc), static_cast<unsigned>(ea + eb + ec + 3222),
        negative != (std::signbit(a) != (std::signbit(b) != std::signbit(c))));
  }
};

using Point2 = std::array<double, 2>;

/// Sign of (a-c) x (b-c), multiplied out so that every term is a product of given coordinates.
inline int exact_turn(const Point2& a, const Point2& b, const Point2& c) {
  ExactSum sum;
  sum.add_product(a[0], b[1], false);
  sum.add_product(a[0], c[1], true);
  sum.add_product(c[0], b[1], true);
  sum.add_product(a[1], b[0], true);
  sum.add_product(a[1], c[0], false);
  sum.add_product(c[1], b[0], false);
  return sum.sign();
}

/// The sign of (a-c) x (b-c) without exact arithmetic: 0 where rounding leaves it open.
inline int sure_turn(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double size = std::abs(left) + std::abs(right);
  // Seven roundings of 2^-53 at most lie between left - right and the true value, relative to size;
  // 1e-15 is nine. Above 1e-280 what underflow adds (2^-1074 a product) is far below that.
  // Overflow gives inf or nan and fails the comparison.
  if (!(size > 1e-280 && std::abs(left - right) > 1e-15 * size)) return 0;
  return left > right ? 1 : -1;
}

/// 1 where a, b, c turn left, -1 where they turn right, 0 where they lie on a line: exact.
inline int turn_of(const Point2& a, const Point2& b, const Point2& c) {
  const int sure = sure_turn(a, b, c);
  return sure != 0 ? sure : exact_turn(a, b, c);
}

}  // namespace vkh
