// shaders/math/triangle.h against exact arithmetic: closest points lie in their triangle, distances
// and radii are never below the exact ones and seldom far above, in any arithmetic Vulkan allows.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/tally.h"
#include "tests/verification/model/exact_lib.h"
#include "tests/verification/model/lib_device.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr double kTriangleUlp = 0x1p-23;

double longest_edge(const StoredTriangle& t) {
  return std::max({glm::length(t.at(1) - t.at(0)), glm::length(t.at(2) - t.at(0)),
                   glm::length(t.at(2) - t.at(1))});
}

/// Twice the area over the square of the longest edge.
double quality_of(const StoredTriangle& t) {
  const double longest = longest_edge(t);
  return glm::length(glm::cross(t.at(1) - t.at(0), t.at(2) - t.at(0))) / (longest * longest);
}

struct UpperCase {
  StoredTriangle triangle;
  Stored origin, p;  ///< p is relative to the origin
  float base;
  bool sharp, coarse, fine;
};

/// Local origins like the kernels', close to p, and anywhere.
UpperCase hard_upper_case(Random& random) {
  const StoredTriangle t = hard_triangle(random);
  const glm::dvec3 p = hard_point(random, t);
  glm::dvec3 origin = p;
  switch (random.below(5)) {
    case 0:
      break;
    case 1:
      origin = t.at(random.below(3));
      break;
    case 2:
      origin = random.in_cube(1.0);
      break;
    case 3:
      origin = glm::dvec3(0.0);
      break;
    default:
      origin += log_uniform(random, -24, 0) * random.direction();
  }
  const Stored o = random.below(4) == 0 ? stored_single(origin) : stored(origin);
  return {t,
          o,
          stored(p - o.value()),
          hard_base(random, t, p),
          random.below(2) == 0,
          random.below(2) == 0,
          random.below(2) == 0};
}

std::string describe_upper(const UpperCase& c) {
  return hex(c.triangle) + " around " + hex(c.origin) + " p " + hex(c.p) +
         (c.sharp ? " sharp" : "") + (c.coarse ? " coarse" : "") + (c.fine ? " fine" : "") +
         " base " + hex(static_cast<double>(c.base));
}

struct UpperAnswer {
  double distance, slack, radius, plain;
  Stored offset, nearer;
  float v, w;
  uint32_t feature;
  float step_v, step_w;
  bool near;
};

UpperAnswer distance_up(const UpperCase& c, const Device& device) {
  const float reach = std::max(length_up(c.origin), length_up(c.p));
  return device.run([&]() -> UpperAnswer {
    const math::Surface s = math::surface_around(c.triangle, c.origin, reach, c.sharp, c.base,
                                                 c.coarse ? 1e30f : 0.0f, c.fine);
    const math::Two3 p = math::given(c.p);
    const math::Closest at = math::closest_point(math::rounded(p), s.at);
    math::Two3 offset{}, nearer{};
    math::Step step{};
    if (!c.coarse) {
      offset = math::offset_from(p, s, at);
      const math::Edges e = math::edges_from_base(s, at);
      step = math::step_to_foot(math::rounded(offset), e.to_end.hi, e.to_third.hi, at);
      nearer = math::stepped_offset(offset, e, step);
    }
    return {math::wide(math::surface_distance_up(p, s)),
            math::wide(s.slack),
            math::wide(math::radius_up(s.at)),
            math::wide(math::plain_distance2(math::rounded(p), s.at)),
            math::answer(offset),
            math::answer(nearer),
            math::answer(at.v),
            math::answer(at.w),
            at.feature,
            math::answer(step.v),
            math::answer(step.w),
            !c.coarse && math::is_near(offset, s)};
  });
}

/// The point that the answer names, times 2^150: relative to the case's origin.
exact::Vector named_point(const UpperAnswer& got, const ExactTriangle& local) {
  const Integer one = fixed(1.0), v = fixed(static_cast<double>(got.v)),
                w = fixed(static_cast<double>(got.w));
  const exact::Vector& base = got.feature == math::kEdgeBc ? local.b : local.a;
  const bool ends_at_c = got.feature == math::kEdgeBc || got.feature == math::kEdgeAc;
  const exact::Vector& end = ends_at_c ? local.c : local.b;
  return one * base + v * (end - base) + w * (local.c - base);
}

/// The same after the step.
exact::Vector stepped_point(const UpperAnswer& got, const ExactTriangle& local) {
  const Integer one = fixed(1.0),
                v = fixed(static_cast<double>(got.v)) + fixed(static_cast<double>(got.step_v)),
                w = fixed(static_cast<double>(got.w)) + fixed(static_cast<double>(got.step_w));
  const bool on_bc = got.feature == math::kEdgeBc, on_ac = got.feature == math::kEdgeAc;
  const exact::Vector& base = on_bc ? local.b : local.a;
  const exact::Vector& end = on_bc || on_ac ? local.c : local.b;
  const exact::Vector& third = on_bc ? local.a : on_ac ? local.b : local.c;
  return one * base + v * (end - base) + w * (third - base);
}

/// Checks the step of a point next to the triangle: it stays in it, and the slack holds its error.
void check_step(const UpperCase& c, const UpperAnswer& got, const ExactTriangle& local,
                Tally& tally, const auto& describe) {
  const Integer v = fixed(static_cast<double>(got.v)) + fixed(static_cast<double>(got.step_v));
  const Integer w = fixed(static_cast<double>(got.w)) + fixed(static_cast<double>(got.step_w));
  tally.require(v >= 0 && w >= 0 && v + w <= fixed(1.0), "a step stays in the triangle", describe);
  if (!got.near) return;
  const double off = length_near(
      fixed(1.0) * (fixed_vector(c.p) - fixed_vector(got.nearer)) - stepped_point(got, local),
      2 * kFixedBits);
  tally.require(off <= got.slack, "stepped_offset is off by at most slack", describe);
  tally.measure("stepped_offset, error / slack", off / got.slack, describe);
}

void check_weights(const UpperAnswer& got, Tally& tally, const auto& describe) {
  const double v = static_cast<double>(got.v), w = static_cast<double>(got.w);
  tally.require(v >= 0.0 && w >= 0.0 && fixed(v) + fixed(w) <= fixed(1.0),
                "0 <= v, w and v + w <= 1", describe);
  tally.require(got.feature <= math::kInside && (got.feature == math::kInside || w == 0.0),
                "w is 0 on an edge", describe);
}

/// The excess over d (1 + 24 ulp) + 2 slack comes from the foot, which is found in float32, and
/// from the choice of the closest feature: a few ulp of the local coordinates. An edge that is
/// taken for a point (kSmallSquare) adds itself. A sharp distance is good to 48 bits of itself and
/// 16 ulp of its part above the base.
void check_loose(const UpperCase& c, const UpperAnswer& got, double near, Tally& tally,
                 const auto& describe) {
  const double size = got.radius + glm::length(c.p.value());
  const double base = static_cast<double>(c.base);
  const double fine = 0x1p-38 * (near + base);  // 64 kUlp2
  const double above = near - base;
  const bool sharp = c.sharp && !c.coarse;
  const double allowed = sharp ? 16.0 * kTriangleUlp * std::abs(above) + fine
                               : kTriangleUlp * (24.0 * near + 16.0 * std::abs(above));
  const double rest = got.distance - above - allowed - 2.0 * got.slack - 0x1p-46;
  const double ulps = rest / (size * kTriangleUlp);
  tally.require(size == 0.0 || ulps <= 6.0, "upper is tight", describe);
  if (size > 0x1p-20) tally.measure("rest, ulp of the coordinates", ulps, describe);
  if (!sharp || near <= 0x1p-3 * size || near < 0x1p-30) return;
  tally.measure("a far distance's excess, kUlp2 of distance and base",
                (got.distance - above - 16.0 * kTriangleUlp * std::abs(above) - 2.0 * got.slack) /
                    (0x1p-44 * (near + base)),
                describe);
}

/// A coarse surface's slack, with 4 ulp of the distance and 3 of the square's own, covers the error
/// of plain floats.
void check_coarse(const UpperAnswer& got, double near, Tally& tally, const auto& describe) {
  const double short_of = near - std::sqrt(got.plain) * (1.0 + 7.0 * kTriangleUlp);
  tally.require(short_of <= got.slack + 0x1p-60, "plain_distance2 is off by at most the slack",
                describe);
  tally.measure("plain_distance2, error / slack", short_of / got.slack, describe);
}

}  // namespace

TEST_CASE("triangle.h: surface_distance_up is never below the distance, and is tight") {
  const uint64_t count = case_count();
  Random random(20240616);
  Tally tally("surface_distance_up");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const UpperCase c = hard_upper_case(random);
    const Device device(i);
    const UpperAnswer got = distance_up(c, device);
    const ExactTriangle local = ExactTriangle(c.triangle).moved(fixed_vector(c.origin));
    const exact::Vector p = fixed_vector(c.p);
    const Rational exact = local.squared_distance(p);
    const double near = sqrt_near(exact);
    const auto describe = [&] {
      return std::string(device.name()) + ": " + describe_upper(c) + " got " + hex(got.distance) +
             " exact " + hex(near);
    };
    tally.require(is_upper_bound(static_cast<double>(c.base), got.distance, exact),
                  "base + upper >= d(p, S)", describe);
    check_weights(got, tally, describe);
    if (c.coarse) {
      check_coarse(got, near, tally, describe);
    } else {
      const double off = length_near(
          fixed(1.0) * (p - fixed_vector(got.offset)) - named_point(got, local), 2 * kFixedBits);
      tally.require(off <= got.slack, "offset_from is off by at most slack", describe);
      tally.measure("offset_from, error / slack", off / got.slack, describe);
      check_step(c, got, local, tally, describe);
    }
    check_loose(c, got, near, tally, describe);
  }
  tally.conclude(4 * count);
}

namespace {

/// Weights of a point next to a corner of a triangle, by 2^-30 to 2^-10 of it, or next to an edge
/// there.
glm::dvec3 next_to_corner(Random& random) {
  const double beside = log_uniform(random, -30, -10);
  const double turned = random.below(2) == 0 ? random.unit() : log_uniform(random, -20, -1);
  const glm::dvec3 w(1.0 - beside, beside * turned, beside * (1.0 - turned));
  const uint32_t turn = random.below(3);
  return {w[turn], w[(turn + 1) % 3], w[(turn + 2) % 3]};
}

/// Above the inside of a triangle that is no sliver, by 2^-44 to 2^-18 of its size; seen from
/// there.
UpperCase near_case(Random& random) {
  StoredTriangle t;
  do {
    t = hard_triangle(random);
  } while (longest_edge(t) < 0x1p-10 || quality_of(t) < 0.05);
  const glm::dvec3 n = glm::cross(t.at(1) - t.at(0), t.at(2) - t.at(0));
  const double height = log_uniform(random, -44, -18) * longest_edge(t);
  const glm::dvec3 weights = random.below(2) == 0 ? barycentrics(random) : next_to_corner(random);
  const glm::dvec3 p = on_triangle(t, weights) + height * glm::normalize(n);
  return {t, stored(p), stored(p - stored(p).value()), 0.0f, false, false, true};
}

}  // namespace

// In plain floats the foot is off by kUlp of the triangle: so long the shortest distance would be.
TEST_CASE("triangle.h: in a fine run a point next to a triangle is as near as it is") {
  const uint64_t count = case_count() / 4;
  Random random(20261127);
  Tally tally("a fine surface_distance_up next to a triangle");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const UpperCase c = near_case(random);
    const Device device(i);
    const UpperAnswer got = distance_up(c, device);
    const ExactTriangle local = ExactTriangle(c.triangle).moved(fixed_vector(c.origin));
    const Rational exact = local.squared_distance(fixed_vector(c.p));
    const double near = sqrt_near(exact);
    const auto describe = [&] {
      return std::string(device.name()) + ": " + describe_upper(c) + " got " + hex(got.distance) +
             " exact " + hex(near);
    };
    tally.require(is_upper_bound(0.0, got.distance, exact), "upper >= d(p, S)", describe);
    const double rest = got.distance - near * (1 + 24 * kTriangleUlp) - 2 * got.slack - 0x1p-46;
    const double size = longest_edge(c.triangle);
    tally.require(rest <= 0x1p-34 * size, "upper is tight", describe);
    tally.measure("rest, 2^-34 of the triangle", rest / (0x1p-34 * size), describe);
    check_step(c, got, local, tally, describe);
  }
  tally.conclude(2 * count);
}

namespace {

struct Radii {
  double enclosing, corner;
  uint32_t opposite;
  double quality;
};

Rational squared_edge(const ExactTriangle& t, uint32_t opposite) {
  return square_of(opposite == 0 ? t.c - t.b : opposite == 1 ? t.a - t.c : t.b - t.a);
}

void check_steering(const StoredTriangle& t, const ExactTriangle& exact, const Radii& got,
                    Tally& tally, const auto& describe) {
  const double longest = longest_edge(t);
  const double chosen = sqrt_near(squared_edge(exact, got.opposite));
  tally.require(chosen >= longest * (1.0 - 8.0 * kTriangleUlp) - 0x1p-60,
                "opposite_longest names a longest edge", describe);
  const exact::Vector n = exact::cross(exact.b - exact.a, exact.c - exact.a);
  const double area = length_near(n, 2 * kFixedBits);
  const double quality = longest > 0.0 ? area / (longest * longest) : 0.0;
  tally.require(got.quality >= 0.0 && got.quality < 1.0, "quality is in [0, 1)", describe);
  // Under 2^-24, ratio sees a fourth power under kSmallSquare; above it, area may be flushed.
  if (longest < 0x1p-16) return;
  tally.measure("quality off", std::abs(got.quality - quality), describe);
  tally.require(std::abs(got.quality - quality) <= 16.0 * kTriangleUlp, "quality", describe);
}

}  // namespace

TEST_CASE("triangle.h: radii, the longest edge, quality") {
  const uint64_t count = case_count();
  Random random(20240617);
  Tally tally("enclosing_radius_up, radius_up, opposite_longest, quality");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    StoredTriangle t = hard_triangle(random);
    // Half of them have a corner at the local origin, like candidates.
    const glm::dvec3 at = t.at(0) * static_cast<double>(random.below(2));
    for (Stored& s : t.corner) s = stored_single(s.value() - at);
    const Device device(i);
    const Radii got = device.run([&]() -> Radii {
      const math::Corners c = math::given_high(t);
      return {math::wide(math::enclosing_radius_up(c)), math::wide(math::radius_up(c)),
              math::opposite_longest(c), math::wide(math::quality(c))};
    });
    const auto describe = [&] {
      return std::string(device.name()) + ": " + hex(t) + " got " + hex(got.enclosing) + " " +
             hex(got.corner);
    };
    const ExactTriangle exact(t);
    const Rational smallest = squared_enclosing_radius(exact);
    tally.require(is_upper_bound(got.enclosing, smallest), "enclosing_radius_up", describe);
    for (const exact::Vector& corner : {exact.a, exact.b, exact.c}) {
      tally.require(is_upper_bound(got.corner, square_of(corner)), "radius_up", describe);
    }
    check_steering(t, exact, got, tally, describe);
    const double near = sqrt_near(smallest);
    if (near < 0x1p-23) continue;
    tally.measure("enclosing radius / smallest", got.enclosing / near, describe);
    tally.measure("enclosing radius, -ulp", (1.0 - got.enclosing / near) / kTriangleUlp, describe);
  }
  tally.conclude(6 * count);
}
