// gate_faces: each verdict is what the faces' own distances say, however the limits are spread.
#include "host/solve/face_gate.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "host/base/error.h"
#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;

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
