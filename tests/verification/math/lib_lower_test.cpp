// shaders/math/lower.h against exact arithmetic: triangle_distance_down never exceeds the distance,
// in any arithmetic that Vulkan allows, and is seldom far below it.
#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/support/tally.h"
#include "tests/verification/model/exact_lib.h"
#include "tests/verification/model/lib_device.h"

using namespace vkh;
using namespace vkh::test;

namespace {

struct LowerCase {
  StoredTriangle triangle;
  Stored from;
  float enough;
  float base;
  bool whole;  ///< the triangle has a real area: tightness is tested
};

LowerCase hard_lower_case(Random& random) {
  const StoredTriangle t = hard_triangle(random);
  const glm::dvec3 p = hard_point(random, t);
  const Stored from = random.below(4) == 0 ? stored_single(p) : stored(p);
  const float enough = random.below(4) == 0 ? 0.0f : std::numeric_limits<float>::max();
  const glm::dvec3 ab = t.at(1) - t.at(0), ac = t.at(2) - t.at(0), bc = t.at(2) - t.at(1);
  const double longest = std::max({glm::length(ab), glm::length(ac), glm::length(bc)});
  return {t, from, enough, hard_base(random, t, p),
          glm::length(glm::cross(ab, ac)) > 0x1p-6 * longest * longest};
}

struct LowerAnswer {
  double value, slack, radius;
};

LowerAnswer distance_down(const LowerCase& c, const Device& device) {
  const float reach = length_up(c.from);
  return device.run([&]() -> LowerAnswer {
    const math::Surface s = math::surface_around(c.triangle, c.from, reach, true, c.base);
    return {math::wide(math::triangle_distance_down(s, c.enough)), math::wide(s.slack),
            math::wide(math::radius_up(s.at))};
  });
}

/// 8 ulp of the distance above the base, 48 bits of distance, base and the triangle's size, the
/// surface's slack, and 2^-34 for triangles of a few ulps, whose directions are rounding.
void check_tight(const LowerCase& c, const LowerAnswer& got, double near, Tally& tally,
                 const auto& describe) {
  const double base = static_cast<double>(c.base);
  const double left = near - base - got.value - 8.0 * 0x1p-23 * std::abs(near - base) -
                      0x1p-37 * (near + base) - 2.0 * got.slack - 0x1p-34;
  tally.count("whole triangles", true);
  tally.count("whole triangles, loose", left > 4e-12 * got.radius);
  tally.measure("looseness / triangle's radius", left / got.radius, describe);
}

}  // namespace

TEST_CASE("lower.h: triangle_distance_down never exceeds the distance, and is tight") {
  const uint64_t count = case_count();
  Random random(20240611);
  Tally tally("triangle_distance_down");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const LowerCase c = hard_lower_case(random);
    const Device device(i);
    const LowerAnswer got = distance_down(c, device);
    const Rational exact = ExactTriangle(c.triangle).squared_distance(fixed_vector(c.from));
    const double near = sqrt_near(exact);
    const auto describe = [&] {
      return std::string(device.name()) + ": " + hex(c.triangle) + " from " + hex(c.from) +
             (c.enough == 0.0f ? " coarse" : "") + " base " + hex(static_cast<double>(c.base)) +
             " got " + hex(got.value) + " exact " + hex(near);
    };
    const double base = static_cast<double>(c.base);
    tally.require(is_lower_bound(base, got.value, exact), "base + lower <= d(p, S)", describe);
    if (near == 0.0) continue;
    tally.measure("excess / slack", (base + got.value - near) / got.slack, describe);
    if (c.whole && c.enough != 0.0f) check_tight(c, got, near, tally, describe);
  }
  tally.conclude(count);
  const double loose = static_cast<double>(tally.counted("whole triangles, loose"));
  // This adds a few, if there are few cases.
  CHECK(loose <= 8.0 + Device::kRare * static_cast<double>(tally.counted("whole triangles")));
}
