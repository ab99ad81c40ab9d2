// Doubles in place of the GLSL in which the headers of shaders/math are written, so that their text
// is compiled with double for float (host/native/math.h). It stands in for shaders/math/glsl.h,
// whose include guard it takes: a source that includes this sees no float version of them.
#pragma once

#ifdef VKH_SHADERS_MATH_GLSL_H
#error "include host/native before shaders/math, and not both in one source"
#endif
#define VKH_SHADERS_MATH_GLSL_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <type_traits>

#include "shaders/gpu_types.h"

#define VKH_LIB_BEGIN namespace vkh::native {
#define VKH_LIB_END }
// A surface is 300 bytes, which a call copies.
#define VKH_FN [[gnu::always_inline]] inline
#define VKH_OUT(type) type&
#define VKH_PRECISE

namespace vkh::native {

using uint = uint32_t;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using gpu::kBaryOne;
using gpu::kClassDegenerate;
using gpu::kClassEdge;
using gpu::kClassOver;
using gpu::kClassTwoSided;
using gpu::kClassUnder;
using gpu::kClassUnseen;
using gpu::kFaceBare;
using gpu::kFaceTwoSided;
using gpu::kNone;
using gpu::kThinQuality;

struct vec3 {
  double x, y, z;

  vec3() = default;
  vec3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  explicit vec3(const glm::dvec3& v) : x(v.x), y(v.y), z(v.z) {}
};
inline vec3 operator+(const vec3& a, const vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline vec3 operator-(const vec3& a, const vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline vec3 operator-(const vec3& a) { return {-a.x, -a.y, -a.z}; }
inline vec3 operator*(double s, const vec3& a) { return {s * a.x, s * a.y, s * a.z}; }

inline double abs(double x) { return std::fabs(x); }
inline double min(double x, double y) { return y < x ? y : x; }
inline double max(double x, double y) { return x < y ? y : x; }
inline double clamp(double x, double lo, double hi) { return min(max(x, lo), hi); }
inline vec3 min(const vec3& a, const vec3& b) {
  return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}
inline double sqrt(double x) { return std::sqrt(x); }

// The GLSL uses the bits of a float to steer by a low bit or to scale by an exponent. Doubles do
// both in other ways, so these functions have no definition: a use does not link.
uint floatBitsToUint(double x);
double uintBitsToFloat(uint bits);

}  // namespace vkh::native
