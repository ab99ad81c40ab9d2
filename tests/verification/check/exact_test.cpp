// The checker's distances, which it computes on integers of its own, against the oracle's.
#include "check/exact.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "tests/verification/oracle/exact.h"

namespace vkh::test {
namespace {

using Random = std::mt19937_64;

/// Small multiples of a power of two, so that points meet corners and edges; or any double.
double coordinate(Random& random, int kind) {
  if (kind == 0) return static_cast<double>(static_cast<int>(random() % 5) - 2);
  if (kind == 1) return static_cast<double>(static_cast<int>(random() % 17) - 8) * 0x1p-3;
  const double mantissa = std::ldexp(static_cast<double>(random() >> 11), -53);
  const double value = random() % 2 == 0 ? mantissa : -mantissa;
  if (kind == 2) return value;
  if (kind == 3) return std::ldexp(value, static_cast<int>(random() % 60) - 30);
  return std::ldexp(value, static_cast<int>(random() % 2000) - 1060);  // subnormal ones, too
}

glm::dvec3 point(Random& random, int kind) {
  return {coordinate(random, kind), coordinate(random, kind), coordinate(random, kind)};
}

TEST_CASE("squared distances are those of the oracle") {
  Random random(11);
#ifdef VKH_SANITIZED
  constexpr int kCases = 2000;
#else
  constexpr int kCases = 20000;
#endif
  for (int i = 0; i < kCases; ++i) {
    const int kind = i % 5;
    std::array<glm::dvec3, 3> corner = {point(random, kind), point(random, kind),
                                        point(random, kind)};
    if (random() % 8 == 0) corner[random() % 3] = corner[random() % 3];
    const glm::dvec3 from = random() % 8 == 0 ? corner[random() % 3] : point(random, kind);
    const auto shift =
        static_cast<unsigned>(random() % 3);  // of the point, which is from / 2^shift
    constexpr int kUnit = -1074;
    const check::Triangle triangle({check::point(corner[0], kUnit), check::point(corner[1], kUnit),
                                    check::point(corner[2], kUnit)});
    const check::Fraction square =
        check::scaled(triangle.squared_distance(check::point(from, kUnit), shift), kUnit);
    const double factor = std::ldexp(1.0, static_cast<int>(shift));
    if (shift != 0 && kind == 4) continue;  // the oracle's point would be rounded
    const Rational expected =
        squared_distance_exact(from / factor, corner[0], corner[1], corner[2]);
    Rational found(square.numerator, square.denominator);
    found.canonicalize();
    REQUIRE(found == expected);
  }
}

TEST_CASE("doubles are taken apart and put together") {
  for (const double value : {1.0, -3.0, 0x1p-1074, -0x1.8p-1073, 0x1.fffffffffffffp1023, 0.0}) {
    CAPTURE(value);
    const int e = value == 0 ? 0 : check::exponent_of(value);
    const check::Z z = check::integer(value, e);
    CHECK(std::ldexp(z.get_d(), e) == value);
    CHECK((value == 0 || mpz_odd_p(z.get_mpz_t()) != 0));
  }
  CHECK(check::exponent_of(0.0) == INT_MAX);
  CHECK(check::exponent_of(-0.0) == INT_MAX);
}

}  // namespace
}  // namespace vkh::test
