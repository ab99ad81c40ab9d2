// The distance that a certificate's writer uses is not less than the exact one, and hardly more.
#include "host/survey/leaf.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/shapes/adversarial.h"
#include "tests/verification/oracle/exact.h"

namespace {

using namespace vkh;
using namespace vkh::test;

constexpr unsigned kScale = 400;  // of exact positions, as integers: 2^-kScale

/// A point, and its exact position.
struct Tracked {
  Point2 point;
  exact::Vector exact;
};

Integer scaled(double x) {
  Rational r(x);
  r <<= kScale;
  return r.get_num() / r.get_den();
}

exact::Vector scaled(const glm::dvec3& p) { return {scaled(p.x), scaled(p.y), scaled(p.z)}; }

Tracked tracked(const glm::dvec3& p) { return {{p, {}}, scaled(p)}; }

Tracked between(const Tracked& x, const Tracked& y, unsigned t) {
  const auto mixed = [t](const Integer& p, const Integer& q) {
    return Integer((p * (65536 - t) + q * t) / 65536);
  };
  return {between(x.point, y.point, t / 65536.0),
          {mixed(x.exact.x, y.exact.x), mixed(x.exact.y, y.exact.y), mixed(x.exact.z, y.exact.z)}};
}

/// The exact distance, as a squared length.
exact::Fraction distance(const Tracked& p, const std::array<glm::dvec3, 3>& t) {
  return exact::to_triangle(p.exact, scaled(t[0]), scaled(t[1]), scaled(t[2]));
}

bool is_at_least(double bound, const exact::Fraction& squared) {
  const Integer b = scaled(bound);
  return b * b * squared.denominator >= squared.numerator;
}

/// Returns whether it is hardly more than the exact one. Beside a needle it may not be: the foot is
/// then off along the triangle.
bool check(const Tracked& p, const std::array<glm::dvec3, 3>& t, double scale) {
  const double up = distance_up(p.point, t);
  const exact::Fraction exact = distance(p, t);
  CAPTURE(up);
  CHECK(is_at_least(up, exact));
  const auto is_within = [&](double off) { return up <= off || !is_at_least(up - off, exact); };
  CHECK(is_within(1e-9 * scale));
  return is_within(64 * 0x1p-52 * scale);
}

TEST_CASE("distances from above, of hard triangles and points that halvings lead to") {
  Random random(5);
  size_t all = 0, wide = 0;
  const auto count = [&](bool is_narrow) { ++all, wide += is_narrow ? 0 : 1; };
  for (int i = 0; i < 3000; ++i) {
    const StoredTriangle t = hard_triangle(random), face = hard_triangle(random);
    const std::array<glm::dvec3, 3> corners = {t.at(0), t.at(1), t.at(2)};
    count(check(tracked(hard_point(random, t)), corners, 8));
    std::array<Tracked, 3> part = {tracked(face.at(0)), tracked(face.at(1)), tracked(face.at(2))};
    for (int halvings = 0; halvings < 60; ++halvings) {
      const auto gone = static_cast<size_t>(3 * random.unit());
      part[gone] = between(part[gone], part[(gone + 1) % 3], 128);
    }
    count(check(part[0], corners, 8));
    const auto share = static_cast<unsigned>(1 + 255 * random.unit());
    count(check(between(part[0], part[1], share), corners, 8));
  }
  MESSAGE(wide << " of " << all << " are wide");
  CHECK(wide * 500 <= all);
}

// What is exact, the offset, costs nothing; its length is rounded a few times, by less than is
// taken.
TEST_CASE("a distance from above is off by roundings of the length alone") {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    const std::array<glm::dvec3, 3> t = {random.in_cube(1), random.in_cube(1), random.in_cube(1)};
    const Tracked p = between(tracked(random.in_cube(2)), tracked(random.in_cube(2)), 12345);
    const double up = distance_up(p.point, t);
    const exact::Fraction exact = distance(p, t);
    CHECK(is_at_least(up, exact));
    if (glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) > 0.1 && up > 0.1)
      CHECK_FALSE(is_at_least(up * (1 - 8 * 0x1p-52), exact));
  }
}

// Near a corner that is the point's high part the distance is its low part, and as far off as that.
TEST_CASE("a distance from above covers what a hundred halvings leave out of low parts") {
  Random random(8);
  for (int i = 0; i < 2000; ++i) {
    std::array<Tracked, 3> part = {tracked(random.in_cube(1)), tracked(random.in_cube(1)),
                                   tracked(random.in_cube(1))};
    for (size_t halving = 0; halving < 100; ++halving) {
      const size_t gone = halving % 3;
      part[gone] = between(part[gone], part[(gone + 1) % 3], halving % 2 == 0 ? 1u : 65535u);
    }
    const Point2& p = part[0].point;
    const glm::dvec3 away = glm::length(p.lo) > 0 ? -glm::normalize(p.lo) : glm::dvec3(1, 0, 0);
    const glm::dvec3 across = 0.25 * random.direction();
    const std::array<glm::dvec3, 3> t = {p.hi, p.hi + away + across, p.hi + away - across};
    CHECK(is_at_least(distance_up(p, t), distance(part[0], t)));
  }
}

TEST_CASE("a corner of a face is 0 away from it") {
  Random random(6);
  for (size_t i = 0; i < 1000; ++i) {
    const StoredTriangle t = hard_triangle(random);
    const std::array<glm::dvec3, 3> corners = {t.at(0), t.at(1), t.at(2)};
    CHECK(distance_up({corners[i % 3], {}}, corners) == 0);
  }
}

Mesh of_triangles(const std::vector<glm::dvec3>& corners) {
  std::vector<glm::uvec3> faces;
  for (uint32_t i = 0; i < corners.size(); i += 3) faces.emplace_back(i, i + 1, i + 2);
  return make_mesh("test", corners, faces);
}

TEST_CASE("the nearest faces of all, the nearest first") {
  std::vector<glm::dvec3> corners;
  for (const double x : {7.0, 3.0, 9.0, 1.0, 5.0, 11.0, 2.0, 8.0, 4.0, 10.0, 6.0})
    corners.insert(corners.end(), {{x, -1, 0}, {x, 1, 0}, {x, 0, 1}});
  const Part part = ScaledMesh(of_triangles({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}), 0).part(0);
  const Hints found = nearest_faces(part, ScaledMesh(of_triangles(corners), 0));
  REQUIRE(found.count == kMostHints);
  for (size_t i = 0; i < found.count; ++i)
    CHECK(corners[3 * size_t{found.face[i]}].x == static_cast<double>(i + 1));
}

TEST_CASE("a roof needs both of its sides, and the cut is between them") {
  const Mesh roof =
      of_triangles({{0, -4, 0}, {0, 4, 0}, {-8, 0, 0}, {0, -4, 0}, {0, 4, 0}, {8, 0, 1}});
  const ScaledMesh b(roof, 0);
  const Mesh flat = of_triangles({{-1, 0, 0.5}, {1, 0.5, 0.5}, {1, -0.5, 0.5}});
  const Part part = ScaledMesh(flat, 0).part(0);
  Hints hints;
  hints.add(0);
  hints.add(1);
  const std::optional<Leaf> leaf = proof_of(part, b, hints, 0.52);
  REQUIRE(leaf);
  CHECK(leaf->alone == 0);
  CHECK(leaf->first == 0);
  CHECK(leaf->second == 1);
  CHECK(leaf->cut_next > 64 * 256);
  CHECK(leaf->cut_next < 255 * 256);
  CHECK_FALSE(proof_of(part, b, hints, 0.45));
  const std::optional<Leaf> whole = proof_of(part, b, hints, 2);
  REQUIRE(whole);
  CHECK(whole->alone == Leaf::kUncut);
}

TEST_CASE("hints are few, and each is there once") {
  Hints hints;
  for (uint32_t i = 0; i < 40; ++i) hints.add(i / 2);
  CHECK(hints.count == kMostHints);
  for (uint32_t i = 0; i < kMostHints; ++i) CHECK(hints.face[i] == i);
}

}  // namespace
