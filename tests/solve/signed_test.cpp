// Signed figures and limits that differ by side: closed forms, samples, and both ways to turn B.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "host/survey/sides.h"
#include "host/survey/statistics.h"
#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using glm::dvec3;

Mesh turned(Mesh mesh) {
  for (UVec3& f : mesh.faces) std::swap(f.y, f.z);
  return mesh;
}

SurveyResult signed_survey(const Mesh& a, const Mesh& b, SurveyOptions survey = {}) {
  survey.is_signed = survey.statistics = survey.faces = true;
  survey.mean_tolerance = survey.face_tolerance = 0.002;
  if (!survey.effort) survey.effort = 100000;
  SurveyResult result = surveyed(a, b, survey);
  REQUIRE(result.sides);
  return result;
}

void check_about(const Enclosure& e, double truth, double width) {
  INFO(truth, " in [", e.lower, ", ", e.upper, "]");
  CHECK(e.lower <= truth + 1e-12);
  CHECK(e.upper >= truth - 1e-12);
  CHECK(e.upper - e.lower <= width);
}

TEST_CASE("a plane over an open one, and under it once that is turned") {
  const Mesh a = square_patch(4, 0.25), b = square_patch(3, 0.0);
  const SignedFigures over = *signed_survey(a, b).sides;
  const SignedFigures under = *signed_survey(a, turned(b)).sides;
  CHECK(over.inside == Inside::kOpen);
  check_about(*over.mean, 0.25, 1e-3);
  check_about(*under.mean, -0.25, 1e-3);
  check_about(over.over, 0.25, 1e-3);
  check_about(under.under, 0.25, 1e-3);
  CHECK(over.under.upper == 0);
  CHECK(under.over.upper == 0);
  CHECK(over.areas->over.lower == doctest::Approx(1));
  for (const Percentile& p : over.percentiles) check_about(p.distance, 0.25, 1e-3);
  for (const Percentile& p : under.percentiles) check_about(p.distance, -0.25, 1e-3);
}

// A: x from 0 to 1 at height x / 4 - 0.1 over B's plane, which it crosses at x = 0.4.
Mesh crossing_plane() {
  Mesh a = square_patch(3, 0.0);
  for (DVec3& v : a.vertices) v.z = 0.25 * v.x - 0.1;
  return a;
}
Mesh wide_plane() { return translated(scaled(square_patch(5, 0.0), 2), {-1.5, -1.5, 0}); }

TEST_CASE("a plane through another: signed distances from -0.1 to 0.15, evenly") {
  const SurveyResult r = signed_survey(crossing_plane(), wide_plane());
  const SignedFigures& s = *r.sides;
  check_about(*s.mean, 0.025, 2e-3);
  check_about(s.over, 0.15, 1e-3);
  check_about(s.under, 0.1, 1e-3);
  for (const Percentile& p : s.percentiles) check_about(p.distance, p.share / 4 - 0.1, 4e-3);
  CHECK(s.areas->over.lower <= 0.6 + 1e-9);
  CHECK(s.areas->under.lower <= 0.4 + 1e-9);
  CHECK(s.areas->over.lower > 0.54);
  CHECK(s.areas->under.lower > 0.34);
  CHECK(s.areas->doubts[static_cast<size_t>(Doubt::kMeets)].upper <= 0.051);
  double most_over = 0, most_under = 0;
  for (size_t f = 0; f < r.field.face_count(); ++f) {
    CHECK(s.over_of_faces.upper[f] <= r.field.upper[f]);
    CHECK(std::max(s.over_of_faces.upper[f], s.under_of_faces.upper[f]) >= r.field.lower[f]);
    most_over = std::max(most_over, s.over_of_faces.lower[f]);
    most_under = std::max(most_under, s.under_of_faces.lower[f]);
  }
  CHECK(most_over == s.over.lower);
  CHECK(most_under == s.under.lower);
}

// The signed distance of a point from a cube about the origin.
double from_cube(const dvec3& p, double half) {
  const dvec3 q = glm::abs(p) - dvec3(half);
  return glm::length(glm::max(q, dvec3(0))) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

// Signed distances of random points of A, uniform in area.
std::vector<double> sampled(const Mesh& a, double half, size_t count) {
  std::vector<double> area_to{0};
  for (uint32_t f = 0; f < a.faces.size(); ++f) {
    const auto t = corners(a, f);
    area_to.push_back(area_to.back() + glm::length(glm::cross(t[1] - t[0], t[2] - t[0])));
  }
  Random random(7);
  std::vector<double> all;
  while (all.size() < count) {
    const double at = random.range(0, area_to.back());
    const auto f = std::upper_bound(area_to.begin(), area_to.end(), at) - area_to.begin() - 1;
    const auto t = corners(a, static_cast<uint32_t>(f));
    double v = random.unit(), w = random.unit();
    if (v + w > 1) v = 1 - v, w = 1 - w;
    all.push_back(from_cube(t[0] + v * (t[1] - t[0]) + w * (t[2] - t[0]), half));
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST_CASE("a sphere through a cube: the signed mean and percentiles of a million samples") {
  const Mesh a = translated(icosphere(1, 2), {0.1, 0.05, 0}), b = cube(0.7);
  SurveyOptions options;
  options.effort = 400000;
  const SignedFigures s = *signed_survey(a, b, options).sides;
  CHECK(s.inside == Inside::kProven);
  constexpr size_t kCount = 1'000'000;
  const std::vector<double> all = sampled(a, 0.7, kCount);
  const double mean = std::accumulate(all.begin(), all.end(), 0.0) / kCount;
  constexpr double kChance = 2e-3;  // five deviations: distances spread by 0.2, shares by 5e-4
  check_about(*s.mean, std::clamp(mean, s.mean->lower, s.mean->upper), 0.01);
  CHECK(s.mean->lower <= mean + kChance);
  CHECK(s.mean->upper >= mean - kChance);
  for (const Percentile& p : s.percentiles) {
    const double at = all[static_cast<size_t>(p.share * kCount)];
    CHECK(p.distance.lower <= at + 5 * kChance);
    CHECK(p.distance.upper >= at - 5 * kChance);
    CHECK(p.distance.upper - p.distance.lower < 0.02);
  }
}

Verdict verdict_by(const Mesh& a, const Mesh& b, double over, double under) {
  SurveyOptions survey;
  const SidedLimits limits{{over, over}, {under, under}};
  survey.sided = limits;
  survey.effort = 100000;
  const SurveyResult result = surveyed(a, b, survey);
  REQUIRE(result.sides);
  return verdict_of(result.sides->over, result.sides->under, limits);
}

TEST_CASE("limits of two sides") {
  const Mesh a = crossing_plane(), b = wide_plane();
  CHECK(verdict_by(a, b, 0.1501, 0.1001) == Verdict::kWithin);
  CHECK(verdict_by(a, b, 0.1499, 0.1001) == Verdict::kBeyond);
  CHECK(verdict_by(a, b, 0.1501, 0.0999) == Verdict::kBeyond);
  CHECK(verdict_by(a, b, 0.1499, 0.3) == Verdict::kBeyond);
  CHECK(verdict_by(a, b, 0.3, 0.0999) == Verdict::kBeyond);
  CHECK(verdict_by(a, turned(b), 0.1001, 0.1501) == Verdict::kWithin);
  CHECK(verdict_by(a, turned(b), 0.1501, 0.1001) == Verdict::kBeyond);
}

// Two sheets on each other have no side: what is within the smaller limit is within, and what is
// between both stays open.
TEST_CASE("a sheet with two sides leaves what is between the limits undecided") {
  const Mesh a = square_patch(4, 0.25), b = square_patch(3, 0.0);
  const Mesh sheet = joined(b, turned(b));
  CHECK(verdict_by(a, sheet, 0.3, 0.26) == Verdict::kWithin);
  CHECK(verdict_by(a, sheet, 0.3, 0.2) == Verdict::kUndecided);
  CHECK(verdict_by(a, sheet, 0.2, 0.24) == Verdict::kUndecided);
  const SignedFigures s = *signed_survey(a, sheet).sides;
  CHECK(s.areas->doubts[static_cast<size_t>(Doubt::kTwoSided)].lower == doctest::Approx(1));
}

TEST_CASE("faces against each other are refused") {
  Mesh b = square_patch(3, 0.0);
  std::swap(b.faces[4].y, b.faces[4].z);
  SurveyOptions survey;
  survey.is_signed = true;
  const Mesh a = square_patch(2, 0.1);
  CHECK_THROWS_AS(surveyed(a, b, survey), InputError);
}

// The witness is a corner of a cell: its distance, by hand, is at least what is told of it.
void check_witness(const SidedPoint& witness, const Mesh& a, double truth, const Enclosure& side) {
  const auto t = corners(a, static_cast<uint32_t>(witness.at.face));
  const dvec3& w = witness.at.barycentric;
  CHECK(w.x + w.y + w.z == 1);
  CHECK(glm::length(t[0] * w.x + t[1] * w.y + t[2] * w.z - dvec3(witness.at.point)) < 1e-15);
  CHECK(witness.lower <= truth + 1e-15);
  CHECK(witness.lower > truth - 1e-13);
  CHECK(witness.lower <= side.upper);
  CHECK(side.lower >= witness.lower);
}

TEST_CASE("far points of both sides, and what is proven of them") {
  const Mesh a = crossing_plane();
  const SignedFigures s = *signed_survey(a, wide_plane()).sides;
  REQUIRE((s.over_witness && s.under_witness));
  const dvec3 over = s.over_witness->at.point, under = s.under_witness->at.point;
  CHECK(over.z > 0.1499);
  CHECK(under.z < -0.0999);
  check_witness(*s.over_witness, a, over.z, s.over);
  check_witness(*s.under_witness, a, -under.z, s.under);
  const SignedFigures far = *signed_survey(a, turned(wide_plane())).sides;
  CHECK(far.over_witness->at.point.z < -0.0999);
  const SignedFigures one = *signed_survey(square_patch(4, 0.25), square_patch(3, 0.0)).sides;
  CHECK(one.over_witness);
  CHECK_FALSE(one.under_witness);
}

// A's corners may be off by 2^-10, and so is its distance.
TEST_CASE("a witness is no farther than deltas leave it") {
  Mesh a = square_patch(4, 0.25);
  a.delta = 0x1p-10;
  const SignedFigures s = *signed_survey(a, square_patch(3, 0.0)).sides;
  CHECK(s.over_witness->lower <= 0.25 - 0x1p-10);
  CHECK(s.over_witness->lower > 0.249);
}

TEST_CASE("witnesses about a cube lie on their sides, as far as they say") {
  const Mesh a = translated(icosphere(1, 2), {0.1, 0.05, 0});
  const SignedFigures s = *signed_survey(a, cube(0.7)).sides;
  REQUIRE((s.over_witness && s.under_witness));
  const double over = from_cube(s.over_witness->at.point, 0.7);
  const double under = -from_cube(s.under_witness->at.point, 0.7);
  check_witness(*s.over_witness, a, over, s.over);
  check_witness(*s.under_witness, a, under, s.under);
}

double of_doubt(const SignedFigures& s, Doubt doubt) {
  return s.areas->doubts[static_cast<size_t>(doubt)].upper;
}

TEST_CASE("a survey that is ended before its sides leaves all without one") {
  for (const bool is_closed : {false, true}) {
    SurveyOptions options;
    options.goes_on = [](size_t) { return false; };
    const SurveyResult r =
        signed_survey(square_patch(4, 0.25), is_closed ? cube(0.1) : wide_plane(), options);
    CHECK(r.ended == SurveyEnd::kCancelled);
    const SignedFigures& s = *r.sides;
    CHECK(of_doubt(s, Doubt::kEnded) == 1);
    CHECK(s.areas->over.upper == 0);
    CHECK_FALSE(s.over_witness);
    CHECK(s.inside == (is_closed ? Inside::kUndecided : Inside::kOpen));
    CHECK(s.over.lower == 0);
    CHECK(s.over.upper >= 0.25);
    CHECK(s.mean->lower <= 0.25);
    CHECK(s.mean->upper >= 0.25);
  }
}

// However far it came, what it says is true.
TEST_CASE("a survey that is ended among its sides keeps those that it found") {
  for (int calls = 2; calls < 200; calls += calls / 2) {
    int left = calls;
    SurveyOptions options;
    options.goes_on = [&](size_t) { return --left > 0; };
    const SurveyResult r = signed_survey(crossing_plane(), wide_plane(), options);
    const SignedFigures& s = *r.sides;
    check_about(*s.mean, 0.025, 1);
    CHECK(s.over.upper >= 0.15 - 1e-12);
    CHECK(s.under.upper >= 0.1 - 1e-12);
    CHECK(s.areas->over.lower <= 0.6 + 1e-9);
    CHECK(s.areas->under.lower <= 0.4 + 1e-9);
    for (const Percentile& p : s.percentiles) check_about(p.distance, p.share / 4 - 0.1, 1);
    if (r.ended != SurveyEnd::kCancelled) continue;
    CHECK(left <= 0);
  }
}

TEST_CASE("signed figures are as narrow as is asked") {
  SurveyOptions options;
  options.signed_tolerance = 0.01;
  const SurveyResult r = signed_survey(crossing_plane(), wide_plane(), options);
  CHECK(r.is_met());
  const double mean = r.statistics->mean.upper;
  const auto check = [&](const Enclosure& e) {
    const double size = std::max(std::abs(e.lower), std::abs(e.upper));
    CHECK(e.upper - e.lower <= 0.01 * std::max(mean, size) + 1e-6);
  };
  check(*r.sides->mean);
  for (const Percentile& p : r.sides->percentiles) check(p.distance);
}

}  // namespace
