// Products of vectors, written out: the built-in ones are sums whose order a driver may choose,
// which no decoration forbids (docs/certificate.md). Use only these: the build refuses the others.
#ifndef VKH_SHADERS_MATH_DOT_H
#define VKH_SHADERS_MATH_DOT_H

#include "shaders/math/glsl.h"

VKH_LIB_BEGIN

VKH_FN float dot3(vec3 a, vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

VKH_FN vec3 cross3(vec3 a, vec3 b) {
  return vec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
}

VKH_LIB_END
#endif
