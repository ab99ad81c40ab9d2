// Whole runs at the ends of double's range, where scaling, displacement and outward rounding have
// only whole multiples of 5e-324 to choose from, or next to no room above.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/shapes/shapes.h"
#include "tests/support/kernel_bench.h"
#include "tests/verification/oracle/exact.h"
#include "vkhausdorff/solver.h"
#include "vkhausdorff/verify.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr double kLeast = 5e-324;

/// h(a, b)^2 is known exactly.
void check_pair(const Mesh& a, const Mesh& b, const Rational& squared) {
  static Solver& solver = kept<Solver>(test_device());
  SolveOptions options;
  options.engine.coverage = true;
  const Report r = solver.distance(a, b, options);
  CAPTURE(r.lower);
  CAPTURE(r.upper);
  CAPTURE(status_name(r.status));
  CHECK(is_lower_bound(r.lower, squared));
  CHECK(is_upper_bound(r.upper, squared));
  CHECK(verify_witness(a, b, r).holds);
  CHECK(r.coverage_check->holds);
}

Rational square(double x) {
  const Rational r(x);
  return r * r;
}

Mesh point(const glm::dvec3& p) { return single_triangle(p, p, p); }

}  // namespace

TEST_CASE("a point a few of the smallest doubles away from a point") {
  for (const double d : {kLeast, 2 * kLeast, 2.5e-323, 1e-310, 2.2250738585072014e-308}) {
    CAPTURE(d);
    check_pair(point({d, 0, 0}), point({0, 0, 0}), square(d));
    check_pair(point({0, 0, 0}), point({0, d, 0}), square(d));
    check_pair(point({d, 0, -d}), point({0, 0, 0}), 2 * square(d));
    check_pair(point({d, 0, 0}), point({-d, 0, 0}), 4 * square(d));
    check_pair(point({d, d, d}), point({d, d, d}), 0);
  }
}

TEST_CASE("triangles of the smallest doubles") {
  const Mesh corner = single_triangle({kLeast, 0, 0}, {0, kLeast, 0}, {0, 0, 0});
  check_pair(corner, point({0, 0, 0}), square(kLeast));
  check_pair(corner, corner, 0);
  check_pair(point({0, 0, 0}), corner, 0);
  check_pair(point({0, 0, kLeast}), corner, square(kLeast));
  // The distance from the middle of the long edge is sqrt(1/2) of the smallest double: no double is
  // near.
  check_pair(single_triangle({kLeast, kLeast, 0}, {kLeast, kLeast, 0}, {kLeast, kLeast, 0}), corner,
             square(kLeast) / 2);
  const Mesh larger = single_triangle({4 * kLeast, 0, 0}, {0, 4 * kLeast, 0}, {0, 0, 4 * kLeast});
  check_pair(larger, point({0, 0, 0}), 16 * square(kLeast));
  check_pair(point({0, 0, 0}), larger, 16 * square(kLeast) / 3);
}

TEST_CASE("subnormal beside normal: what is lost is in the interval") {
  check_pair(single_triangle({1, 0, 0}, {0, 1, 0}, {kLeast, kLeast, kLeast}),
             single_triangle({1, 0, 0}, {0, 1, 0}, {0, 0, 0}), square(kLeast) * 3);
  check_pair(point({1, 0, kLeast}), single_triangle({2, 0, 0}, {0, 2, 0}, {-2, -2, 0}),
             square(kLeast));
}

TEST_CASE("the largest doubles") {
  const double huge = std::ldexp(1.0, 1022);
  check_pair(point({huge, 0, 0}), point({0, 0, 0}), square(huge));
  check_pair(point({huge, 0, 0}), point({-huge / 2, 0, 0}), square(huge * 1.5));
  check_pair(single_triangle({huge, 0, 0}, {0, huge, 0}, {0, 0, 0}), point({0, 0, 0}),
             square(huge));
}
