// SolveOptions::limit: each verdict is proven, both ways of asking give it, and an undecided pair
// is near the limit.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "host/solve/pair.h"
#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/face_gate.h"
#include "vkhausdorff/solver.h"

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

// Pairs in frames of their own: far out, with low parts, tiny.
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

TEST_CASE("no candidate of many stops short of the limit") {
  const Mesh a = noisy(icosphere(1, 4), 0.02, 1), b = icosphere(1, 4);
  const Report whole = distance(a, b, limited(0, 0));
  for (const double factor : {1.02, 1.05, 1.2, 1.5, 2.0}) {
    CAPTURE(factor);
    const double limit = factor * whole.upper;
    SolveOptions options = limited(limit, limit);
    options.tolerance = 1e-4;  // a band that candidates fall into
    CHECK(verdict(distance(a, b, options)) == Verdict::kWithin);
  }
}

// As in the reverse direction of a gate, which knows the forward direction's lower bound: a search
// in plain floats ended at that bound, and nothing finer was asked for.
TEST_CASE("what a known bound ends within plain floats' tolerance is asked again for the limit") {
  const Mesh a = icosphere(1, 1), b = icosphere(1.1, 1);
  const FramedPair framed = frame_pair(a, b);
  Pair pair{.a = a,
            .b = b,
            .frame = framed.frame,
            .stored_a = framed.a,
            .stored_b = &framed.b,
            .resident = nullptr,
            .displacement = 0,
            .has_low = false,
            .box_a = framed.box_a,
            .joint = vkh::join(framed.box_a, framed.box_b),
            .options = limited(0.1, 0.1)};
  pair.options.known_lower = 0.1 - 1e-6;
  const Pair first = coarser(pair);
  CHECK(first.options.tolerance == 1e-6);
  Report r;
  r.known_lower = pair.options.known_lower;
  r.limit = pair.options.limit;
  r.tolerance = tolerance_of(first);
  r.upper = 0.1 + 1e-7;
  r.status = Status::kPruned;
  CHECK(asks_for_more(r, first, pair));
  CHECK(r.tolerance == tolerance_of(pair));
  CHECK(r.status == Status::kPrecision);
  r.upper = 0.1 - 1e-7;
  r.status = Status::kPruned;
  CHECK_FALSE(asks_for_more(r, first, pair));
  CHECK(r.status == Status::kLimit);
  CHECK(verdict(r) == Verdict::kWithin);
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

// --- Limits of faces ---

/// h of each face alone, from above and below.
std::vector<Interval> distances_of_faces(const Mesh& a, const Mesh& b) {
  std::vector<Interval> found;
  for (uint32_t face = 0; face < a.faces.size(); ++face) {
    const auto [p, q, r] = corners(a, face);
    const Report report = solver().distance(single_triangle(p, q, r), b);
    found.push_back(interval(report));
  }
  return found;
}

FaceGate ask(const Mesh& a, const Mesh& b, const std::vector<double>& limits) {
  std::vector<Limit> both;
  for (const double limit : limits) both.push_back({limit, limit});
  SolveOptions options;
  options.tolerance = 1e-7;
  return gate_faces(solver(), a, b, both, options);
}

struct Fixture {
  Mesh a = height_field(6, 1), b = height_field(6, 3);
  std::vector<Interval> faces = distances_of_faces(a, b);
  Interval whole = interval(solver().distance(a, b));

  std::vector<double> limits(double factor) const {
    std::vector<double> out;
    for (const Interval& face : faces) out.push_back(std::max(factor * face.upper, 1e-6));
    return out;
  }
};

TEST_CASE_FIXTURE(Fixture, "limits a tenth over each face's own distance: all within") {
  const FaceGate gate = ask(a, b, limits(1.1));
  CHECK(gate.verdict == Verdict::kWithin);
  CHECK(gate.within == a.faces.size());
  CHECK(gate.report.status == Status::kLimit);
  CHECK(gate.report.lower <= whole.upper);
  CHECK(gate.report.upper >= whole.lower);
  CHECK(gate.report.mesh_a.faces == a.faces.size());
}

TEST_CASE_FIXTURE(Fixture, "one face over its own limit is found, though others are farther") {
  for (const size_t odd : {size_t{3}, faces.size() / 2, faces.size() - 2}) {
    if (faces[odd].lower < 1e-4) continue;
    std::vector<double> all = limits(1.1);
    all[odd] = 0.9 * faces[odd].lower;
    const FaceGate gate = ask(a, b, all);
    CHECK(gate.verdict == Verdict::kBeyond);
    CHECK(gate.report.witness_a.face == odd);
    CHECK(gate.report.lower > all[odd]);
    CHECK(gate.limit.beyond == all[odd]);
    CHECK(gate.report.upper >= whole.lower);
  }
}

TEST_CASE_FIXTURE(Fixture, "at its distance a face is undecided, and the others are within") {
  std::vector<double> all = limits(1.5);
  size_t farthest = 0;
  for (size_t i = 0; i < faces.size(); ++i)
    farthest = faces[i].upper > faces[farthest].upper ? i : farthest;
  all[farthest] = (faces[farthest].lower + faces[farthest].upper) / 2;
  const FaceGate gate = ask(a, b, all);
  CHECK(gate.verdict != Verdict::kWithin);
  if (gate.verdict == Verdict::kUndecided) CHECK(gate.within == a.faces.size() - 1);
}

TEST_CASE_FIXTURE(Fixture, "one limit for all is the gate") {
  const std::vector<double> wide(a.faces.size(), 1.2 * whole.upper);
  const FaceGate within = ask(a, b, wide);
  CHECK(within.verdict == Verdict::kWithin);
  CHECK(within.runs == 1);
  const std::vector<double> narrow(a.faces.size(), 0.8 * whole.lower);
  CHECK(ask(a, b, narrow).verdict == Verdict::kBeyond);
}

TEST_CASE_FIXTURE(Fixture, "limits far apart: the small ones decide") {
  std::vector<double> all(a.faces.size(), 100);
  for (size_t i = 0; i < all.size(); i += 2) all[i] = 1e-9;
  const FaceGate gate = ask(a, b, all);
  CHECK(gate.verdict == Verdict::kBeyond);
  CHECK(gate.report.witness_a.face % 2 == 0);
}

TEST_CASE_FIXTURE(Fixture, "time and the callback are those of all runs together") {
  std::vector<Limit> limits_of(a.faces.size());
  for (size_t i = 0; i < limits_of.size(); ++i) {
    const double limit = 1.001 * faces[i].upper + 1e-6;
    limits_of[i] = {limit, limit};
  }
  SolveOptions options;
  options.progress = [](const Progress&) { return false; };
  const FaceGate cancelled = gate_faces(solver(), a, b, limits_of, options);
  CHECK(cancelled.verdict == Verdict::kUndecided);
  CHECK(cancelled.report.upper >= whole.lower);
  CHECK(cancelled.runs <= 1);
}

TEST_CASE_FIXTURE(Fixture, "limits are positive, finite, one for each face") {
  const auto wrong = [&](double limit) {
    std::vector<double> all = limits(1.1);
    all[5] = limit;
    return all;
  };
  for (const double limit : {0.0, -1.0, std::nan(""), static_cast<double>(INFINITY)})
    CHECK_THROWS_WITH_AS(ask(a, b, wrong(limit)), doctest::Contains("the limit of face 5"),
                         UsageError);
  CHECK_THROWS_AS(ask(a, b, {1.0, 2.0}), UsageError);
}

}  // namespace
