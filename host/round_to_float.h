// double -> float -> double that the compiler keeps.
#pragma once

#include <glm/vec3.hpp>

namespace vkh {

/// The nearest float32. The store is volatile because GCC 12.2 at -O2 drops the rounding where two
/// neighbours are converted together (`{double(float(x)), double(float(y))}`: its SLP vectoriser
/// folds the pair of conversions into none); -fno-tree-slp-vectorize would keep it as well.
inline double round_to_float(double x) {
  volatile float rounded = static_cast<float>(x);
  return static_cast<double>(rounded);
}

inline glm::dvec3 round_to_float(const glm::dvec3& p) {
  return {round_to_float(p.x), round_to_float(p.y), round_to_float(p.z)};
}

}  // namespace vkh
