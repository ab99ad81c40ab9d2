// Stands in for shaders/math/marked.h: a double that says by its last bit whether the closest point
// is inside of its triangle. As there, the bit steers a cut and nothing else.
#pragma once

#define VKH_SHADERS_MATH_MARKED_H

#include <bit>

#include "host/native/arithmetic.h"

namespace vkh::native {

/// d >= 0, or the double above it, whichever has the bit.
inline double marked(double d, bool inside) {
  const auto bits = std::bit_cast<uint64_t>(d);
  return std::bit_cast<double>(bits + ((bits & 1) ^ (inside ? 1 : 0)));
}

inline bool is_marked(double d) { return (std::bit_cast<uint64_t>(d) & 1) != 0; }

}  // namespace vkh::native
