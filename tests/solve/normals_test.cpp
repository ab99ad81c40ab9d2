// Normals of two surfaces: roundings against rational arithmetic, closed forms, and cells and
// figures against the closest faces of points.
#include "host/survey/normals.h"

#include <doctest/doctest.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "host/answer/exit_code.h"
#include "host/mesh/closest.h"
#include "host/solve/cell_corners.h"
#include "host/solve/held_pairs.h"
#include "tests/shapes/shapes.h"
#include "tests/support/all_cells.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_bench.h"
#include "vkhausdorff/asking.h"
#include "vkhausdorff/length.h"

namespace {

using namespace vkh;
using namespace vkh::test;

// --- Roundings ---

using Exact3 = std::array<mpq_class, 3>;

Exact3 exact(const glm::dvec3& v) { return {mpq_class(v.x), mpq_class(v.y), mpq_class(v.z)}; }
Exact3 minus(const Exact3& x, const Exact3& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
Exact3 times(const Exact3& x, const Exact3& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
mpq_class dot(const Exact3& x, const Exact3& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Exact3 normal_of(const Corners3& t) {
  return times(minus(exact(t[1]), exact(t[0])), minus(exact(t[2]), exact(t[0])));
}

glm::dvec3 any_point(Random& random, double size) {
  return {random.range(-size, size), random.range(-size, size), random.range(-size, size)};
}

// Triangles of all shapes, needles and slivers among them, some far from the origin.
Corners3 any_triangle(Random& random) {
  const double size = std::ldexp(1.0, -static_cast<int>(random.unit() * 30));
  const glm::dvec3 at = random.unit() < 0.5 ? glm::dvec3(0) : any_point(random, 4);
  const glm::dvec3 e = any_point(random, size);
  const double most = random.unit() < 0.9 ? 45 : 700;  // squares of the thinnest underflow
  const double thin = std::ldexp(1.0, -static_cast<int>(random.unit() * most));
  return {at, at + e, at + e * random.unit() + any_point(random, size) * thin};
}

// |m - n / |n|| <= off: with c the part of m along n, and r^2 the square of what is across it,
// (c - 1)^2 + r^2 = m.m - 2 c + 1, and c^2 n.n = (m.n)^2.
TEST_CASE("unit normals are as near as they say, by exact arithmetic") {
  Random random(91);
  constexpr int kTriangles = kIsSanitized ? 2000 : 20000;
  int known = 0;
  for (int i = 0; i < kTriangles; ++i) {
    const Corners3 t = any_triangle(random);
    const UnitNormal found = unit_normal(t);
    if (found.off >= 1) continue;
    known += found.off < 1e-3 ? 1 : 0;
    const Exact3 m = exact(found.along), n = normal_of(t);
    const mpq_class along = dot(m, n),
                    half = (dot(m, m) + 1 - found.off * mpq_class(found.off)) / 2;
    REQUIRE(along > 0);
    // c >= half
    REQUIRE((half <= 0 || half * half * dot(n, n) <= along * along));
  }
  CHECK(known > kTriangles / 4);
}

TEST_CASE("cosines of angles: 60 degrees is a half, and all agree to 90") {
  const Enclosure half = cosine_of_degrees(60);
  CHECK(half.lower <= 0.5);
  CHECK(half.upper >= 0.5);
  CHECK(half.upper - half.lower < 1e-14);
  CHECK(cosine_of_degrees(90).upper == 0);
}

// --- Cells ---

// The largest |cos| between a cell's normal and those of B's faces that are no farther from p than
// `more` beyond the nearest.
double best_cosine(const Mesh& b, const std::vector<glm::dvec3>& normals, const glm::dvec3& p,
                   const glm::dvec3& own, double more) {
  std::vector<double> distances;
  for (const glm::uvec3& f : b.faces) {
    const glm::dvec3 q = closest_point(p, b.vertices[f.x], b.vertices[f.y], b.vertices[f.z]).point;
    distances.push_back(glm::length(p - q));
  }
  const double least = *std::min_element(distances.begin(), distances.end());
  double best = 0;
  for (size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] <= least + more) best = std::max(best, std::abs(glm::dot(own, normals[i])));
  }
  return best;
}

std::vector<glm::dvec3> normals_of(const Mesh& mesh) {
  std::vector<glm::dvec3> normals;
  for (const glm::uvec3& f : mesh.faces) {
    const glm::dvec3 a = mesh.vertices[f.x];
    normals.push_back(glm::normalize(glm::cross(mesh.vertices[f.y] - a, mesh.vertices[f.z] - a)));
  }
  return normals;
}

// A cell alone tells that normals agree on all of it, or on none of it, or leaves that open.
enum class Told : uint8_t { kAgree, kDiffer, kOpen };

Told told_of(SurveyCells& cells, uint32_t i) {
  const std::array<Threshold, 1> at{{{kAnyDistance, kAnyDistance}}};
  const gpu::SurveyPlan plan = plan_of(edges_of(at), {.at = at, .of_normals = true});
  const gpu::SurveyTable& table = cells.tally(plan, kCosineUnit, {i, 1});
  const auto all_from = static_cast<double>(std::bit_cast<float>(table.highest));
  const auto some_from = static_cast<double>(std::bit_cast<float>(~table.not_lowest));
  if (all_from < 1e38) return Told::kAgree;
  return some_from < 1e38 ? Told::kOpen : Told::kDiffer;
}

constexpr uint32_t kStride = kIsSanitized ? 25 : 5;  // of the cells that are looked at

// Where a point has closest faces at one distance but for rounding, the better one may or may not
// be among them: only what any of them says is checked.
void check_cells(const Mesh& a, const Mesh& b, double degrees, std::array<int, 3>& counts) {
  const std::vector<glm::dvec3> of_a = normals_of(a), of_b = normals_of(b);
  const double limit = std::cos(degrees * std::numbers::pi / 180);
  hold_pair(solver(), {a, b}, {}, [&](const SurveyedPair& pair) {
    const Normals normals(pair, degrees);
    const CellsRead all = cells_with_normals(pair, normals.search(), 4 * a.faces.size());
    Random random(17);
    for (uint32_t i = random.below(kStride); i < all.cells.size(); i += kStride) {
      const Told told = told_of(*pair.cells, i);
      ++counts[static_cast<size_t>(told)];
      const lib::Bary3 t = corners_of(all.cells[i]);
      const glm::uvec3 f = a.faces[all.cells[i].face];
      const double u = random.unit(), v = (1 - u) * random.unit();
      const glm::dvec2 w =
          (glm::dvec2(t.a) * (1 - u - v) + glm::dvec2(t.b) * u + glm::dvec2(t.c) * v) /
          static_cast<double>(gpu::kBaryOne);
      const glm::dvec3 p = a.vertices[f.x] + w.x * (a.vertices[f.y] - a.vertices[f.x]) +
                           w.y * (a.vertices[f.z] - a.vertices[f.x]);
      const auto best = [&](double more) {
        return best_cosine(b, of_b, p, of_a[all.cells[i].face], more);
      };
      if (told == Told::kAgree) CHECK(best(1e-9) >= limit - 1e-12);
      if (told == Told::kDiffer) CHECK(best(0) <= limit + 1e-12);
    }
  });
}

TEST_CASE("where normals agree on all of a cell, or on none of it, they do at its points") {
  std::array<int, 3> counts{};
  for (const double degrees : {3.0, 20.0, 60.0}) {
    check_cells(icosphere(1, 2), translated(icosphere(1.1, 2), {0.1, 0.2, 0.05}), degrees, counts);
    check_cells(height_field(9, 1), height_field(7, 3), degrees, counts);
    check_cells(cube(1.5), cube(1.0), degrees, counts);
    check_cells(soup(1, 40), soup(2, 60), degrees, counts);
    check_cells(translated(icosphere(1, 2), {300, 0.1, 0}), translated(cube(1), {300, 0, 0}),
                degrees, counts);
  }
  MESSAGE("agree, differ, open: " << counts[0] << ", " << counts[1] << ", " << counts[2]);
  for (const int count : counts) CHECK(count > 1000 / static_cast<int>(kStride));
}

// --- Closed forms ---

Metrics metrics_between(const Mesh& a, const Mesh& b, double degrees, const char* band,
                        std::optional<uint64_t> effort = {}) {
  Question question;
  question.metrics.emplace().normals = degrees;
  question.metrics->figures = {"normal_consistency", "precision_normals", "recall_normals",
                               "f1_normals"};
  question.bands = {parse_length("--bands", band, PlainNumber::kRefused)};
  question.budget.effort = effort;
  Solver* const on[] = {&solver()};
  const Answer answer =
      Asking(question, std::make_shared<const ReadMesh>(a), std::make_shared<const ReadMesh>(b), on)
          .answer();
  CHECK(to_json(answer_from_json(to_json(answer))) == to_json(answer));
  CHECK(code_of(answer) == (answer.metrics->is_met() ? kExitClosed : kExitNotClosed));
  return *answer.metrics;
}

bool encloses(const Metric& metric, double truth) {
  const Enclosure& e = metric.value;
  return e.lower <= truth + 1e-12 && e.upper >= truth - 1e-12 && e.estimate &&
         *e.estimate >= e.lower && *e.estimate <= e.upper;
}

Mesh scaled_patch(double size, double height) {
  Mesh patch = square_patch(2, height, size);
  for (DVec3& v : patch.vertices) v = {v.x - size / 2, v.y - size / 2, v.z};
  return patch;
}

TEST_CASE("parallel patches: all normals agree, and the cosine is 1") {
  const Metrics m = metrics_between(square_patch(4, 0.25), square_patch(3, 0.0), 20, "0.3abs");
  CHECK(m.is_met());
  CHECK(encloses(m.normal_consistency, 1));
  CHECK(m.normal_consistency.value.lower > 1 - 5e-6);  // floats
  CHECK(encloses(m.within[0].f1_normals, 1));
}

TEST_CASE("a ramp over a plane: the cosine is that of its angle, everywhere") {
  const double angle = std::numbers::pi / 6;
  Mesh ramp = square_patch(3, 0.0);
  for (DVec3& v : ramp.vertices) v.z = std::tan(angle) * v.x;
  const Mesh plane = big_plane(20, -0.01);
  const Metrics more = metrics_between(ramp, plane, 31, "100abs");
  const Metrics less = metrics_between(ramp, plane, 29, "100abs");
  CHECK(more.is_met());
  CHECK(more.within[0].precision_normals.value.lower == 1);
  CHECK(less.within[0].precision_normals.value.upper == 0);
  CHECK(encloses(more.normal_consistency, std::cos(angle)));
}

// Beyond an edge of the small cube two of its faces are closest to the large one's points, and one
// is parallel; beyond a corner, three.
TEST_CASE("around a cube the better face counts: all cosines of a larger one are 1") {
  const Metrics m = metrics_between(cube(1.5), cube(1.0), 20, "10abs", 400000);
  CHECK(encloses(m.normal_consistency, 1));
  CHECK(encloses(m.within[0].precision_normals, 1));
  CHECK(m.within[0].precision_normals.is_met);
}

// At half of the height from the middle the bottom is nearest where no wall is nearer than half of
// the width: on a square of side 1, of 1.8.
TEST_CASE("within a cube the nearest wall changes: the share of a floor that has the bottom's") {
  const Mesh floor = scaled_patch(1.8, -0.5);
  const Metrics m = metrics_between(floor, cube(1.0), 20, "100abs", 400000);
  CHECK(encloses(m.within[0].precision_normals, 1 / (1.8 * 1.8)));
  CHECK(m.within[0].precision_normals.is_met);
  // Within 0.3 of the walls alone: (1.8^2 - 1.4^2) / 1.8^2 of the area, and no normal agrees.
  const Metrics near = metrics_between(floor, cube(1.0), 20, "0.3abs", 400000);
  CHECK(near.within[0].precision_normals.value.upper == 0);
}

// The only closest face is perpendicular to A; another one, parallel to A, has a corner beside its
// own, which scaling lays on it.
TEST_CASE("a corner that is not shared excuses no face, however near the other's") {
  Mesh a, b;
  a.vertices = {{0.5, -0.1, 0.25}, {1, -0.1, 0.25}, {0.5, 0.1, 0.25}};
  a.faces = {{0, 1, 2}};
  b.vertices = {{0, 0, 0},          {-1, 0, 0},           {-1, 0, -1},
                {0, 0, -0x1p-1074}, {-1, -1, -0x1p-1074}, {-1, 1, -0x1p-1074}};
  b.faces = {{0, 1, 2}, {3, 4, 5}};
  const Metrics m = metrics_between(a, b, 20, "10abs", 2000);
  CHECK(m.within[0].precision_normals.value.lower == 0);
  CHECK(m.normal_consistency.value.lower <= 1.0 / 3);
}

// The closest face is nearly perpendicular to A, and thinner than squares of doubles go.
TEST_CASE("a face of subnormal squares is excused by none that is not as close") {
  Mesh a, b;
  a.vertices = {{-0.44372116133775985, 0.20458103051764936, 0.10610434926715445},
                {-0.5379098974469222, 0.323955865978493, 0.23602020914906058},
                {-0.6610446554719646, 0.24148935464537916, 0.06857736554366889}};
  a.faces = {{0, 1, 2}};
  b.vertices = {{0, 0, 0},
                {-0.4709436805458116, 0.5968741773042184, 0.6495792994095309},
                {-4.673406946025801e-171, -4.957726058451358e-171, 8.86454848518469e-171},
                {0.6156737901252117, 0.41233255666556934, 0.8372142180269585}};
  b.faces = {{0, 1, 2}, {0, 1, 3}};
  const Metrics m = metrics_between(a, b, 20, "10abs", 2000);
  CHECK(m.within[0].precision_normals.value.lower == 0);
  CHECK(m.normal_consistency.value.lower <= 0.6);
}

// Points of A by area, with the best of the faces that are closest to each: their mean is within
// four standard deviations of the figure, by a fixed seed.
TEST_CASE("figures hold points of the surface, as near as their number tells") {
  constexpr int kPoints = kIsSanitized ? 400 : 4000;
  const auto check = [](const Mesh& a, const Mesh& b, double degrees) {
    const Metrics m = metrics_between(a, b, degrees, "100abs", 40000);
    const std::vector<glm::dvec3> of_a = normals_of(a), of_b = normals_of(b);
    std::vector<double> areas;
    for (const glm::uvec3& f : a.faces) {
      const glm::dvec3 p = a.vertices[f.x];
      areas.push_back(glm::length(glm::cross(a.vertices[f.y] - p, a.vertices[f.z] - p)));
    }
    std::partial_sum(areas.begin(), areas.end(), areas.begin());
    Random random(23);
    int agree = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double at = random.unit() * areas.back();
      const auto face =
          static_cast<size_t>(std::upper_bound(areas.begin(), areas.end(), at) - areas.begin());
      double u = random.unit(), v = random.unit();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const glm::uvec3 f = a.faces[face];
      const glm::dvec3 p = a.vertices[f.x] + u * (a.vertices[f.y] - a.vertices[f.x]) +
                           v * (a.vertices[f.z] - a.vertices[f.x]);
      agree +=
          best_cosine(b, of_b, p, of_a[face], 1e-9) >= std::cos(degrees * std::numbers::pi / 180)
              ? 1
              : 0;
    }
    const double share = agree / static_cast<double>(kPoints);
    const double off = 4 * std::sqrt(std::max(share * (1 - share), 1e-3) / kPoints);
    const Enclosure& e = m.within[0].precision_normals.value;
    CHECK(share >= e.lower - off);
    CHECK(share <= e.upper + off);
    CHECK(e.upper - e.lower < 0.1);
  };
  check(icosphere(1, 2), translated(icosphere(1.1, 2), {0.1, 0.2, 0.05}), 10);
  check(height_field(9, 1), height_field(7, 3), 20);
  check(translated(cube(1), {0.1, 0.2, 0.3}), icosphere(1, 1), 25);
}

TEST_CASE("a face without area has no normal: what is closest to it alone is not known") {
  Mesh line;
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {9, 9, 9}, {9, 9, 10}, {9, 10, 9}};
  line.faces = {{0, 1, 2}, {3, 4, 5}};
  const Metrics m = metrics_between(square_patch(1, 0.1), line, 20, "1abs", 2000);
  CHECK(m.within[0].precision_normals.value.lower == 0);
  CHECK(m.within[0].precision_normals.value.upper > 0.9);
  CHECK_FALSE(m.is_met());
}

}  // namespace
