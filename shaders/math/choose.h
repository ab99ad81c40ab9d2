// Choices without branches: `?:`, && and || become branches, and a driver takes longer for hundreds
// of them than for the arithmetic between (docs/log/startup.md). All operands are evaluated.
#ifndef VKH_SHADERS_MATH_CHOOSE_H
#define VKH_SHADERS_MATH_CHOOSE_H

#include "shaders/math/glsl.h"
#ifdef __cplusplus
#include <type_traits>
#endif

VKH_LIB_BEGIN

#ifdef __cplusplus
template <class T>
inline T choose(bool first, T x, std::type_identity_t<T> y) {
  return first ? x : y;
}
inline bool both(bool x, bool y) { return x && y; }
inline bool either(bool x, bool y) { return x || y; }
#else
// x if `first`, else y.
uint choose(bool first, uint x, uint y) { return mix(y, x, first); }
uvec2 choose(bool first, uvec2 x, uvec2 y) { return mix(y, x, bvec2(first)); }
float choose(bool first, float x, float y) { return mix(y, x, first); }
vec3 choose(bool first, vec3 x, vec3 y) { return mix(y, x, bvec3(first)); }
bool both(bool x, bool y) { return all(bvec2(x, y)); }
bool either(bool x, bool y) { return any(bvec2(x, y)); }
#endif

VKH_LIB_END
#endif
