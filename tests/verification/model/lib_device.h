// The shared headers as `math::`, and the arithmetics that a test runs them in: the CPU's, in every
// rounding direction, flushed or not; or, where VKH_TEST_VULKAN_MODEL is defined, the model of
// Vulkan's (vulkan_model.h). Include last: it redefines float for the headers.
#pragma once

#include "tests/shapes/adversarial.h"
#include "tests/verification/model/arithmetic.h"

#ifdef VKH_TEST_VULKAN_MODEL
#include "tests/verification/model/vulkan_model.h"
#define float ::vkh::model::Real
#else
#include "shaders/math/glsl.h"
VKH_LIB_BEGIN
using std::sqrt;  // or <cmath> offers double's alone
VKH_LIB_END
#endif

#include "shaders/math/bary.h"
#include "shaders/math/bounds.h"
#include "shaders/math/lower.h"
#include "shaders/paper/bounds_paper.h"

#undef float

#ifdef VKH_TEST_VULKAN_MODEL
namespace math = vkh::model;

namespace vkh::test {
/// Case i's arithmetic.
struct Device {
  static constexpr double kRare = 3e-3;
  explicit Device(uint64_t i) : seed(i) {}
  const char* name() const {
    constexpr const char* kNames[] = {"nearest", "up", "down", "to zero", "from zero", "any"};
    return kNames[static_cast<int>(direction())];
  }
  bool nearest() const { return direction() == model::Direction::kNearest; }
  template <class F>
  auto run(const F& f) const {
    model::whim = {direction(), seed % 4 == 0, 0x9e3779b97f4a7c15ull * (seed + 1)};
    return f();
  }
  /// Half of the cases draw each operation's direction.
  model::Direction direction() const {
    const uint64_t d = seed % 10;
    return d < 5 ? static_cast<model::Direction>(d) : model::Direction::kAny;
  }
  uint64_t seed;
};
}  // namespace vkh::test
#else
namespace math = vkh::lib;

namespace vkh::test {
struct Device {
  static constexpr double kRare = 1e-3;  ///< share of the cases that may be loose
  explicit Device(uint64_t i) : arithmetic(kArithmetics[i % kArithmetics.size()]) {}
  const char* name() const { return arithmetic.name; }
  bool nearest() const { return arithmetic.nearest(); }
  template <class F>
  auto run(const F& f) const {
    return under(arithmetic, f);
  }
  Arithmetic arithmetic;
};
}  // namespace vkh::test
#endif

// Conversions from and to plain floats.
VKH_LIB_BEGIN

inline vec3 given(const glm::vec3& v) { return vec3(v.x, v.y, v.z); }
inline Two3 given(const test::Stored& p) {
  Two3 out;
  out.hi = given(p.hi);
  out.lo = given(p.lo);
  return out;
}
inline Corners given_high(const test::StoredTriangle& t) {
  return {given(t.corner[0].hi), given(t.corner[1].hi), given(t.corner[2].hi)};
}

template <class F>
float answer(F x) {
  return static_cast<float>(x);
}
inline glm::vec3 answer(const vec3& v) { return {answer(v.x), answer(v.y), answer(v.z)}; }
inline test::Stored answer(const Two3& p) { return {answer(p.hi), answer(p.lo)}; }
template <class F>
double wide(F x) {
  return static_cast<double>(answer(x));
}

/// The triangle around `origin`, for points within `reach` of it; coarse where its slack is then no
/// more than `enough`.
inline Surface surface_around(const test::StoredTriangle& t, const test::Stored& origin,
                              float reach, bool sharp, float base = 0.0f, float enough = 0.0f,
                              bool fine = false) {
  View from;
  from.origin = given(origin);
  from.reach = reach;
  from.base = base;
  from.sharp = sharp;
  from.plain = false;
  from.enough = enough;
  from.fine = fine;
  return make_surface(given(t.corner[0]), given(t.corner[1]), given(t.corner[2]), from);
}

VKH_LIB_END
