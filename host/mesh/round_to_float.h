// Conversions from double to float and back that the compiler keeps.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <limits>

namespace vkh {

/// The nearest float32. The store is volatile because GCC 12.2 at -O2 drops the rounding where two
/// neighbours are converted together (`{double(float(x)), double(float(y))}`: its SLP vectoriser
/// folds the pair of conversions into none), which would falsify x - float(x).
inline float nearest_float(double x) {
  volatile float rounded = static_cast<float>(x);
  return rounded;
}

/// The largest float that is no larger than x, and the least that is no smaller.
inline float float_down(double x) {
  const float f = nearest_float(x);
  return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity())
                                    : f;
}
inline float float_up(double x) {
  const float f = nearest_float(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

inline double round_to_float(double x) { return static_cast<double>(nearest_float(x)); }

inline glm::dvec3 round_to_float(const glm::dvec3& p) {
  return {round_to_float(p.x), round_to_float(p.y), round_to_float(p.z)};
}

}  // namespace vkh
