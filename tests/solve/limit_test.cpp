// SolveOptions::limit: each verdict is proven, both ways of asking give it, and what is undecided
// is near the limit.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "host/base/error.h"
#include "host/solve/solver.h"
#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

SolveOptions limited(double within, double beyond) {
  SolveOptions options;
  options.tolerance = 1e-7;
  options.limit = {within, beyond};
  return options;
}

Report distance(const Mesh& a, const Mesh& b, const SolveOptions& options) {
  return solver().distance(a, b, options);
}

Verdict verdict(const Report& r) { return verdict_of(r.lower, r.upper, r.limit); }

struct MeshPairs {
  Mesh a, b;
};

// In frames of their own: far out, with low parts, tiny.
std::vector<MeshPairs> pairs() {
  return {{icosphere(1, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05})},
          {translated(icosphere(1, 2), {1e4, 0, 0.1}), translated(icosphere(1.01, 2), {1e4, 0, 0})},
          {height_field(16, 1), height_field(16, 3)},
          {icosphere(1e-7, 1), icosphere(1.5e-7, 2)}};
}

TEST_CASE("within and beyond are proven, and undecided is only what is at the limit") {
  for (const auto& [a, b] : pairs()) {
    const Report whole = distance(a, b, limited(0, 0));
    const double near = 2e-7 * whole.diagonal_a;
    for (const double factor : {0.3, 0.99, 0.9999999, 1.0, 1.0000001, 1.01, 3.0}) {
      CAPTURE(factor);
      const double limit = factor * whole.upper;
      const Report r = distance(a, b, limited(limit, limit));
      CHECK(r.lower <= whole.upper);
      CHECK(r.upper >= whole.lower);
      if (verdict(r) == Verdict::kWithin) CHECK(whole.lower <= limit);
      if (verdict(r) == Verdict::kBeyond) CHECK(whole.upper > limit);
      if (std::abs(limit - whole.upper) > near)
        CHECK(verdict(r) == (factor < 1 ? Verdict::kBeyond : Verdict::kWithin));
      if (verdict(r) != Verdict::kUndecided)
        CHECK((r.status == Status::kLimit || r.status == Status::kClosed));
    }
  }
}

TEST_CASE("a limit that is no double lies between two") {
  const MeshPairs pair = pairs()[0];
  const auto& [a, b] = pair;
  const Report whole = distance(a, b, limited(0, 0));
  CHECK(verdict(distance(a, b, limited(0.9 * whole.lower, 1.1 * whole.upper))) ==
        Verdict::kUndecided);
  CHECK(verdict(distance(a, b, limited(0.5 * whole.lower, 0.6 * whole.upper))) == Verdict::kBeyond);
}

TEST_CASE("against a prepared mesh, and of several pairs at once") {
  const auto all = pairs();
  Solver& device = solver();
  const Report whole = distance(all[0].a, all[0].b, limited(0, 0));
  const PreparedMesh b = device.prepare(all[0].b);
  for (const double factor : {0.9, 1.1}) {
    const double limit = factor * whole.upper;
    const Verdict expected = factor < 1 ? Verdict::kBeyond : Verdict::kWithin;
    CHECK(verdict(device.distance(all[0].a, b, limited(limit, limit))) == expected);
    const std::vector<PairView> twice = {{all[0].a, all[0].b}, {all[0].a, all[0].b}};
    for (const Report& r : device.distances(twice, limited(limit, limit)))
      CHECK(verdict(r) == expected);
  }
}

TEST_CASE("both directions: the way back is sought unless the way there decides") {
  const Mesh a = icosphere(1, 2);
  const Mesh b = joined(icosphere(1.1, 2), translated(icosphere(0.5, 1), {2, 0, 0}));
  const SymmetricReport whole = solver().symmetric(a, b, limited(0, 0));
  const double there = whole.a_to_b.upper, back = whole.interval().upper;
  REQUIRE(there < 0.95 * back);
  const auto ask = [&](double limit) {
    const SymmetricReport r = solver().symmetric(a, b, limited(limit, limit));
    CHECK(r.interval().lower <= whole.interval().upper);
    CHECK(r.interval().upper >= whole.interval().lower);
    return std::pair(r, verdict_of(r.interval().lower, r.interval().upper, {limit, limit}));
  };
  const auto [early, beyond] = ask(0.9 * there);
  CHECK(beyond == Verdict::kBeyond);
  CHECK(early.b_to_a.waves == 0);
  CHECK(early.b_to_a.upper > back);
  CHECK(!early.b_to_a.has_witness);
  CHECK(ask((there + back) / 2).second == Verdict::kBeyond);
  const auto [full, within] = ask(1.01 * back);
  CHECK(within == Verdict::kWithin);
  CHECK(full.b_to_a.waves > 0);
}

TEST_CASE("a limit is 0 or positive, finite, and rounded down before up") {
  const MeshPairs pair = pairs()[0];
  const auto& [a, b] = pair;
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = INFINITY;
  for (const Limit& wrong : {Limit{-1, -1}, Limit{nan, nan}, Limit{1, inf}, Limit{2, 1}})
    CHECK_THROWS_AS(distance(a, b, limited(wrong.within, wrong.beyond)), UsageError);
}

}  // namespace
