// A distance that says by its last bit whether the closest point is inside of its triangle.
#ifndef VKH_SHADERS_MATH_MARKED_H
#define VKH_SHADERS_MATH_MARKED_H

#include "shaders/math/choose.h"

VKH_LIB_BEGIN

// d or the float above it: the one whose last bit says whether the closest point is inside of its
// triangle. A zero of either sign counts as 0. The bit steers the cut of u3 (from_cut) and
// nothing else, so a device that flushes the float above 0 may lose it.
VKH_FN float marked(float d, bool inside) {
  uint bits = floatBitsToUint(d);
  bits = choose(bits == 0x80000000u, 0u, bits);
  uint step = (bits & 1u) ^ choose(inside, 1u, 0u);
  return uintBitsToFloat(choose((bits >> 31) != 0u, bits - step, bits + step));
}

VKH_FN bool is_marked(float d) { return (floatBitsToUint(d) & 1u) != 0u; }

VKH_LIB_END
#endif
