// The length of a vector, with the same bits under every C++ library, whose std::hypot of three
// differ in the last.
#pragma once

#include <algorithm>
#include <cmath>

namespace vkh {

/// sqrt(x^2 + y^2 + z^2) without overflow before the last product, off by less than 5 * 2^-53 of
/// itself: with u = 2^-53, a quotient is off by u, its square by 3 u, the sum by 5 u, its root by
/// 3.5 u and the product by 4.5 u, not counting terms of u^2. What underflows is under 2^-1074
/// beside a square of 1. NaN for an infinite component.
inline double hypot3(double x, double y, double z) {
  const double largest = std::max({std::abs(x), std::abs(y), std::abs(z)});
  if (largest == 0) return 0;
  const double a = x / largest, b = y / largest, c = z / largest;
  return largest * std::sqrt(a * a + b * b + c * c);
}

}  // namespace vkh
