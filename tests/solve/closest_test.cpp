// Closest points against exact arithmetic: distances lie in their enclosures, and points on their
// faces, over hostile meshes and points; and the answer does not depend on the other points.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "host/base/parallel.h"
#include "tests/shapes/adversarial.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/exact.h"
#include "vkhausdorff/error.h"

using namespace vkh;
using namespace vkh::test;

namespace {

constexpr size_t kPointsOfMesh = kIsSanitized ? 60 : 1500;

Mesh one_point(const glm::dvec3& at) { return make_mesh("point", {at}, {{0, 0, 0}}); }

std::vector<NamedPair> hostile_meshes() {
  std::vector<NamedPair> all;
  const auto add = [&](const char* name, Mesh mesh) { all.push_back({name, std::move(mesh), {}}); };
  add("soup", soup(1, 90));
  add("needles", needles(2, 60));
  add("slivers", slivers(3, 60));
  add("caps", caps(4, 60));
  add("degenerate", degenerate_faces(5, 60));
  add("duplicates", with_duplicates(cube(1.0), 6));
  add("far from the origin", translated(soup(7, 60), {1e6, -3e7, 1e3}));
  add("tiny", scaled(soup(8, 40), -900));
  add("huge", scaled(soup(9, 40), 1000));
  add("sphere", icosphere(1.0, 1));
  add("plates", joined(big_plane(1.0), big_plane(1.0, 1e-7)));
  add("one point", one_point({0.1, 1e5, -1e-5}));
  add("the largest",
      make_mesh("largest", {{1.7e308, -1.7e308, 0}, {-1.7e308, 1, 2}, {3, 1e308, 1}}, {{0, 1, 2}}));
  add("subnormal", scaled(in_float32(cube(1.0)), -1070));
  return all;
}

glm::dvec3 on_face(Random& random, const Mesh& mesh) {
  const auto t = corners(mesh, random.below(static_cast<uint32_t>(mesh.faces.size())));
  const glm::dvec3 w = barycentrics(random);
  return w.x * t[0] + w.y * t[1] + w.z * t[2];
}

bool is_finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// On a vertex, on a face, above one, in the box, about the middle, far away, or of any size.
glm::dvec3 hostile_point(Random& random, const Mesh& mesh) {
  const auto [lo, hi] = bounding_box(mesh);
  const glm::dvec3 middle = lo / 2.0 + hi / 2.0;
  const double size = std::max(diagonal(mesh) / 2, std::numeric_limits<double>::denorm_min());
  switch (random.below(7)) {
    case 0:
      return mesh.vertices[random.below(static_cast<uint32_t>(mesh.vertices.size()))];
    case 1:
      return on_face(random, mesh);
    case 2:
      return on_face(random, mesh) + size * log_uniform(random, -45, -1) * random.direction();
    case 3:
      return middle + size * random.in_cube(1.0);
    case 4:
      return middle + size * log_uniform(random, -60, -20) * random.direction();
    case 5:
      return middle + size * log_uniform(random, 0, 60) * random.direction();
    default:
      return log_uniform(random, -1070, 1023) * random.in_cube(1.0);
  }
}

std::vector<DVec3> hostile_points(uint64_t seed, const Mesh& mesh, size_t count) {
  Random random(seed);
  std::vector<DVec3> points;
  while (points.size() < count) {
    const glm::dvec3 p = hostile_point(random, mesh);
    if (is_finite(p)) points.emplace_back(p);
  }
  return points;
}

Rational squared_length(const glm::dvec3& p, const glm::dvec3& q) {
  return squared_distance_exact(p, q);
}

/// The square of the distance that a point may have from its face; docs/certificate.md.
Rational squared_allowance(const std::array<glm::dvec3, 3>& t) {
  Rational sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double largest = std::max({std::abs(t[0][i]), std::abs(t[1][i]), std::abs(t[2][i])});
    const Rational off = Rational(largest) * Rational(0x1p-49) + Rational(0x1p-1060);
    sum += off * off;
  }
  return sum;
}

struct Wrong {
  std::atomic<size_t> distances{0}, points{0}, faces{0};
  size_t all() const { return distances + points + faces; }
};

void check_one(const Mesh& mesh, const DVec3& p, const ClosestPoints& found, size_t i,
               Wrong& wrong) {
  const auto t = corners(mesh, found.faces[i]);
  const glm::dvec3 q = found.points[i];
  const auto holds = [&](const Rational& squared) {
    return is_lower_bound(found.lower[i], squared) && is_upper_bound(found.upper[i], squared);
  };
  if (!holds(squared_distance_exact(glm::dvec3(p), mesh))) ++wrong.distances;
  if (!holds(squared_length(p, q))) ++wrong.points;
  if (squared_distance_exact(q, t[0], t[1], t[2]) > squared_allowance(t)) ++wrong.faces;
}

size_t count_wrong(const Mesh& mesh, const std::vector<DVec3>& points, const ClosestPoints& found) {
  Wrong wrong;
  for_each_index((points.size() + 63) / 64, [&](size_t part) {
    for (size_t i = 64 * part; i < std::min(64 * (part + 1), points.size()); ++i)
      check_one(mesh, points[i], found, i, wrong);
  });
  CHECK(wrong.distances == 0);
  CHECK(wrong.points == 0);
  CHECK(wrong.faces == 0);
  return wrong.all();
}

bool same(const ClosestPoints& x, size_t i, const ClosestPoints& y, size_t j) {
  return x.lower[i] == y.lower[j] && x.upper[i] == y.upper[j] && x.points[i] == y.points[j] &&
         x.faces[i] == y.faces[j];
}

}  // namespace

TEST_CASE("every distance lies in its enclosure, and every point on its face") {
  uint64_t seed = 100;
  for (const NamedPair& named : hostile_meshes()) {
    CAPTURE(named.name);
    const std::vector<DVec3> points = hostile_points(++seed, named.a, kPointsOfMesh);
    const ClosestPoints found = solver().closest(named.a, points);
    REQUIRE(found.lower.size() == points.size());
    CHECK(count_wrong(named.a, points, found) == 0);
  }
}

TEST_CASE("enclosures are narrow: 48 bits of the mesh's size and of the distance") {
  for (const Mesh& mesh : {icosphere(1.0, 4), translated(torus(1.0, 0.3, 40, 20), {5, -3, 2})}) {
    const std::vector<DVec3> points = [&] {
      Random random(3);
      std::vector<DVec3> some;
      const auto [lo, hi] = bounding_box(mesh);
      for (int i = 0; i < 4000; ++i) some.emplace_back((lo + hi) / 2.0 + random.in_cube(3.0));
      for (int i = 0; i < 1000; ++i) some.emplace_back(on_face(random, mesh));
      return some;
    }();
    const ClosestPoints found = solver().closest(mesh, points);
    double widest = 0;
    for (size_t i = 0; i < points.size(); ++i)
      widest = std::max(widest, found.upper[i] - found.lower[i]);
    MESSAGE("widest: " << widest / diagonal(mesh) << " of the diagonal");
    CHECK(widest < 1e-11 * diagonal(mesh));
  }
}

TEST_CASE("a point of the mesh is at distance 0, and a vertex comes back as it is") {
  const Mesh mesh = translated(icosphere(1.0, 2), {0.3, 0.7, -4.1});
  const std::vector<DVec3> points(mesh.vertices.begin(), mesh.vertices.end());
  const ClosestPoints found = solver().closest(mesh, points);
  for (size_t i = 0; i < points.size(); ++i) {
    CHECK(found.lower[i] == 0);
    CHECK(found.upper[i] == 0);
    CHECK(found.points[i] == points[i]);
  }
}

// lavapipe ends the device's search there (docs/certificate.md, "Loops that a driver ends").
TEST_CASE("from a sphere's centre most of its faces may be the closest") {
  const Mesh mesh = icosphere(1.0, 6);  // 81,920
  const std::vector<DVec3> points{{0, 0, 0}, {1e-9, 0, 0}, {0.5, 0.25, 0}};
  const ClosestPoints found = solver().closest(mesh, points);
  CHECK(count_wrong(mesh, points, found) == 0);
  CHECK(found.upper[0] - found.lower[0] < 1e-3);
  CHECK(found.upper[2] - found.lower[2] < 1e-11);
}

TEST_CASE("an answer depends on B and its point alone") {
  const Mesh mesh = soup(11, 200);
  std::vector<DVec3> points = hostile_points(12, mesh, 20'000);
  const ClosestPoints found = solver().closest(mesh, points);
  const PreparedMesh prepared = solver().prepare(mesh);
  for (const size_t i : {size_t{0}, size_t{7}, size_t{19'999}}) {
    const ClosestPoints alone = solver().closest(prepared, {&points[i], 1});
    CHECK(same(found, i, alone, 0));
  }
  std::reverse(points.begin(), points.end());
  const ClosestPoints reversed = solver().closest(prepared, points);
  size_t different = 0;
  for (size_t i = 0; i < points.size(); ++i)
    different += same(found, i, reversed, points.size() - 1 - i) ? 0 : 1;
  CHECK(different == 0);
}

TEST_CASE("a mesh that is off its exact place widens both ends") {
  Mesh mesh = cube(1.0);
  const std::vector<DVec3> points{{3, 0, 0}};
  const ClosestPoints exact = solver().closest(mesh, points);
  mesh.delta = 0.25;
  const ClosestPoints off = solver().closest(mesh, points);
  CHECK(exact.upper[0] == doctest::Approx(2));
  CHECK(off.lower[0] == doctest::Approx(1.75));
  CHECK(off.lower[0] <= 1.75);
  CHECK(off.upper[0] >= 2.25);
  CHECK(off.points[0] == DVec3(1, 0, 0));
}

TEST_CASE("what is no point and no mesh is refused, no points are no error") {
  const Mesh mesh = cube(1.0);
  CHECK(solver().closest(mesh, {}).lower.empty());
  const std::vector<DVec3> points{{0, 0, 0}, {0, std::nan(""), 0}};
  CHECK_THROWS_WITH_AS(solver().closest(mesh, points),
                       "points: row 1: (0, nan, 0) is not finite; expected finite coordinates",
                       InputError);
  Mesh none;
  none.name = "none";
  CHECK_THROWS_AS(solver().closest(none, {points.data(), 1}), InputError);
}

TEST_CASE("the search can be called off between batches, and the solver stays usable") {
  const Mesh mesh = cube(1.0);
  const std::vector<DVec3> points = hostile_points(13, mesh, 30'000);
  std::vector<size_t> seen;
  const auto goes_on = [&](size_t done) {
    seen.push_back(done);
    return seen.size() < 2;
  };
  CHECK_THROWS_AS(solver().closest(mesh, points, goes_on), Interrupted);
  REQUIRE(seen.size() == 2);
  CHECK(seen[0] < seen[1]);
  CHECK(seen[1] < points.size());
  const auto throws = [](size_t) -> bool { throw std::runtime_error("ours"); };
  CHECK_THROWS_WITH(solver().closest(mesh, points, throws), "ours");
  CHECK(solver().closest(mesh, points).lower.size() == points.size());
}
