// False bounds, as a driver that rounds wrongly might report them. The writer of certificates
// proves by arithmetic of its own, so a false upper bound is raised to a true one, and soon. Lower
// bounds it takes as they are: vkh_check refuses those (tests/verification/check).
#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

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

namespace {

/// Twelve points about a place: half of the clouds on a lattice, where many distances are equal.
Mesh cloud(Random& random, const glm::dvec3& about, bool on_lattice) {
  std::vector<DVec3> points;
  for (int i = 0; i < 12; ++i) {
    glm::dvec3 p = random.in_cube(2);
    if (on_lattice) p = glm::round(p);
    points.emplace_back(about + p);
  }
  return make_points("points", std::move(points));
}

double largest_distance(const Mesh& a, const Mesh& b) {
  double most = 0;
  for (const DVec3& p : a.vertices) {
    double least = std::numeric_limits<double>::infinity();
    for (const DVec3& q : b.vertices)
      least = std::min(least, glm::distance(glm::dvec3(p), glm::dvec3(q)));
    most = std::max(most, least);
  }
  return most;
}

}  // namespace

// The farther apart the clouds are, the less can a device tell which point is nearest; and figures
// leave a bound that holds for that one alone. Points were halved there, two million times.
TEST_CASE("points have a leaf each, wherever they lie and however tight or false the bound is") {
  Random random(11);
  for (int round = 0; round < 16; ++round) {
    const bool on_lattice = round % 2 == 0;
    const glm::dvec3 away = std::exp2(random.range(0, 22)) * random.direction();
    Mesh a = cloud(random, on_lattice ? glm::round(away) : away, on_lattice);
    const Mesh b = cloud(random, {}, on_lattice);
    if (round % 4 == 3) a.delta = 1e-9;
    SolveOptions options;
    Report r = solver().distance(a, b, options);
    const double h = largest_distance(a, b);
    for (const double less : {0.0, 1e-15, 1e-8, 1.0}) {
      CAPTURE(round);
      CAPTURE(less);
      r.upper = h * (1 - less) + a.delta;
      const Proof proof =
          prove(solver(), {.a = a, .b = b, .report = r, .options = options, .goes_on = {}});
      CHECK(proof.leaves == a.faces.size());
      CHECK(proof.upper >= h * (1 - 1e-15));
      CHECK(proof.upper <= h * (1 + 1e-12) + 2 * a.delta);
    }
  }
}

TEST_CASE("a face of a surface whose corners are one has one leaf") {
  const Mesh a = make_mesh("one point", {{1, 2, 4.0 / 3}}, {{0, 0, 0}}), b = square(0, 1);
  SolveOptions options;
  Report r = solver().distance(a, b, options);
  r.upper = 1;
  const Proof proof =
      prove(solver(), {.a = a, .b = b, .report = r, .options = options, .goes_on = {}});
  CHECK(proof.leaves == 1);
  CHECK(proof.upper >= r.lower);
}
