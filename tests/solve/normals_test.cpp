// Normals of two surfaces: roundings against rational arithmetic, closed forms, and a sampler of
// its own.
#include "host/survey/normals.h"

#include <doctest/doctest.h>
#include <gmpxx.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "host/answer/exit_code.h"
#include "tests/shapes/shapes.h"
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

TEST_CASE("cosines of normals enclose what exact arithmetic says") {
  Random random(91);
  int known = 0;
  for (int i = 0; i < 20000; ++i) {
    const Corners3 s = any_triangle(random), t = any_triangle(random);
    const Enclosure e = cosine_of(unit_normal(s), unit_normal(t));
    const Exact3 m = normal_of(s), n = normal_of(t);
    const mpq_class product = dot(m, n), sizes = dot(m, m) * dot(n, n);
    known += e.upper - e.lower < 1e-3 ? 1 : 0;
    // cos^2 sizes = product^2
    REQUIRE(mpq_class(e.lower) * mpq_class(e.lower) * sizes <= product * product);
    REQUIRE(mpq_class(e.upper) * mpq_class(e.upper) * sizes >= product * product);
  }
  CHECK(known > 5000);
}

// Whether the closest point of a triangle lies on a corner or an edge, by exact signs for one p.
bool lies_on(const Exact3& p, const Corners3& t, const std::array<bool, 3>& feature) {
  const int count = static_cast<int>(feature[0]) + feature[1] + feature[2];
  for (size_t i = 0; i < 3; ++i) {
    const Exact3 s = exact(t[i]), u = exact(t[(i + 1) % 3]), v = exact(t[(i + 2) % 3]);
    if (count == 1 && feature[i])
      return dot(minus(p, s), minus(u, s)) <= 0 && dot(minus(p, s), minus(v, s)) <= 0;
    if (count == 2 && feature[i] && feature[(i + 1) % 3]) {
      const Exact3 e = minus(u, s), outward = times(e, times(e, minus(v, s)));
      return dot(minus(p, s), e) >= 0 && dot(minus(p, u), e) <= 0 && dot(minus(p, s), outward) >= 0;
    }
  }
  return false;
}

TEST_CASE("a feature on which the closest point lies is one in exact arithmetic") {
  Random random(92);
  int corners = 0, edges = 0;
  for (int i = 0; i < 20000; ++i) {
    const Corners3 t = any_triangle(random);
    const double size = glm::length(t[1] - t[0]);
    const glm::dvec3 at = t[static_cast<size_t>(i % 3)] + any_point(random, 3 * size);
    const double radius = size * std::ldexp(1.0, -static_cast<int>(random.unit() * 40));
    PlacedCell cell{};
    for (glm::dvec3& p : cell.corners) p = at + any_point(random, radius);
    cell.off = off_at(cell.corners);
    const std::array<bool, 3> feature = closest_feature(cell, t);
    const int count = static_cast<int>(feature[0]) + feature[1] + feature[2];
    corners += count == 1 ? 1 : 0;
    edges += count == 2 ? 1 : 0;
    if (count == 0) continue;
    for (const glm::dvec3& p : cell.corners) {
      for (int k = 0; k < 4; ++k) {
        const glm::dvec3 moved =
            p +
            glm::dvec3(random.range(-1, 1), random.range(-1, 1), random.range(-1, 1)) * cell.off;
        REQUIRE(lies_on(exact(moved), t, feature));
      }
    }
  }
  CHECK(corners > 1000);
  CHECK(edges > 1000);
}

TEST_CASE("a separation is below the distance of any two points") {
  Random random(93);
  int apart = 0;
  for (int i = 0; i < 20000; ++i) {
    const Corners3 t = any_triangle(random);
    PlacedCell cell{};
    cell.corners = any_triangle(random);
    if (i % 2 == 0) {
      for (glm::dvec3& p : cell.corners) p = t[0] + (p - cell.corners[0]) * 1.5;
    }
    cell.off = off_at(cell.corners);
    const glm::dvec3 centre = (cell.corners[0] + cell.corners[1] + cell.corners[2]) * (1.0 / 3);
    const mpq_class least(separation(cell, centre, t));
    apart += least > 0 ? 1 : 0;
    for (int k = 0; k < 8; ++k) {
      const auto inside = [&](const Corners3& of) {
        const mpq_class u(random.unit()), v = (1 - u) * mpq_class(k % 2 == 0 ? 0 : random.unit());
        const Exact3 a = exact(of[0]), e = minus(exact(of[1]), a), f = minus(exact(of[2]), a);
        return Exact3{a[0] + u * e[0] + v * f[0], a[1] + u * e[1] + v * f[1],
                      a[2] + u * e[2] + v * f[2]};
      };
      const Exact3 d = minus(inside(cell.corners), inside(t));
      REQUIRE(least * least <= dot(d, d));
    }
    for (const glm::dvec3& p : cell.corners) {
      for (const glm::dvec3& q : t) {
        const Exact3 d = minus(exact(p), exact(q));
        REQUIRE(least * least <= dot(d, d));
      }
    }
  }
  CHECK(apart > 5000);
}

TEST_CASE("cosines of angles: 60 degrees is a half, and all agree to 90") {
  const Enclosure half = cosine_of_degrees(60);
  CHECK(half.lower <= 0.5);
  CHECK(half.upper >= 0.5);
  CHECK(half.upper - half.lower < 1e-14);
  CHECK(cosine_of_degrees(90).upper == 0);
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
  CHECK(m.normal_consistency.value.lower > 1 - 1e-9);
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
