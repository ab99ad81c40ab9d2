// Points in place of A or B, against exact arithmetic: h, the bounds that the host measures of a
// survey's points, and figures, also of those alone that are near enough. VKH_POINTS_COUNT: how
// many clouds (nightly: 1000).
#include "host/survey/point_distances.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include "tests/shapes/shapes.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/exact.h"
#include "vkhausdorff/solver.h"
#include "vkhausdorff/survey.h"

namespace {

using namespace vkh;
using namespace vkh::test;

/// Points on B's vertices, near its faces at every scale, and around it.
Mesh points_about(const Mesh& b, uint64_t seed, size_t count) {
  Random random(seed);
  std::vector<DVec3> points;
  for (size_t i = 0; i < count; ++i) {
    const auto [x, y, z] = corners(b, random.below(static_cast<uint32_t>(b.faces.size())));
    const double u = random.unit(), v = (1 - u) * random.unit();
    const double size = i % 3 == 0 ? 0.0 : std::exp2(random.range(-45, 1));
    const glm::dvec3 on = i % 2 == 0 ? x : (1 - u - v) * x + u * y + v * z;
    points.emplace_back(on + size * random.direction());
  }
  return make_points("points", std::move(points));
}

gpu::CellBounds nothing_known() {
  gpu::CellBounds b{};
  b.upper_a = b.upper_b = b.upper_c = b.highest = b.mean_upper = 1e30f;
  b.square_upper = 3e38f;
  b.face = gpu::kNone;
  return b;
}

/// Checks bounds in the frame against the exact distance of a point, in its files' units.
void check_bounds(const gpu::CellBounds& b, const Frame& frame, const Rational& squared) {
  const double unit = std::ldexp(1.0, -frame.exponent);
  for (const float lower : {b.lower_a, b.lower_b, b.lower_c, b.reached})
    CHECK(is_lower_bound(static_cast<double>(lower) * unit, squared));
  for (const float upper : {b.upper_a, b.upper_b, b.upper_c, b.highest, b.mean_upper})
    CHECK(is_upper_bound(static_cast<double>(upper) * unit, squared));
  CHECK(is_upper_bound_of_square(static_cast<double>(b.square_upper) * unit * unit, squared));
  const double width = static_cast<double>(b.highest) - static_cast<double>(b.lower_a);
  // A needle turns the direction of a distance that is as small as its roundings.
  CHECK(width <= 0x1p-22 * static_cast<double>(b.highest) + 0x1p-24);
}

std::vector<Mesh> surfaces() {
  return {height_field(8, 1),
          needles(3, 40),
          slivers(4, 40),
          caps(5, 40),
          degenerate_faces(6, 40),
          scaled(height_field(6, 1), 100),
          make_points("B", {{0, 0, 0}, {1, 0, 0}, {1, 1e-9, 0}, {0.25, 0.5, 1}}),
          translated(height_field(6, 1), {1000.5, -4096.25, 77})};
}

TEST_CASE("bounds of points hold in exact arithmetic, and are as narrow as floats") {
  for (const Mesh& b : surfaces()) {
    const Mesh a = points_about(b, 7, kIsSanitized ? 30 : 150);
    const FramedPair framed = frame_pair(a, b);
    const SurveyedPair pair{
        a, b, framed.frame, 0, farthest_in(join(framed.box_a, framed.box_b), 0), true};
    const PointDistances distances(pair);
    for (uint32_t f = 0; f < a.faces.size(); ++f) {
      CAPTURE(f);
      check_bounds(distances.narrowed(f, nothing_known()), pair.frame,
                   squared_distance_exact(a.vertices[f], b));
    }
  }
}

TEST_CASE("a displacement widens them, and what was known stays") {
  const Mesh b = square_patch(3, 0.0), a = make_points("A", {{0.5, 0.5, 0.25}, {0.5, 0.5, 0}});
  const FramedPair framed = frame_pair(a, b);
  const PointDistances distances({a, b, framed.frame, 0.125, 2, true});
  const double z = framed.frame.to_frame(0.25);
  const gpu::CellBounds wide = distances.narrowed(0, nothing_known());
  CHECK(static_cast<double>(wide.lower_a) <= z - 0.125);
  CHECK(static_cast<double>(wide.lower_a) >= z - 0.1251);
  CHECK(static_cast<double>(wide.highest) >= z + 0.125);
  CHECK(static_cast<double>(wide.highest) <= z + 0.1251);
  CHECK(distances.narrowed(1, nothing_known()).reached == 0);
  gpu::CellBounds known = nothing_known();
  known.lower_a = known.lower_b = known.lower_c = known.highest = static_cast<float>(z);
  const gpu::CellBounds kept = distances.narrowed(0, known);
  CHECK(kept.lower_b == static_cast<float>(z));
  CHECK(kept.highest == static_cast<float>(z));
}

TEST_CASE("coordinates that the frame rounds leave bounds as they are") {
  const Mesh b = square_patch(3, 0.0), a = make_points("A", {{0x1.8p-1074, 0.5, 0.25}, {1, 1, 1}});
  const PointDistances distances({a, b, {glm::dvec3(0), -3}, 0, 2, true});
  CHECK(distances.narrowed(0, nothing_known()).highest == nothing_known().highest);
  CHECK(distances.narrowed(1, nothing_known()).highest < 1);
}

SurveyResult surveyed(const Mesh& a, const Mesh& b, size_t effort) {
  SurveyOptions options;
  options.faces = options.statistics = true;
  options.field_tolerance = 1e-9;
  options.mean_tolerance = 0.001;
  options.effort = effort;
  return survey_mesh(solver(), {a, b}, options);
}

double width(const Enclosure& e) { return e.upper - e.lower; }

TEST_CASE("points are measured once each, and figures get narrower with effort") {
  if (is_native()) return;  // its first bounds of points are as narrow
  const Mesh b = height_field(16, 1);
  Random random(12);
  std::vector<DVec3> points;
  const size_t half = kIsSanitized ? 60 : 300;
  for (size_t i = 0; i < 2 * half; ++i)
    points.emplace_back(random.range(-1, 1), random.range(-1, 1), random.range(-0.1, 0.2));
  const Mesh a = make_points("points", points);
  const SurveyResult none = surveyed(a, b, 0), some = surveyed(a, b, half),
                     all = surveyed(a, b, 1'000'000);
  CHECK(none.ended == SurveyEnd::kEffort);
  CHECK(none.bounded == points.size());
  CHECK(some.ended == SurveyEnd::kEffort);
  CHECK(some.bounded == points.size() + half / 2);
  CHECK(all.ended != SurveyEnd::kEffort);
  CHECK(all.bounded <= 2 * points.size());
  double sum = 0;
  for (const DVec3& p : points) sum += sqrt_near(squared_distance_exact(p, b));
  const double mean = sum / static_cast<double>(points.size());
  for (const SurveyResult* r : {&none, &some, &all}) {
    REQUIRE(r->statistics);
    CHECK(r->cells == points.size());
    for (size_t i = 0; i < points.size(); i += 10) {
      const Rational squared = squared_distance_exact(points[i], b);
      CHECK(is_lower_bound(r->field.lower[i], squared));
      CHECK(is_upper_bound(r->field.upper[i], squared));
    }
    CHECK(r->statistics->mean.lower <= mean * (1 + 1e-12));
    CHECK(r->statistics->mean.upper >= mean * (1 - 1e-12));
  }
  CHECK(width(some.statistics->mean) < 0.9 * width(none.statistics->mean));
  CHECK(width(all.statistics->mean) < 0.4 * width(none.statistics->mean));
  CHECK(all.statistics->mean.lower == surveyed(a, b, 1'000'000).statistics->mean.lower);
}

uint64_t cloud_count() {
  const char* asked = std::getenv("VKH_POINTS_COUNT");
  if (asked != nullptr) return std::strtoull(asked, nullptr, 10);
  return kIsSanitized ? 8 : 50;
}

/// Random triangles, with and without area, or a sheet.
Mesh any_surface(uint64_t seed) {
  const uint32_t some = 1 + Random(seed).below(40);
  if (seed % 3 == 0) return soup(seed, some);
  if (seed % 3 == 1) return degenerate_faces(seed, some);
  return noisy(height_field(1 + some % 6, 1), 0.1, seed);
}

/// The square of the largest distance of a vertex of A from B.
Rational farthest_squared(const Mesh& a, const Mesh& b) {
  Rational most = 0;
  for (const DVec3& v : a.vertices) most = std::max(most, squared_distance_exact(v, b));
  return most;
}

TEST_CASE("h of a cloud is the distance of its farthest point, and of a surface it is no less") {
  for (uint64_t i = 0; i < cloud_count(); ++i) {
    CAPTURE(i);
    const Mesh b = any_surface(i), cloud = points_about(b, i, 2 + Random(i).below(120));
    const Report there = solver().distance(cloud, b);
    const Rational squared = farthest_squared(cloud, b);
    CHECK(is_lower_bound(there.lower, squared));
    CHECK(is_upper_bound(there.upper, squared));
    CHECK(there.status == Status::kClosed);
    CHECK(is_upper_bound(solver().distance(b, cloud).upper, farthest_squared(b, cloud)));
  }
}

// CloudCompare's issue 2247.
TEST_CASE("a point that is hardly over a triangle has its distance, and the same bits each time") {
  const Mesh flat = joined(single_triangle({0, 0, 0}, {1, 0, 0}, {0.3, 0.9, 0}),
                           single_triangle({0.4, 0.3, 8e-6}, {0.4, 0.3, 8e-6}, {0.4, 0.3, 8e-6}));
  SolveOptions options;
  options.tolerance = 1e-9;
  options.tolerance_is_absolute = true;
  for (const Mesh& both : {flat, translated(rotated(flat, {0, 1, 0}, 0.9), {1000, 1000, 1000})}) {
    const Mesh over = make_points("over", {both.vertices.back()});
    const Mesh plane = make_mesh("plane", both.vertices, {{0, 1, 2}});
    const Report first = solver().distance(over, plane, options);
    const Rational squared = farthest_squared(over, plane);
    CHECK(is_lower_bound(first.lower, squared));
    CHECK(is_upper_bound(first.upper, squared));
    CHECK(first.upper - first.lower < 1e-8);
    for (int again = 0; again < (kIsSanitized ? 1 : 10); ++again)
      check_same(solver().distance(over, plane, options), first);
  }
}

void check_within(const Enclosure& e, double truth, double width) {
  INFO(truth, " in [", e.lower, ", ", e.upper, "]");
  CHECK(e.lower <= truth * (1 + 1e-12));
  CHECK(e.upper >= truth * (1 - 1e-12));
  CHECK(e.upper - e.lower <= width);
}

/// Checks the figures of points at these distances, which ascend.
void check_figures(const Statistics& found, const std::vector<double>& kept) {
  const double count = static_cast<double>(kept.size());
  double sum = 0, squares = 0;
  for (const double h : kept) sum += h, squares += h * h;
  check_within(found.mean, sum / count, 2e-4);
  check_within(found.rms, std::sqrt(squares / count), 2e-4);
  const auto near = std::upper_bound(kept.begin(), kept.end(), 0.1) - kept.begin();
  check_within(found.bands[0].share, static_cast<double>(near) / count, 1e-9);
  for (const Percentile& p : found.percentiles) {
    const double place = std::ceil(p.share * count - 1e-9);
    check_within(p.distance, kept[static_cast<size_t>(place) - 1], INFINITY);
  }
}

/// Heights over a plane: none, one that floats hold, any, and far ones.
std::vector<double> some_heights(Random& random) {
  std::vector<double> heights;
  for (uint32_t i = 1 + random.below(60); i > 0; --i) {
    const double any[] = {0, 0.125, random.unit(), random.range(5, 50)};
    heights.push_back(any[random.below(4)]);
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

TEST_CASE("figures weigh points alike, and leave out what is farther than was asked") {
  const Mesh b = big_plane(9.0);
  Random random(43);
  for (int i = 0; i < (kIsSanitized ? 6 : 12); ++i) {
    std::vector<double> heights = some_heights(random);
    std::vector<DVec3> points;
    for (const double h : heights) points.emplace_back(0.1, 0.2, h);
    const double most = std::vector<double>{INFINITY, 0.2, 1.5, 20, 0.003, 100}[i % 6];
    CAPTURE(most);
    SurveyOptions options;
    options.statistics = true;
    options.mean_tolerance = 1e-5;
    options.bands = {0.1};
    if (std::isfinite(most)) options.max_distance = Limit{most, most};
    const Statistics found =
        *survey_mesh(solver(), {make_points("A", points), b}, options).statistics;
    CHECK(found.points == points.size());
    CHECK(found.area == 0);
    const size_t all = heights.size();
    std::erase_if(heights, [&](double h) { return h > most; });
    REQUIRE(found.kept.has_value() == std::isfinite(most));
    if (found.kept)
      check_within(*found.kept, static_cast<double>(heights.size()) / static_cast<double>(all),
                   1e-12);
    if (!heights.empty()) check_figures(found, heights);
  }
}

}  // namespace
