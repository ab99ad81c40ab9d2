// False bounds, as a driver that rounds wrongly might report them. The writer of certificates
// proves by arithmetic of its own, so a false upper bound is raised to a true one, and soon. Lower
// bounds it takes as they are: vkh_check refuses those (tests/verification/check).
#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "vkhausdorff/prover.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr double kHeight = 0.75;  // of A above B: h, exactly

Mesh square(double height, double size) {
  return make_mesh("square",
                   {{0, 0, height}, {size, 0, height}, {0, size, height}, {size, size, height}},
                   {{0, 1, 2}, {1, 3, 2}});
}

}  // namespace

TEST_CASE("an upper bound that is too low by any factor is raised to a true one") {
  const Mesh a = square(kHeight, 1), b = square(0, 1);
  SolveOptions options;
  options.tolerance = 1e-8;
  Report r = solver().distance(a, b, options);
  REQUIRE(r.upper >= kHeight);
  for (const double less : {1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 0.5, 1.0}) {
    CAPTURE(less);
    r.upper = kHeight * (1 - less);
    const Proof proof =
        prove(solver(), {.a = a, .b = b, .report = r, .options = options, .goes_on = {}});
    CHECK(proof.upper >= kHeight);
    CHECK(proof.upper <= kHeight * (1 + 1e-12));
    CHECK(proof.leaves < 2000);
  }
}

TEST_CASE("also where the farthest point is one of few") {
  const Mesh a = height_field(6, 1), b = square(-1, 2);
  SolveOptions options;
  options.tolerance = 1e-9;
  Report r = solver().distance(a, b, options);
  const double lower = r.lower, upper = r.upper;
  for (const double less : {1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 0.5}) {
    CAPTURE(less);
    r.upper = lower * (1 - less);
    const Proof proof =
        prove(solver(), {.a = a, .b = b, .report = r, .options = options, .goes_on = {}});
    CHECK(proof.upper >= lower);
    CHECK(proof.upper <= upper * 1.02);
    CHECK(proof.leaves < 100000);
  }
}
