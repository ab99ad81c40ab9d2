// host/mesh/face_point.cpp against exact rationals: the point's distance and the triangle's lie in
// the bounds, the point lies on the triangle within what is stated, and next to the closest one.
#include "host/mesh/face_point.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/shapes/adversarial.h"
#include "tests/verification/oracle/exact.h"

using namespace vkh;
using namespace vkh::test;

namespace {

#ifdef VKH_SANITIZED
constexpr int kCases = 500;
#else
constexpr int kCases = 40'000;
#endif

struct Case {
  glm::dvec3 p;
  std::array<glm::dvec3, 3> t;
};

double clamped(double x) {
  constexpr double kMost = std::numeric_limits<double>::max();
  return std::clamp(x, -kMost, kMost);
}

/// A hard triangle and point, as they are or moved and scaled to any place and size.
Case hard_case(Random& random) {
  const StoredTriangle stored = hard_triangle(random);
  Case c{hard_point(random, stored), {stored.at(0), stored.at(1), stored.at(2)}};
  const double far = random.below(3) == 0 ? log_uniform(random, -10, 60) : 0.0;
  const glm::dvec3 by = far * random.direction();
  const int exponent = random.below(3) == 0 ? static_cast<int>(random.below(2100)) - 1075 : 0;
  for (glm::dvec3* point : {&c.p, &c.t[0], &c.t[1], &c.t[2]}) {
    for (int i = 0; i < 3; ++i) (*point)[i] = clamped(std::ldexp((*point)[i] + by[i], exponent));
  }
  return c;
}

Rational square(const Rational& x) { return x * x; }

Rational squared_allowance(const std::array<glm::dvec3, 3>& t) {
  Rational sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double largest = std::max({std::abs(t[0][i]), std::abs(t[1][i]), std::abs(t[2][i])});
    sum += square(Rational(largest) * Rational(0x1p-49) + Rational(0x1p-1060));
  }
  return sum;
}

/// 2^-46 of the largest coordinate of the four points: what `upper` may be above the distance.
Rational near(const Case& c) {
  double largest = 0;
  for (const glm::dvec3& p : {c.p, c.t[0], c.t[1], c.t[2]})
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return Rational(largest) * Rational(0x1p-46) + Rational(0x1p-1060);
}

/// The most that the lower bound may be under the distance: a direction that is off by an ulp of
/// the coordinates leaves the root of that.
Rational spread(const Case& c) { return Rational(0x1p23) * near(c); }

}  // namespace

TEST_CASE("bounds hold, the point lies on the triangle, and is the closest but for rounding") {
  Random random(1);
  int distances = 0, points = 0, off = 0, loose = 0, below = 0, low = 0;
  for (int k = 0; k < kCases; ++k) {
    const Case c = hard_case(random);
    const FacePoint found = closest_on_face(c.p, c.t);
    const Rational d2 = squared_distance_exact(c.p, c.t[0], c.t[1], c.t[2]);
    const Rational e2 = squared_distance_exact(c.p, found.point);
    if (!is_upper_bound(found.upper, d2)) ++distances;
    if (!is_upper_bound(found.upper, e2) || !is_lower_bound(found.lower, e2)) ++points;
    if (squared_distance_exact(found.point, c.t[0], c.t[1], c.t[2]) > squared_allowance(c.t)) ++off;
    const double down = face_distance_down(c.p, c.t, found);
    if (!is_lower_bound(down, d2) || down > found.upper) ++below;
    const Rational more = Rational(down) + spread(c);
    if (std::isfinite(found.upper) && square(more) < d2) ++low;
    if (!std::isfinite(found.upper)) continue;
    const Rational least = Rational(found.upper) - near(c);
    if (least > 0 && square(least) > d2) ++loose;
  }
  CHECK(distances == 0);
  CHECK(points == 0);
  CHECK(off == 0);
  CHECK(loose == 0);
  CHECK(below == 0);
  CHECK(low == 0);
}

TEST_CASE("corners come back exactly") {
  const std::array<glm::dvec3, 3> t{{{0.1, 0.2, 0.3}, {1.1, 0.7, -0.3}, {-0.3, 1.9, 0.7}}};
  for (const glm::dvec3& corner : t) {
    const FacePoint found = closest_on_face(corner, t);
    CHECK(found.point == corner);
    CHECK(found.upper == 0);
  }
}
