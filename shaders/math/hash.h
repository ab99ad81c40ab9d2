// A hash of words, for choosing among equals.
#ifndef VKH_SHADERS_MATH_HASH_H
#define VKH_SHADERS_MATH_HASH_H

#include "shaders/math/glsl.h"

VKH_LIB_BEGIN

// Multiply and xor-shift; any mixing will do.
VKH_FN uint mixed(uint hash, uint word) {
  hash = (hash ^ word) * 0x9e3779b1u;
  return hash ^ (hash >> 15);
}

VKH_LIB_END
#endif
