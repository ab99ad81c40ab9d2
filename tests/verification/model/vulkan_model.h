// The precision table of the Vulkan specification as a number type, for the shared headers to be
// compiled with in place of float: + - * round in a direction drawn anew for every operation, a
// quotient is any float within 2.5 ulp, an inverse square root within 2 and a root its quotient,
// and a result below 2^-126 may be 0. No device is as bad; a bound that holds here holds on all.
// Stands in for shaders/math/glsl.h, whose include guard it takes.
#pragma once

#ifdef VKH_SHADERS_MATH_GLSL_H
#error "include tests/verification/model/vulkan_model.h before shaders/math"
#endif
#define VKH_SHADERS_MATH_GLSL_H

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
#define VKH_MODEL_JOIN_(a, b) a##b
#define VKH_MODEL_JOIN(a, b) VKH_MODEL_JOIN_(a, b)
// Acts from its line to the end of the block, as `precise` reaches all parts of its variable.
#ifdef VKH_MODEL_REGROUPS
#define VKH_PRECISE const vkh::model::PreciseBlock VKH_MODEL_JOIN(precise_block_, __LINE__);
#else
#define VKH_PRECISE
#endif

namespace vkh::model {

using uint = uint32_t;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using namespace vkh::gpu;

enum class Direction { kNearest, kUp, kDown, kToZero, kFromZero, kAny, kScript };

/// The errors of the operations that follow.
struct Whim {
  Direction direction = Direction::kNearest;
  bool flush = false;
  uint64_t state = 1;
  std::array<uint64_t, 8> script{};  ///< kScript: bit i makes operation i round up
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

/// The decorated operations: all, as in the build, or only the ones that are `precise` in the
/// headers.
enum class Decorations { kAll, kPrecise };
inline Decorations decorations = Decorations::kAll;
inline int precise_blocks = 0;
struct PreciseBlock {
  PreciseBlock() { ++precise_blocks; }
  ~PreciseBlock() { --precise_blocks; }
  PreciseBlock(const PreciseBlock&) = delete;
};
inline bool may_rearrange() { return decorations == Decorations::kPrecise && precise_blocks == 0; }

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A small value may be flushed; a zero may lose its sign.
inline float flushed(float x) {
  if (std::abs(x) >= std::numeric_limits<float>::min()) return x;
  const bool any = whim.direction == Direction::kAny;
  if (x == 0.0f) return any && (whim.draw() >> 63) != 0 ? -x : x;
  if (!whim.flush || (any && (whim.draw() >> 63) != 0)) return x;
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

/// A float within `ulps` ulp of value: the farthest, except for kAny and kNearest.
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

/// A root that the table does not cover: 1 / inversesqrt(x) where x is 0 or may be flushed to it.
inline float uncovered_root() {
  constexpr float kAnything[] = {0.0f, kInfinity, std::numeric_limits<float>::quiet_NaN(), 1.0f};
  return kAnything[whim.draw() >> 62];
}

inline float sum_of(float a, float b) {
  const double x = static_cast<double>(a), y = static_cast<double>(b), s = x + y;
  const double from_y = s - x;
  return to_one_side(s, (x - (s - from_y)) + (y - from_y));
}
inline float product_of(float a, float b) {
  return to_one_side(static_cast<double>(a) * static_cast<double>(b), 0.0);
}

/// The terms from which a sum may be rearranged; none unless operations may be.
#ifdef VKH_MODEL_REGROUPS
class Terms {
 public:
  Terms() = default;
  /// The terms of both, or their values if they have none; none at all if they are too many.
  Terms(const Terms& a, float value_a, const Terms& b, float value_b) {
    if (!may_rearrange()) return;
    add(a, value_a);
    add(b, value_b);
    if (count_ > kMost) count_ = 0;
  }
  uint32_t count() const { return count_; }
  Terms negated() const { return times(-1.0f); }
  Terms times(float factor) const {
    Terms out;
    for (uint32_t i = 0; i < count_ && may_rearrange(); ++i)
      out.term_[out.count_++] = factor == -1.0f ? -term_[i] : product_of(factor, term_[i]);
    return out;
  }
  /// Sums in a random order, opposite terms first or not.
  float sum() const {
    Terms left = *this;
    if (whim.upward(0.0)) left.cancel();
    float s = left.count_ > 0 ? left.take() : 0.0f;
    while (left.count_ > 0) s = sum_of(s, left.take());
    return s;
  }

 private:
  static constexpr uint32_t kMost = 8;
  void add(const Terms& from, float value) {
    if (from.count_ == 0) term_[count_++] = value;
    for (uint32_t i = 0; i < from.count_; ++i) term_[count_++] = from.term_[i];
  }
  float take() {
    uint32_t at = 0;
    while (at + 1 < count_ && whim.upward(0.0)) ++at;
    const float taken = term_[at];
    term_[at] = term_[--count_];
    return taken;
  }
  void cancel() {
    for (uint32_t i = 0; i < count_; ++i) {
      for (uint32_t j = i + 1; j < count_; ++j) {
        if (term_[i] != -term_[j]) continue;
        term_[j] = term_[--count_];
        term_[i--] = term_[--count_];
        break;
      }
    }
  }
  std::array<float, 2 * kMost> term_{};
  uint32_t count_ = 0;
};
#else
struct Terms {
  Terms() = default;
  Terms(const Terms&, float, const Terms&, float) {}
  static uint32_t count() { return 0; }
  Terms negated() const { return {}; }
  Terms times(float) const { return {}; }
  static float sum() { return 0.0f; }
};
#endif

class Real {
 public:
  constexpr Real() = default;
  constexpr Real(float x) : value_(x) {}  // NOLINT: literals of the headers
  constexpr explicit Real(int x) : value_(static_cast<float>(x)) {}
  constexpr explicit Real(uint x) : value_(static_cast<float>(x)) {}
  constexpr explicit operator float() const { return value_; }

  friend Real operator+(const Real& a, const Real& b) {
    const Terms terms(a.terms_, a.value_, b.terms_, b.value_);
    if (terms.count() == 0) return sum_of(a.value_, b.value_);
    return {terms.sum(), terms};
  }
  friend Real operator-(const Real& a, const Real& b) { return a + -b; }
  friend Real operator*(const Real& a, const Real& b) {
    const bool first = a.terms_.count() > 0;
    const Terms terms = first ? a.terms_.times(b.value_) : b.terms_.times(a.value_);
    if (terms.count() == 0) return product_of(a.value_, b.value_);
    return {terms.sum(), terms};
  }
  friend Real operator/(const Real& a, const Real& b) { return within(a.wide() / b.wide(), 2.5); }
  friend Real operator-(const Real& a) { return {-a.value_, a.terms_.negated()}; }
  friend bool operator<(const Real& a, const Real& b) { return a.value_ < b.value_; }
  friend bool operator>(const Real& a, const Real& b) { return a.value_ > b.value_; }
  friend bool operator<=(const Real& a, const Real& b) { return a.value_ <= b.value_; }
  friend bool operator>=(const Real& a, const Real& b) { return a.value_ >= b.value_; }
  friend Real sqrt(const Real& x) {
    if (x.value_ < std::numeric_limits<float>::min()) return uncovered_root();
    const float inverse = within(1.0 / std::sqrt(x.wide()), 2.0);
    return within(1.0 / static_cast<double>(inverse), 2.5);
  }
  friend uint floatBitsToUint(const Real& x) { return std::bit_cast<uint>(x.value_); }

 private:
  Real(float value, const Terms& terms) : value_(value), terms_(terms) {}
  double wide() const { return static_cast<double>(value_); }
  float value_ = 0.0f;
  [[no_unique_address]] Terms terms_;
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
inline vec3 min(const vec3& a, const vec3& b) {
  return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}

}  // namespace vkh::model
