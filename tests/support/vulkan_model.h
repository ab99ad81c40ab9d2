// The precision table of the Vulkan specification as a number type, for the shared headers to be
// compiled with in place of float: + - * round in a direction drawn anew for every operation, a
// quotient is any float within 2.5 ulp, an inverse square root within 2 and a root its quotient,
// and what is below 2^-126 may be 0. No device is as bad; a bound that holds here holds on all.
// Stands in for shaders/lib/glsl.h, whose include guard it takes.
#pragma once

#ifdef VKH_SHADERS_LIB_GLSL_H
#error "include tests/support/vulkan_model.h before shaders/lib"
#endif
#define VKH_SHADERS_LIB_GLSL_H

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "shaders/gpu_types.h"

#define VKH_LIB_BEGIN namespace vkh::model {
#define VKH_LIB_END }
#define VKH_FN inline
#define VKH_OUT(type) type&
#define VKH_PRECISE

namespace vkh::model {

using uint = uint32_t;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using namespace vkh::gpu;

enum class Direction { kNearest, kUp, kDown, kToZero, kFromZero, kAny, kScript };

/// How the operations that follow go wrong.
struct Whim {
  Direction direction = Direction::kNearest;
  bool flush = false;
  uint64_t state = 1;
  std::array<uint64_t, 8> script{};  ///< kScript: bit i says that operation i rounds up
  uint32_t operation = 0;

  uint64_t draw() {  // xorshift64*
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return state * 0x2545f4914f6cdd1dull;
  }
  /// Whether a result at or around x is to be the larger one.
  bool upward(double x) {
    switch (direction) {
      case Direction::kUp:
        return true;
      case Direction::kDown:
        return false;
      case Direction::kToZero:
        return x < 0;
      case Direction::kFromZero:
        return x > 0;
      case Direction::kScript: {
        const uint32_t i = operation++;
        return (script[i / 64 % script.size()] >> (i % 64) & 1u) != 0;
      }
      default:
        return (draw() >> 40 & 1u) != 0;
    }
  }
};
inline Whim whim;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

inline float flushed(float x) {
  const bool small = std::abs(x) < std::numeric_limits<float>::min();
  if (!small || !whim.flush || (whim.direction == Direction::kAny && (whim.draw() >> 63))) return x;
  return std::copysign(0.0f, x);
}

/// value + error to a float on one side of it; error is under half an ulp of the double value.
inline float to_one_side(double value, double error) {
  const float near = static_cast<float>(value);
  const double left = (value - static_cast<double>(near)) + error;
  if (left == 0.0 || whim.direction == Direction::kNearest) return flushed(near);
  if (whim.upward(value) == (left > 0.0)) {
    return flushed(std::nextafter(near, left > 0.0 ? kInfinity : -kInfinity));
  }
  return flushed(near);
}

/// A float within so many ulp of value, the farthest but for kAny and kNearest.
inline float within(double value, double ulps) {
  float out = static_cast<float>(value);
  if (whim.direction == Direction::kNearest || value == 0.0 || !std::isfinite(out)) return out;
  const double ulp = std::ldexp(1.0, std::ilogb(value) - 23);
  const float toward = whim.upward(value) ? kInfinity : -kInfinity;
  uint64_t steps = whim.direction == Direction::kAny ? whim.draw() >> 61 : 8;
  for (; steps > 0; --steps) {
    const float next = std::nextafter(out, toward);
    if (std::abs(static_cast<double>(next) - value) > ulps * ulp) break;
    out = next;
  }
  return flushed(out);
}

class Real {
 public:
  constexpr Real() = default;
  constexpr Real(float x) : value_(x) {}  // NOLINT: literals of the headers
  constexpr explicit Real(int x) : value_(static_cast<float>(x)) {}
  constexpr explicit Real(uint x) : value_(static_cast<float>(x)) {}
  constexpr explicit operator float() const { return value_; }

  friend Real operator+(Real a, Real b) {
    const double x = a.wide(), y = b.wide(), s = x + y;
    const double from_y = s - x;
    return to_one_side(s, (x - (s - from_y)) + (y - from_y));
  }
  friend Real operator-(Real a, Real b) { return a + -b; }
  friend Real operator*(Real a, Real b) { return to_one_side(a.wide() * b.wide(), 0.0); }
  friend Real operator/(Real a, Real b) { return within(a.wide() / b.wide(), 2.5); }
  friend Real operator-(Real a) { return -a.value_; }
  friend bool operator<(Real a, Real b) { return a.value_ < b.value_; }
  friend bool operator>(Real a, Real b) { return a.value_ > b.value_; }
  friend bool operator<=(Real a, Real b) { return a.value_ <= b.value_; }
  friend bool operator>=(Real a, Real b) { return a.value_ >= b.value_; }
  friend Real sqrt(Real x) {
    if (x.value_ == 0.0f) return 0.0f;
    const float inverse = within(1.0 / std::sqrt(x.wide()), 2.0);
    return within(1.0 / static_cast<double>(inverse), 2.5);
  }
  friend uint floatBitsToUint(Real x) { return std::bit_cast<uint>(x.value_); }

 private:
  double wide() const { return static_cast<double>(value_); }
  float value_ = 0.0f;
};

inline Real uintBitsToFloat(uint x) { return std::bit_cast<float>(x); }
inline Real min(Real a, Real b) { return b < a ? b : a; }
inline Real max(Real a, Real b) { return a < b ? b : a; }
inline Real clamp(Real x, Real lo, Real hi) { return min(max(x, lo), hi); }
inline Real abs(Real x) { return x < 0.0f ? -x : x; }

struct vec3 {
  Real x, y, z;
  vec3() = default;
  vec3(Real a, Real b, Real c) : x(a), y(b), z(c) {}
  friend vec3 operator+(vec3 a, vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend vec3 operator-(vec3 a, vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend vec3 operator-(vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend vec3 operator*(Real s, vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend vec3 operator*(vec3 a, Real s) { return s * a; }
};
inline Real dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline vec3 cross(vec3 a, vec3 b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

}  // namespace vkh::model
