// Sums, products and quotients of finite doubles, rounded in a known direction. Exact results stay
// exact. For sums that overflow, only add_up's of positive and add_down's of negative numbers hold.
#pragma once

#include <cmath>
#include <limits>

#include "host/base/float128.h"

namespace vkh {

/// The amount that rounding to nearest took from a + b: exact, unless the sum overflows (Knuth's
/// two-sum).
inline double sum_error(double a, double b) {
  const double sum = a + b;
  const double from_b = sum - a;
  return (a - (sum - from_b)) + (b - from_b);
}

/// The least double that is no smaller than a + b.
inline double add_up(double a, double b) {
  const double sum = a + b;
  return sum_error(a, b) > 0 ? std::nextafter(sum, std::numeric_limits<double>::infinity()) : sum;
}

/// The largest double that is no larger than a + b.
inline double add_down(double a, double b) {
  const double sum = a + b;
  return sum_error(a, b) < 0 ? std::nextafter(sum, -std::numeric_limits<double>::infinity()) : sum;
}

/// The least double that is no smaller than an interval's width. It is at most a double exactly
/// where the exact width is.
inline double width_up(double lower, double upper) { return add_up(upper, -lower); }

/// Whether an interval is closed: upper - lower <= tolerance in exact arithmetic.
inline bool is_within(double lower, double upper, double tolerance) {
  return width_up(lower, upper) <= tolerance;
}

/// Rounds x * y of finite numbers, neither negative, down. A product of two doubles is exact in
/// Float128 (113 bits).
inline double multiply_down(double x, double y) {
  const Float128 exact = float128(x) * float128(y);
  const double product = static_cast<double>(exact);
  return float128(product) > exact ? std::nextafter(product, 0.0) : product;
}

/// The same, rounded up; infinite where it overflows.
inline double multiply_up(double x, double y) {
  const Float128 exact = float128(x) * float128(y);
  const double product = static_cast<double>(exact);
  return float128(product) < exact
             ? std::nextafter(product, std::numeric_limits<double>::infinity())
             : product;
}

/// Rounds x / y of a number that is not negative by a positive one down.
inline double divide_down(double x, double y) {
  const double quotient = x / y;
  if (!std::isfinite(quotient)) return std::numeric_limits<double>::max();
  return float128(quotient) * float128(y) > float128(x) ? std::nextafter(quotient, 0.0) : quotient;
}

/// Rounds x / y of a number that is not negative by a positive one up.
inline double divide_up(double x, double y) {
  const double quotient = x / y;
  if (!std::isfinite(quotient)) return quotient;
  return float128(quotient) * float128(y) < float128(x)
             ? std::nextafter(quotient, std::numeric_limits<double>::infinity())
             : quotient;
}

}  // namespace vkh
