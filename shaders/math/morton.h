// Morton codes and order-preserving bits of floats.
#ifndef VKH_SHADERS_MATH_MORTON_H
#define VKH_SHADERS_MATH_MORTON_H

#include "shaders/math/certified.h"

VKH_LIB_BEGIN

// Spreads the low 10 bits of x so that two zero bits follow each.
VKH_FN uint spread_bits(uint x) {
  x = (x * 0x00010001u) & 0xff0000ffu;
  x = (x * 0x00000101u) & 0x0f00f00fu;
  x = (x * 0x00000011u) & 0xc30c30c3u;
  x = (x * 0x00000005u) & 0x49249249u;
  return x;
}

// 30-bit Morton code of a point in the unit cube; points outside are clamped to it.
VKH_FN uint morton30(vec3 p) {
  vec3 q = clamp(p * 1024.0f, vec3(0.0f), vec3(1023.0f));
  return (spread_bits(uint(q.x)) << 2) | (spread_bits(uint(q.y)) << 1) | spread_bits(uint(q.z));
}

// Bits whose unsigned order is the order of the floats they come from, and back.
VKH_FN uint ordered_bits(uint bits) {
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
VKH_FN uint from_ordered_bits(uint key) {
  return (key & 0x80000000u) != 0u ? key & 0x7fffffffu : ~key;
}

VKH_LIB_END
#endif
