// Averages of doubles by weights that are whole numbers over a power of two, exactly.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace vkh::pairs {

/// value = mantissa * 2^exponent; the mantissa is odd or 0.
struct Dyadic {
  __int128 mantissa = 0;
  int exponent = 0;
};

inline Dyadic normalised(Dyadic x) {
  if (x.mantissa == 0) return {};
  while ((x.mantissa & 0xffffffff) == 0) x = {x.mantissa >> 32, x.exponent + 32};
  const int zeros = std::countr_zero(static_cast<uint32_t>(x.mantissa & 0xffffffff));
  return {x.mantissa >> zeros, x.exponent + zeros};
}

/// The exact value of a finite double.
inline Dyadic dyadic(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return normalised({static_cast<int64_t>(std::ldexp(fraction, 53)), exponent - 53});
}

/// Bits from the highest to the lowest that is set.
inline int bits_of(const Dyadic& x) {
  const auto size = static_cast<unsigned __int128>(x.mantissa < 0 ? -x.mantissa : x.mantissa);
  const auto high = static_cast<uint64_t>(size >> 64);
  return high != 0 ? 128 - std::countl_zero(high)
                   : 64 - std::countl_zero(static_cast<uint64_t>(size));
}

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
    if (terms[i].mantissa == 0) continue;
    least = std::min(least, terms[i].exponent);
    top = std::max(top, terms[i].exponent + bits_of(terms[i]));
  }
  if (top == INT32_MIN) return {.is_exact = true};
  // Two values so far apart that their sum takes more than 53 bits, and so does an edge between
  // them.
  if (top - least > 106) return {.bits = top - least};
  Dyadic sum{0, least - static_cast<int>(levels)};
  for (size_t i = 0; i < 3; ++i) {
    if (terms[i].mantissa == 0) continue;
    sum.mantissa += (terms[i].mantissa << (terms[i].exponent - least)) * weights[i];
  }
  sum = normalised(sum);
  if (!is_double(sum)) return {.bits = bits_of(sum)};
  return {true, bits_of(sum), std::ldexp(static_cast<double>(sum.mantissa), sum.exponent)};
}

}  // namespace vkh::pairs
