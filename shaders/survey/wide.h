// Integers of 64 bits in two words, the low one first: their sums are the same in any order.
#ifndef VKH_SHADERS_SURVEY_WIDE_H
#define VKH_SHADERS_SURVEY_WIDE_H

#include "shaders/math/dyadic.h"

VKH_LIB_BEGIN

#ifdef __cplusplus
// GLSL has these.
using glm::ivec2;
inline void imulExtended(int a, int b, int& high, int& low) {
  const auto product = static_cast<uint64_t>(static_cast<int64_t>(a) * b);
  high = static_cast<int>(product >> 32);
  low = static_cast<int>(product);
}
inline void umulExtended(uint a, uint b, uint& high, uint& low) {
  const uint64_t product = static_cast<uint64_t>(a) * b;
  high = static_cast<uint>(product >> 32);
  low = static_cast<uint>(product);
}
inline int findMSB(uint a) { return 31 - std::countl_zero(a); }
#endif

VKH_FN uvec2 wide_sum(uvec2 a, uvec2 b) {
  uint low = a.x + b.x;
  return uvec2(low, a.y + b.y + choose(low < a.x, 1u, 0u));
}

// The integer over 2^shift, rounded down, for shifts of up to 63.
VKH_FN uvec2 wide_shifted(uvec2 a, uint shift) {
  uint bits = shift & 31u;
  uint low = choose(shift < 32u, a.x, a.y);
  uint high = choose(shift < 32u, a.y, 0u);
  uint from_high = choose(bits == 0u, 0u, high << ((32u - bits) & 31u));
  return uvec2((low >> bits) | from_high, high >> bits);
}

// a m / 2^shift, rounded down, for a < 2^62, m <= 2^24 and a shift of at least 24.
VKH_FN uvec2 wide_scaled(uvec2 a, uint m, uint shift) {
  uint high, low, more, middle;
  umulExtended(a.x, m, high, low);
  umulExtended(a.y, m, more, middle);
  middle = middle + high;
  more = more + choose(middle < high, 1u, 0u);
  if (shift < 32u)
    return uvec2((low >> shift) | (middle << (32u - shift)),
                 (middle >> shift) | (more << (32u - shift)));
  if (shift < 88u) return wide_shifted(uvec2(middle, more), shift - 32u);
  return uvec2(0u, 0u);
}

VKH_LIB_END
#endif
