// Averages of doubles by weights that are whole numbers over a power of two, exactly.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "host/base/uint128.h"

namespace vkh::pairs {

/// value = mantissa * 2^exponent, or that subtracted from 0; the mantissa is odd or 0.
struct Dyadic {
  UInt128 mantissa;
  int exponent = 0;
  bool is_negative = false;
};

inline bool is_zero(const Dyadic& x) { return x.mantissa == UInt128{}; }

inline Dyadic normalised(const Dyadic& x) {
  if (is_zero(x)) return {};
  const int zeros = countr_zero(x.mantissa);
  return {x.mantissa >> zeros, x.exponent + zeros, x.is_negative};
}

/// The exact value of a finite double.
inline Dyadic dyadic(double x) {
  int exponent = 0;
  const double fraction = std::frexp(std::abs(x), &exponent);
  return normalised(
      {{0, static_cast<uint64_t>(std::ldexp(fraction, 53))}, exponent - 53, std::signbit(x)});
}

/// Bits from the highest to the lowest that is set.
inline int bits_of(const Dyadic& x) { return 128 - countl_zero(x.mantissa); }

inline bool is_double(const Dyadic& x) { return bits_of(x) <= 53 && x.exponent >= -1074; }

struct Average {
  bool is_exact = false;
  int bits = 0;      ///< bits of the exact average
  double value = 0;  ///< where it is exact
};

/// The sum of weights[i] * values[i], over 2^levels. The weights are less than 2^17 each.
inline Average average(const std::array<double, 3>& values, const std::array<uint32_t, 3>& weights,
                       uint32_t levels) {
  std::array<Dyadic, 3> terms;
  int least = INT32_MAX, top = INT32_MIN;
  for (size_t i = 0; i < 3; ++i) {
    terms[i] = weights[i] == 0 ? Dyadic{} : dyadic(values[i]);
    if (is_zero(terms[i])) continue;
    least = std::min(least, terms[i].exponent);
    top = std::max(top, terms[i].exponent + bits_of(terms[i]));
  }
  if (top == INT32_MIN) return {.is_exact = true};
  // Two values so far apart that their sum takes more than 53 bits, and so does an edge between
  // them.
  if (top - least > 106) return {.bits = top - least};
  UInt128 total;  // in two's complement: at most three times 106 and 17 bits
  for (size_t i = 0; i < 3; ++i) {
    if (is_zero(terms[i])) continue;
    const UInt128 term = multiply(terms[i].mantissa.low, weights[i]) << (terms[i].exponent - least);
    total = terms[i].is_negative ? total - term : total + term;
  }
  const bool is_negative = total.high >> 63 != 0;
  const Dyadic sum = normalised(
      {is_negative ? UInt128{} - total : total, least - static_cast<int>(levels), is_negative});
  if (!is_double(sum)) return {.bits = bits_of(sum)};
  const double size = std::ldexp(static_cast<double>(sum.mantissa.low), sum.exponent);
  return {true, bits_of(sum), is_negative ? -size : size};
}

}  // namespace vkh::pairs
