// The shared headers asked from plain floats and answering in them, so that one test serves them as
// compiled for the CPU and on the model of Vulkan's arithmetic (vulkan_model.h).
// Include after shaders/lib/lower.h, bounds.h and bary.h, or what stands in for their floats.
#pragma once

#ifndef VKH_TEST_VULKAN_MODEL
#include "shaders/lib/glsl.h"
VKH_LIB_BEGIN
using std::sqrt;  // or <cmath> offers the headers double's alone
VKH_LIB_END
#endif

#include "shaders/lib/bary.h"
#include "shaders/lib/bounds.h"
#include "shaders/lib/lower.h"
#include "tests/support/adversarial.h"

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
inline test::StoredTriangle answer(const Corners& t) {
  return {{{{answer(t.a), glm::vec3(0.0f)}, {answer(t.b), glm::vec3(0.0f)},
            {answer(t.c), glm::vec3(0.0f)}}}};
}

/// A triangle around a local origin, and how it is to be measured.
struct SurfaceCase {
  test::StoredTriangle triangle;
  test::Stored origin;
  float reach;  ///< >= |origin|, and |p| of what is measured
  bool sharp;
};

inline Surface surface_of(const SurfaceCase& c) {
  const auto& corner = c.triangle.corner;
  View from;
  from.origin = given(c.origin);
  from.reach = c.reach;
  from.sharp = c.sharp;
  return make_surface(given(corner[0]), given(corner[1]), given(corner[2]), from);
}

struct Distance {
  float value, slack, radius;
};

inline Distance distance_up(const SurfaceCase& c, const test::Stored& p) {
  const Surface s = surface_of(c);
  return {answer(surface_distance_up(given(p), s)), answer(s.slack), answer(radius_up(s.at))};
}
inline Distance distance_down(const SurfaceCase& c, float enough) {
  const Surface s = surface_of(c);
  return {answer(triangle_distance_down(s, enough)), answer(s.slack), answer(radius_up(s.at))};
}

VKH_LIB_END
