// Solver::distances: several pairs at once, each with the answer that it has alone.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/reference_solver.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/solver.h"

namespace {

using namespace vkh;
using namespace vkh::test;

/// Pairs of different sizes, one far from the origin, one of a single face, one of a mesh and
/// itself.
std::vector<NamedPair> pairs() {
  const Mesh field = height_field(24, 1);
  return {{"spheres", icosphere(1.0, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05})},
          {"field", field, height_field(24, 3)},
          {"far", translated(soup(1, 40), {5e5, 0, -3e5}), translated(soup(2, 60), {5e5, 0, -3e5})},
          {"triangle", single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), soup(2, 80)},
          {"itself", field, field}};
}

std::vector<PairView> views(const std::vector<NamedPair>& all) {
  std::vector<PairView> out;
  for (const NamedPair& p : all) out.push_back({p.a, p.b});
  return out;
}

void check_alike(const Report& together, const Report& alone) {
  check_same(together, alone);
  CHECK(together.tolerance == alone.tolerance);
  CHECK(together.mesh_a.faces == alone.mesh_a.faces);
}

}  // namespace

TEST_CASE("pairs at once have the answers that they have alone") {
  Solver solver(test_device());
  const std::vector<NamedPair> all = pairs();
  std::vector<Report> alone;
  for (const NamedPair& p : all) alone.push_back(solver.distance(p.a, p.b));
  for (int again = 0; again < 2; ++again) {
    const std::vector<Report> together = solver.distances(views(all));
    REQUIRE(together.size() == all.size());
    for (size_t i = 0; i < all.size(); ++i) {
      CAPTURE(all[i].name);
      CHECK(together[i].status == Status::kClosed);
      check_alike(together[i], alone[i]);
      CHECK(interval(together[i]).meets(reference_hausdorff(all[i].a, all[i].b, 1e-7)));
      CHECK(together[i].times.solve_ms > 0);
    }
    // A single run in between takes the first pair's buffers.
    check_alike(solver.distance(all[1].a, all[1].b), alone[1]);
  }
}

TEST_CASE("none at once, and one") {
  Solver solver(test_device());
  CHECK(solver.distances({}).empty());
  const std::vector<NamedPair> all = pairs();
  const std::vector<Report> one = solver.distances(views({all[0]}));
  REQUIRE(one.size() == 1);
  check_alike(one[0], solver.distance(all[0].a, all[0].b));
  SolveOptions options;
  options.tolerance = -1;
  CHECK_THROWS_AS(solver.distances(views(all), options), UsageError);
}

TEST_CASE("coverage of each pair") {
  Solver solver(test_device());
  const std::vector<NamedPair> all = pairs();
  SolveOptions options;
  options.engine.coverage = true;
  for (const Report& r : solver.distances(views(all), options)) {
    REQUIRE(r.coverage_check.has_value());
    CHECK(r.coverage_check->holds);
  }
}

TEST_CASE("progress is told of each pair, and ends that one alone") {
  Solver solver(test_device());
  const std::vector<NamedPair> all = pairs();
  std::vector<int> calls(all.size(), 0);
  SolveOptions options;
  options.tolerance = 1e-8;
  constexpr size_t kCancelled = 1;
  options.progress = [&](const Progress& p) {
    CHECK(p.lower <= p.upper);
    ++calls.at(p.pair);
    return p.pair != kCancelled;
  };
  const std::vector<Report> reports = solver.distances(views(all), options);
  CHECK(reports[kCancelled].status == Status::kCancelled);
  CHECK(calls[kCancelled] == 1);
  CHECK(interval(reports[kCancelled]).meets(reference_hausdorff(all[1].a, all[1].b, 1e-7)));
  CHECK(reports[0].status == Status::kClosed);
  CHECK(calls[0] >= 1);
  CHECK(reports[3].status == Status::kClosed);
}

TEST_CASE("a budget of waves is each pair's own") {
  Solver solver(test_device());
  const std::vector<NamedPair> all = pairs();
  SolveOptions options;
  options.wave_limit = 3;
  const std::vector<Report> together = solver.distances(views(all), options);
  for (size_t i = 0; i < all.size(); ++i)
    check_alike(together[i], solver.distance(all[i].a, all[i].b, options));
  CHECK(together[0].waves == 3);
}
