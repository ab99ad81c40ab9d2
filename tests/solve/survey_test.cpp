// Surveys: closed forms lie in the certified intervals, faces meet the tests' own solver, random
// points agree, a survey that ends early is true, and one that does not is the same each time.
#include "vkhausdorff/survey.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <vector>

#include "host/base/parallel.h"
#include "host/solve/cell_corners.h"
#include "host/survey/survey_with.h"
#include "tests/shapes/hard_pairs.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_bench.h"
#include "vkhausdorff/certificate.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/field_file.h"

namespace {

using namespace vkh;
using namespace vkh::test;

SurveyOptions all_of_it(std::vector<double> bands = {}) {
  SurveyOptions options;
  options.faces = options.statistics = true;
  options.mean_tolerance = options.face_tolerance = 0.002;
  options.bands = std::move(bands);
  return options;
}

void check_encloses(const Enclosure& e, double truth, double width) {
  CHECK(e.lower <= truth * (1 + 1e-12));
  CHECK(e.upper >= truth * (1 - 1e-12));
  CHECK(e.upper - e.lower <= width);
}

TEST_CASE("a lifted plane: one distance everywhere") {
  const SurveyResult r =
      surveyed(square_patch(4, 0.25), square_patch(3, 0.0), all_of_it({0.2, 0.2499, 0.2501}));
  REQUIRE(r.statistics);
  const Statistics& s = *r.statistics;
  CHECK(r.is_met());
  check_encloses(s.mean, 0.25, 1e-3);
  check_encloses(s.rms, 0.25, 1e-3);
  for (const Percentile& p : s.percentiles) check_encloses(p.distance, 0.25, 1e-3);
  CHECK(s.bands[1].share.lower == 0);
  CHECK(s.bands[1].share.upper == 0);
  CHECK(s.bands[2].share.lower == 1);
  CHECK(s.bands[2].share.upper == 1);
  CHECK(s.area == doctest::Approx(1.0).epsilon(1e-9));
  for (size_t f = 0; f < r.field.face_count(); ++f) check_encloses(r.field.of(f), 0.25, 1e-3);
}

// A: x from 0 to 1 at height x / 4 above B's plane, on which its feet lie.
TEST_CASE("a wedge: distances from 0 to a quarter, evenly") {
  Mesh a = square_patch(3, 0.0);
  for (glm::dvec3& v : a.vertices) v.z = 0.25 * v.x;
  const Mesh b = translated(scaled(square_patch(5, 0.0), 2), {-1.5, -1.5, 0});
  const SurveyResult r = surveyed(a, b, all_of_it({0.05, 0.125, 0.2}));
  REQUIRE(r.statistics);
  const Statistics& s = *r.statistics;
  CHECK(r.is_met());
  check_encloses(s.mean, 0.125, 1e-3);
  check_encloses(s.rms, 0.25 / std::sqrt(3.0), 1e-3);
  for (const AreaWithin& band : s.bands) check_encloses(band.share, band.distance * 4, 1e-3);
  for (const Percentile& p : s.percentiles) check_encloses(p.distance, p.share / 4, 1e-3);
  for (const AreaWithin& step : s.curve)
    check_encloses(step.share, std::min(step.distance * 4, 1.0), 0.02);
}

/// The mean over the part of a plane triangle, at distance d from the origin, of 1 - |x|: by
/// quadrature of Gauss's seven points on many parts.
double mean_from_sphere(const Mesh& facets) {
  double area = 0, sum = 0;
  for (const glm::uvec3& f : facets.faces) {
    const glm::dvec3 a = facets.vertices[f.x], b = facets.vertices[f.y], c = facets.vertices[f.z];
    const double part = glm::length(glm::cross(b - a, c - a)) / 2;
    constexpr int kParts = 16;
    for (int i = 0; i < kParts; ++i) {
      for (int j = 0; j < 2 * (kParts - i) - 1; ++j) {
        const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
        const double v = (i + third) / kParts, w = (j / 2 + third) / kParts;
        sum += part / (kParts * kParts) * (1 - glm::length(a + v * (b - a) + w * (c - a)));
      }
    }
    area += part;
  }
  return sum / area;
}

// B is so fine a sphere that its error is far under the tolerance.
TEST_CASE("a sphere's facets under the sphere") {
  const Mesh a = icosphere(1.0, 1), b = icosphere(1.0, 6);
  SurveyOptions options = all_of_it();
  options.mean_tolerance = 0.01;
  options.effort = 400000;
  const SurveyResult r = surveyed(a, b, options);
  REQUIRE(r.statistics);
  const double truth = mean_from_sphere(a);
  constexpr double kOff = 4e-4;  // of B's facets, whose edges are 0.02 long, and the quadrature
  CHECK(r.statistics->mean.lower <= truth + kOff);
  CHECK(r.statistics->mean.upper >= truth - kOff);
  CHECK(r.statistics->mean.upper - r.statistics->mean.lower <= 0.01 * 0.2);
}

/// Statistics of random points of A, uniform in area.
struct Sampled {
  double mean = 0, rms = 0, within = 0;
};
Sampled sample(const Mesh& a, const Mesh& b, double band, int count) {
  std::vector<double> sums;
  double area = 0;
  for (const glm::uvec3& f : a.faces) {
    const glm::dvec3 p = a.vertices[f.x];
    area += glm::length(glm::cross(a.vertices[f.y] - p, a.vertices[f.z] - p)) / 2;
    sums.push_back(area);
  }
  const ClosestTree tree(b.vertices, b.faces);
  Random random(5);
  Sampled out;
  for (int i = 0; i < count; ++i) {
    const auto face = std::min<size_t>(
        static_cast<size_t>(std::lower_bound(sums.begin(), sums.end(), random.unit() * area) -
                            sums.begin()),
        sums.size() - 1);
    double v = random.unit(), w = random.unit();
    if (v + w > 1) v = 1 - v, w = 1 - w;
    const glm::uvec3 f = a.faces[face];
    const glm::dvec3 p = a.vertices[f.x] + v * (a.vertices[f.y] - a.vertices[f.x]) +
                         w * (a.vertices[f.z] - a.vertices[f.x]);
    Nearest nearest;
    tree.query(p, nearest);
    const double d = std::sqrt(nearest.squared);
    out.mean += d / count;
    out.rms += d * d / count;
    out.within += (d <= band ? 1.0 : 0.0) / count;
  }
  out.rms = std::sqrt(out.rms);
  return out;
}

TEST_CASE("random points agree within what is random of them") {
  constexpr int kPoints = kIsSanitized ? 2000 : 40000;
  const auto check = [&](const Mesh& a, const Mesh& b, double band) {
    const SurveyResult r = surveyed(a, b, all_of_it({band}));
    REQUIRE(r.statistics);
    const Statistics& s = *r.statistics;
    const Sampled seen = sample(a, b, band, kPoints);
    const double largest = *std::max_element(r.field.upper.begin(), r.field.upper.end());
    const double off = 5 * largest / std::sqrt(1.0 * kPoints);
    CHECK(seen.mean >= s.mean.lower - off);
    CHECK(seen.mean <= s.mean.upper + off);
    CHECK(seen.rms >= s.rms.lower - off);
    CHECK(seen.rms <= s.rms.upper + off);
    const double share_off = 2.5 / std::sqrt(1.0 * kPoints);
    CHECK(seen.within >= s.bands[0].share.lower - share_off);
    CHECK(seen.within <= s.bands[0].share.upper + share_off);
  };
  check(height_field(12, 1), height_field(12, 3), 0.1);
  check(icosphere(1, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}), 0.2);
  check(soup(1, 60), soup(2, 90), 0.1);
}

/// One face as a mesh.
Mesh face_of(const Mesh& mesh, size_t face) {
  const glm::uvec3 f = mesh.faces[face];
  return single_triangle(mesh.vertices[f.x], mesh.vertices[f.y], mesh.vertices[f.z]);
}

TEST_CASE("every face's bounds meet the double-precision solver's") {
  const auto check = [](const Mesh& a, const Mesh& b, bool is_whole) {
    SurveyOptions options;
    options.faces = true;
    if (!is_whole) options.effort = 0;  // the first bounds of all faces, and no more
    const SurveyResult r = surveyed(a, b, options);
    const double largest = *std::max_element(r.field.upper.begin(), r.field.upper.end());
    for (size_t f = 0; f < a.faces.size(); ++f) {
      const Interval truth = reference_hausdorff(face_of(a, f), b, 1e-4 * largest);
      CHECK(r.field.lower[f] <= truth.upper);
      CHECK(r.field.upper[f] >= truth.lower);
      CHECK(r.field.lower[f] <= r.field.upper[f]);
      if (is_whole) CHECK(r.field.upper[f] - r.field.lower[f] <= 0.0101 * largest);
    }
    CHECK(r.ended == (is_whole ? SurveyEnd::kMet : SurveyEnd::kEffort));
  };
  check(icosphere(1, 2), translated(icosphere(1.1, 3), {0.1, 0.2, 0.05}), true);
  check(soup(1, 60), soup(2, 90), true);
  check(height_field(12, 1), height_field(12, 3), true);
  check(soup(3, 200), soup(4, 90), false);
}

TEST_CASE("hard pairs: the field holds h, and every percentile is in order") {
  const size_t families = family_names().size();
  for (size_t i = 0; i < families; ++i) {
    CAPTURE(family_names()[i]);
    const HardPair hard = hard_pair(i, 300 + i);
    SurveyOptions options = all_of_it();
    options.effort = 30000;
    const Report report = solver().distance(hard.pair.a, hard.pair.b);
    options.upper = report.upper;
    const SurveyResult r = survey_mesh(solver(), {hard.pair.a, hard.pair.b}, options);
    const double most = *std::max_element(r.field.upper.begin(), r.field.upper.end());
    const double least = *std::max_element(r.field.lower.begin(), r.field.lower.end());
    CHECK(most >= report.lower);
    CHECK(least <= report.upper);
    if (!r.statistics) continue;
    const Statistics& s = *r.statistics;
    CHECK(s.mean.lower <= s.mean.upper);
    CHECK(s.mean.lower <= s.rms.upper);
    CHECK(s.rms.lower <= most);
    for (size_t k = 1; k < s.percentiles.size(); ++k) {
      CHECK(s.percentiles[k].distance.lower >= s.percentiles[k - 1].distance.lower);
      CHECK(s.percentiles[k].distance.upper >= s.percentiles[k - 1].distance.upper);
    }
    for (size_t k = 1; k < s.curve.size(); ++k)
      CHECK(s.curve[k].share.lower >= s.curve[k - 1].share.lower - 1e-12);
    CHECK(s.curve.back().share.upper == 1);
  }
}

TEST_CASE("faces are only told apart by a limit, where there is one") {
  const Mesh a = icosphere(1, 3), b = translated(icosphere(1.1, 3), {0.1, 0.2, 0.05});
  SurveyOptions options;
  options.faces = true;
  options.limit = {0.2, 0.2};
  options.face_tolerance = 1;  // no more than the verdicts
  const SurveyResult r = surveyed(a, b, options);
  CHECK(r.is_met());
  size_t within = 0, beyond = 0;
  for (size_t f = 0; f < a.faces.size(); ++f) {
    const Verdict verdict = verdict_of(r.field, f, options.limit);
    within += verdict == Verdict::kWithin;
    beyond += verdict == Verdict::kBeyond;
  }
  CHECK(within > 0);
  CHECK(beyond > 0);
  CHECK(within + beyond == a.faces.size());
}

TEST_CASE("without area there are bounds of faces, and no statistics") {
  const Mesh a = make_mesh("a segment", {{0, 0, 1}, {1, 0, 1}}, {{0, 1, 1}});
  const SurveyResult r = surveyed(a, square_patch(2, 0.0, 4.0), all_of_it({2.0}));
  CHECK(!r.statistics);
  CHECK(r.field.face_count() == 1);
}

/// Compares to the last bit.
bool same(double x, double y) { return std::bit_cast<uint64_t>(x) == std::bit_cast<uint64_t>(y); }
bool same(const Enclosure& x, const Enclosure& y) {
  return same(x.lower, y.lower) && same(x.upper, y.upper);
}

void check_same(const Statistics& x, const Statistics& y) {
  CHECK(same(x.area, y.area));
  CHECK(same(x.mean, y.mean));
  CHECK(same(x.rms, y.rms));
  const auto is_same = [](const auto& one, const auto& other) {
    REQUIRE(one.size() == other.size());
    for (size_t i = 0; i < one.size(); ++i) {
      if constexpr (requires { one[i].distance.lower; }) {
        CHECK(same(one[i].distance, other[i].distance));
      } else {
        CHECK(same(one[i].distance, other[i].distance));
        CHECK(same(one[i].share, other[i].share));
      }
    }
  };
  is_same(x.bands, y.bands);
  is_same(x.percentiles, y.percentiles);
  is_same(x.curve, y.curve);
}

void check_same(const SurveyResult& x, const SurveyResult& y) {
  CHECK(x.ended == y.ended);
  CHECK(x.cells == y.cells);
  CHECK(x.bounded == y.bounded);
  REQUIRE(x.field.face_count() == y.field.face_count());
  size_t others = 0;
  for (size_t f = 0; f < x.field.face_count(); ++f) others += !same(x.field.of(f), y.field.of(f));
  CHECK(others == 0);
  REQUIRE(x.statistics.has_value() == y.statistics.has_value());
  if (x.statistics) check_same(*x.statistics, *y.statistics);
}

/// The number of threads, until the end of a scope.
struct Threads {
  explicit Threads(size_t count) { limit_threads(count); }
  ~Threads() { limit_threads(0); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
};

// Its two halves are mirrored, so that many cells have the same score: which of them are split must
// follow from their numbers.
Mesh lifted_roof() {
  Mesh a = square_patch(24, 0.0);
  for (glm::dvec3& v : a.vertices) v.z = 0.125 + 0.25 * std::abs(v.x - 0.5);
  return a;
}

TEST_CASE("a device's survey is the same with other threads and other batches") {
  const Mesh roof = lifted_roof(), plane = square_patch(2, 0.0);
  const Mesh hills = height_field(40, 1), others = height_field(40, 3);
  const auto check = [](const Mesh& a, const Mesh& b, bool goes_on_in_the_host) {
    CAPTURE(goes_on_in_the_host);
    SurveyOptions options = all_of_it({0.14, 0.2});
    options.mean_tolerance = options.face_tolerance = 1e-6;  // the effort ends it
    options.effort = 50000;
    if (goes_on_in_the_host) options.normals_within = 20;
    options.cosine_tolerance = options.agreeing_tolerance = 1e-9;
    const Threads one(1);
    const SurveyResult first = surveyed(a, b, options);
    const bool is_exact = is_native() && first.is_met();  // planes over planes, in doubles
    CHECK((is_exact || first.ended == SurveyEnd::kEffort));
    CHECK((is_exact || first.cells > kBlock));
    for (const size_t threads : std::initializer_list<size_t>{2, 7}) {
      const Threads limit(threads);
      options.submission_ms = threads == 2 ? 1 : 1000;
      check_same(first, surveyed(a, b, options));
    }
  };
  check(roof, plane, false);
  check(hills, others, false);
  check(hills, others, true);
}

TEST_CASE("the effort is kept to the last goals, of normals") {
  const Mesh a = height_field(12, 1), b = height_field(12, 3);
  SurveyOptions options = all_of_it();
  options.normals_within = 20;
  options.face_tolerance = options.mean_tolerance = 1e-6;
  options.cosine_tolerance = options.agreeing_tolerance = 1e-9;
  for (const size_t effort : std::initializer_list<size_t>{0, 1, 2, 999, 1000, 20001}) {
    CAPTURE(effort);
    options.effort = effort;
    const SurveyResult r = surveyed(a, b, options);
    CHECK(r.ended == SurveyEnd::kEffort);
    CHECK(r.effort == effort);
    CHECK(r.bounded == a.faces.size() + effort / 4 * 4);
  }
}

TEST_CASE("a survey says why it ended") {
  const Mesh a = lifted_roof(), b = square_patch(2, 0.0);
  SurveyOptions options = all_of_it();
  options.face_tolerance = options.mean_tolerance = 1e-6;
  options.time_limit_s = 0;
  CHECK(surveyed(a, b, options).ended == SurveyEnd::kTime);
  options.goes_on = [](size_t) { return false; };
  CHECK(surveyed(a, b, options).ended == SurveyEnd::kCancelled);
  options = all_of_it();
  options.face_tolerance = options.mean_tolerance = 0.1;
  CHECK(!options.effort);
  const SurveyResult met = surveyed(a, b, options);
  CHECK(met.ended == SurveyEnd::kMet);
  CHECK((met.effort == default_effort(true) || met.effort == default_effort(false)));
  const Mesh segment = make_mesh("a segment", {{0, 0, 1}, {1, 0, 1}}, {{0, 1, 1}});
  options.faces = false;
  CHECK(surveyed(segment, b, options).ended == SurveyEnd::kBits);
  options.faces = true;
  options.statistics = false;
  CHECK(surveyed(segment, b, options).ended == SurveyEnd::kMet);
  options.face_tolerance = 1e-12;
  CHECK(surveyed(square_patch(1, 0.25), b, options).ended == SurveyEnd::kBits);
}

}  // namespace

TEST_CASE("a percentile is a share of the area, not a number of per cent") {
  SurveyOptions options = all_of_it();
  for (const double share : {95.0, -0.1, std::nan("")}) {
    options.percentiles = {0.5, share};
    CHECK_THROWS_AS(surveyed(icosphere(1, 1), icosphere(2, 1), options), UsageError);
  }
}

TEST_CASE("files of fields and certificates refuse what no survey or prover made") {
  const Mesh mesh = icosphere(1, 1);
  const Field field = field_within(mesh.faces.size() - 1, 1);
  const FieldFile file{.mesh = mesh, .field = field, .interval = {0, 1}, .unit = "", .against = ""};
  CHECK_THROWS_AS(to_ply(file), UsageError);
  CHECK_THROWS_AS(to_glb(file), UsageError);
  CHECK_THROWS_AS(certificate_of({mesh, {}}, {mesh, {}}, {Report{}, Proof{}}, {}), UsageError);
}
