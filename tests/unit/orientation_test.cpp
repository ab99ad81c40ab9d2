// Orientations and meetings of segments and triangles, against exact integers and fractions.
#include "host/mesh/orientation.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/shapes/adversarial.h"
#include "tests/shapes/shapes.h"
#include "tests/verification/oracle/exact.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using glm::dvec3;

int oracle_orientation(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
  const auto points = exact::integers(a, b, c, d);
  const auto& [p, q, r, s] = points.at;
  return sgn(exact::dot(exact::cross(q - p, r - p), s - p));
}

// A coordinate of one of many kinds: small integers, neighbours, huge and tiny ones.
double coordinate(Random& random, uint32_t kind) {
  switch (kind) {
    case 0:
      return random.below(5);
    case 1:
      return 1 + random.below(4) * 0x1p-52;
    case 2:
      return std::ldexp(random.range(-1, 1), static_cast<int>(random.below(600)) - 300);
    case 3:
      return std::ldexp(random.range(-1, 1), static_cast<int>(random.below(2000)) - 1000);
    case 4:
      return static_cast<double>(static_cast<float>(random.range(-1, 1)));
    default:
      return random.range(-1, 1);
  }
}

dvec3 point(Random& random, uint32_t kind) {
  return {coordinate(random, kind), coordinate(random, kind), coordinate(random, kind)};
}

TEST_CASE("orientations are exact") {
  Random random(38);
  int flat = 0;
  for (int k = 0; k < 60000; ++k) {
    const uint32_t kind = random.below(6);
    const dvec3 a = point(random, kind), b = point(random, kind), c = point(random, kind);
    dvec3 d = point(random, kind);
    if (random.below(3) == 0) d = a + (b - a) * random.unit() + (c - a) * random.unit();
    if (random.below(20) == 0) d = b;
    const int truth = oracle_orientation(a, b, c, d);
    flat += truth == 0 ? 1 : 0;
    REQUIRE(orientation(a, b, c, d) == truth);
    REQUIRE(orientation(b, c, a, d) == truth);
    REQUIRE(orientation(a, c, b, d) == -truth);
  }
  CHECK(flat > 1000);
}

// The part [from, to] of a segment on which linear functions are not negative.
struct Clipped {
  Rational from = 0, to = 1;
  void clip(const Rational& at_start, const Rational& at_end) {
    const Rational step = at_end - at_start;
    if (step == 0) {
      if (at_start < 0) to = -1;
    } else if (step > 0) {
      from = std::max<Rational>(from, -at_start / step);
    } else {
      to = std::min<Rational>(to, -at_start / step);
    }
  }
};

bool oracle_meets(const dvec3& p, const dvec3& q, const Corners3& t) {
  const auto points = exact::integers(p, q, t[0], t[1], t[2]);
  const auto& [x, y, a, b, c] = points.at;
  const exact::Vector n = exact::cross(b - a, c - a);
  Clipped part;
  const Rational of_x(exact::dot(n, x - a)), of_y(exact::dot(n, y - a));
  part.clip(of_x, of_y);
  part.clip(-of_x, -of_y);
  const std::array<std::array<const exact::Vector*, 2>, 3> edges = {{{&a, &b}, {&b, &c}, {&c, &a}}};
  for (const auto& [s, e] : edges)
    part.clip(Rational(exact::dot(exact::cross(*e - *s, x - *s), n)),
              Rational(exact::dot(exact::cross(*e - *s, y - *s), n)));
  return part.from <= part.to;
}

TEST_CASE("segments meet triangles as fractions say") {
  Random random(39);
  int met = 0, flat = 0;
  for (int k = 0; k < 60000; ++k) {
    const uint32_t kind = random.below(4) == 0 ? 5 : 0;
    const auto any = [&] {
      return kind == 5 ? random.in_cube(1)
                       : dvec3(random.below(4), random.below(4), random.below(3));
    };
    const Corners3 t = {any(), any(), any()};
    const dvec3 p = any(), q = any();
    if (oracle_orientation(t[0], t[1], t[2], t[0] + glm::dvec3(1, 0, 0)) == 0 &&
        oracle_orientation(t[0], t[1], t[2], t[0] + glm::dvec3(0, 1, 0)) == 0 &&
        oracle_orientation(t[0], t[1], t[2], t[0] + glm::dvec3(0, 0, 1)) == 0)
      continue;
    const bool truth = oracle_meets(p, q, t);
    met += truth ? 1 : 0;
    flat += orientation(t[0], t[1], t[2], p) == 0 && orientation(t[0], t[1], t[2], q) == 0 ? 1 : 0;
    REQUIRE(segment_meets(p, q, t) == truth);
  }
  CHECK(met > 5000);
  CHECK(flat > 1000);
}

}  // namespace
