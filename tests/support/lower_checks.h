// What is claimed of triangle_distance_down (shaders/lib/lower.h), checked exactly.
// Include after tests/support/lib_probe.h.
#pragma once

#include <algorithm>
#include <limits>

#include "tests/support/exact_lib.h"
#include "tests/support/lib_probe.h"
#include "tests/support/tally.h"

VKH_LIB_BEGIN

struct LowerCase {
  SurfaceCase surface;  ///< around the point that is measured from
  float enough;
  bool whole;  ///< the triangle has an area worth the name: tightness is asked
};

inline LowerCase hard_lower_case(test::Random& random) {
  const test::StoredTriangle t = test::hard_triangle(random);
  const glm::dvec3 p = test::hard_point(random, t);
  const test::Stored origin = random.below(4) == 0 ? test::stored_single(p) : test::stored(p);
  const float enough = random.below(4) == 0 ? 0.0f : std::numeric_limits<float>::max();
  const glm::dvec3 ab = t.at(1) - t.at(0), ac = t.at(2) - t.at(0), bc = t.at(2) - t.at(1);
  const double longest = std::max({glm::length(ab), glm::length(ac), glm::length(bc)});
  const bool whole = glm::length(glm::cross(ab, ac)) > 0x1p-6 * longest * longest;
  return {{t, origin, test::length_up(origin), true}, enough, whole};
}

inline void check_lower(const LowerCase& c, const Distance& got, const char* arithmetic,
                        test::Tally& tally) {
  const test::ExactTriangle t(c.surface.triangle);
  const test::Rational exact = t.squared_distance(test::fixed_vector(c.surface.origin));
  const double near = test::sqrt_near(exact);
  const double ulp = 0x1p-23;
  const auto describe = [&] {
    return std::string(arithmetic) + ": " + test::hex(c.surface.triangle) + " from " +
           test::hex(c.surface.origin) + " enough " + test::hex(static_cast<double>(c.enough)) +
           " got " + test::hex(static_cast<double>(got.value)) + " exact " + test::hex(near);
  };
  const double value = static_cast<double>(got.value);
  tally.require(test::is_lower_bound(value, exact), "lower <= d(p, S)", describe);
  if (near > 0.0) {
    tally.measure("excess over the distance, in ulp", (value / near - 1.0) / ulp, describe);
  }
  if (!c.whole || c.enough == 0.0f) return;
  const double size = static_cast<double>(got.radius);
  const bool tight = value >= near * (1.0 - 30.0 * ulp) - 4e-12 * size;
  tally.count("whole triangles", true);
  tally.count("whole triangles, loose", !tight);
  tally.measure("looseness / triangle's radius", (near - value - 30.0 * ulp * near) / size,
                describe);
  tally.measure("looseness in slacks, small distances",
                (near - value - 30.0 * ulp * near) / static_cast<double>(got.slack), describe);
}

inline void conclude_lower(const test::Tally& tally, uint64_t count) {
  tally.conclude(count);
  CHECK(1000 * tally.counted("whole triangles, loose") <= tally.counted("whole triangles"));
}

VKH_LIB_END
