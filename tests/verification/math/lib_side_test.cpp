// shaders/report/side.h against exact rationals: signs of heights, crossings of rays and triangles
// that are left out hold wherever points may be that floats stand for. Spoiled terms must be
// noticed.
#include <doctest/doctest.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "shaders/report/side.h"
#include "tests/shapes/shapes.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using glm::dvec3;
using lib::vec3;

using Exact = std::array<mpq_class, 3>;

Exact exact(const dvec3& p) { return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)}; }
Exact operator-(const Exact& p, const Exact& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }

int sign_of_height(const dvec3& p, const std::array<dvec3, 3>& t) {
  const Exact a = exact(t[0]), e = exact(t[1]) - a, f = exact(t[2]) - a, x = exact(p) - a;
  const mpq_class height = (e[1] * f[2] - e[2] * f[1]) * x[0] + (e[2] * f[0] - e[0] * f[2]) * x[1] +
                           (e[0] * f[1] - e[1] * f[0]) * x[2];
  return sgn(height);
}

/// A float point that is `off` from a point at most, along a direction: to its end as a rule.
vec3 moved(const dvec3& p, const dvec3& along, double off) {
  const dvec3 to = p + along * (0.999 * off);
  return {static_cast<float>(to.x), static_cast<float>(to.y), static_cast<float>(to.z)};
}

double distance(const vec3& p, const dvec3& q) { return glm::length(dvec3(p.x, p.y, p.z) - q); }

/// A triangle, often thin or far from round, about the origin.
std::array<dvec3, 3> any_triangle(Random& random) {
  const double size = std::exp2(random.range(-8, 1)), thin = std::exp2(random.range(-12, 0));
  const dvec3 at = random.in_cube(1), along = random.direction();
  const dvec3 across = glm::normalize(glm::cross(along, random.direction()));
  return {at, at + along * size,
          at + along * (size * random.range(-0.5, 1.5)) + across * (size * thin)};
}

constexpr int kCases = 60'000;

// Points next to the plane are moved over it, and the triangle's corners the other way: one of them
// more than the others, which turns the plane.
TEST_CASE("side_of_plane: a sign holds wherever the points may be") {
  Random random(1);
  int told = 0, wrong = 0;
  for (int i = 0; i < kCases; ++i) {
    std::array<dvec3, 3> t = any_triangle(random);
    const dvec3 n = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    const double away = std::exp2(random.range(-10, 1));
    const dvec3 beside =
        t[0] + (t[1] - t[0]) * random.range(-2, 2) + (t[2] - t[0]) * random.range(-2, 2);
    const double off = random.below(4) == 0 ? 0 : std::exp2(random.range(-24, -10));
    const double to = random.below(2) == 0 ? 1 : -1;
    const double height =
        random.below(3) == 0 ? away : std::exp2(random.range(-34, -8)) * (0.1 + off / 0x1p-17);
    dvec3 p = beside - n * (to * height);
    if (off == 0) {  // what is left is rounding
      p = dvec3(glm::vec3(p));
      for (dvec3& corner : t) corner = dvec3(glm::vec3(corner));
    }
    const uint32_t turned = random.below(3);
    const vec3 at = moved(p, n * to, off);
    std::array<vec3, 3> corners;
    double worst = distance(at, p);
    for (uint32_t k = 0; k < 3; ++k) {
      const dvec3 along = turned == 0 ? -n * to : random.below(2) == 0 ? -n * to : n * to;
      corners[k] = moved(t[k], along, off);
      worst = std::max(worst, distance(corners[k], t[k]));
    }
    const float allowed = off == 0 ? 0 : std::nextafter(static_cast<float>(worst), 1.0f);
    const int side = lib::side_of_plane(at, {corners[0], corners[1], corners[2]}, allowed);
    told += side != 0 ? 1 : 0;
    wrong += side != 0 && side != sign_of_height(p, t) ? 1 : 0;
  }
  CHECK(wrong == 0);
  CHECK(told > kCases / 5);
}

struct ExactCrossing {
  int winding;
  bool is_clean;  // no edge is met, and the origin is not on the plane
};

mpq_class turn(const Exact& p, const Exact& q) { return p[1] * q[2] - p[2] * q[1]; }

ExactCrossing exact_crossing(const std::array<dvec3, 3>& t) {
  const Exact a = exact(t[0]), b = exact(t[1]), c = exact(t[2]);
  const mpq_class ab = turn(a, b), bc = turn(b, c), ca = turn(c, a);
  const int x = sgn(ab), y = sgn(bc), z = sgn(ca);
  if (std::min({x, y, z}) < 0 && std::max({x, y, z}) > 0) return {0, true};
  if (x == 0 || y == 0 || z == 0) return {0, false};
  const int along = sgn(mpq_class(a[0] * bc + b[0] * ca + c[0] * ab));
  return {along == x ? x : 0, along != 0};
}

// A coordinate is off by 3 kUlp of itself, and by `off`.
vec3 seen(const dvec3& p, Random& random, double off) {
  const auto one = [&](double x) {
    const double share = random.below(2) == 0 ? 1 : random.range(-1, 1);
    const double by = (random.below(2) == 0 ? 1 : -1) * share;
    return static_cast<float>(x + by * (0.99 * off + 2.4 * 0x1p-23 * std::abs(x)));
  };
  return {one(p.x), one(p.y), one(p.z)};
}

TEST_CASE("crossing_of: what a triangle adds is sure wherever its corners may be") {
  Random random(2);
  int told = 0, crossed = 0, wrong = 0;
  for (int i = 0; i < 4 * kCases; ++i) {
    std::array<dvec3, 3> t = any_triangle(random);
    const double x = random.range(-0.2, 1.2), y = random.range(-0.2, 1.2 - x);
    dvec3 on = t[0] + (t[1] - t[0]) * x + (t[2] - t[0]) * y;  // the ray meets the plane about there
    if (random.below(2) == 0) on = t[0] + (t[1] - t[0]) * x;  // or next to an edge
    const double off = random.below(3) == 0 ? 0 : std::exp2(random.range(-26, -12));
    const double away = random.below(2) == 0 ? random.range(-1, 1) : 2 * off * random.range(-1, 1);
    const dvec3 origin = on - dvec3(away, 0, 0) + random.in_cube(1.5 * off);
    for (dvec3& p : t) p = p - origin;
    const auto allowed = std::nextafter(static_cast<float>(off), 1.0f);
    const lib::Crossing found = lib::crossing_of(seen(t[0], random, off), seen(t[1], random, off),
                                                 seen(t[2], random, off), allowed);
    if (!found.is_sure) continue;
    const ExactCrossing right = exact_crossing(t);
    ++told;
    crossed += found.winding != 0 ? 1 : 0;
    wrong += !right.is_clean || right.winding != found.winding ? 1 : 0;
  }
  CHECK(wrong == 0);
  CHECK(told > kCases);
  CHECK(crossed > kCases / 10);
}

/// A cell of a face of A about the origin, as make_cell sees it.
lib::CellFrame any_cell(Random& random) {
  lib::CellFrame t{};
  const float size = static_cast<float>(std::exp2(random.range(-6, 0)));
  const auto corner = [&] {
    const dvec3 p = random.in_cube(1);
    return size * vec3(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
  };
  t.at = {corner(), corner(), corner()};
  t.radius = lib::radius_up(t.at);
  t.reach = 2;
  t.slack = lib::round_up(7.0f * lib::kUlp * t.radius + 16.0f * lib::kUlp2 * t.reach, 4.0f);
  return t;
}

// A triangle that is left out is farther at all corners than B is anywhere on T, by `moved` twice.
TEST_CASE("may_be_closest: no triangle is left out that moves as near as B") {
  Random random(3);
  int left_out = 0, wrong = 0;
  for (int i = 0; i < kCases; ++i) {
    const lib::CellFrame t = any_cell(random);
    const dvec3 to = random.direction() * std::exp2(random.range(-3, 2));
    lib::Surface s{};
    for (vec3* corner : {&s.at.a, &s.at.b, &s.at.c}) {
      const dvec3 p = to + random.in_cube(0.5);
      *corner = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    }
    s.slack = lib::coarse_slack(s.at, 2);
    const std::array<vec3, 3> corners{t.at.a, t.at.b, t.at.c};
    double least = 1e9;
    for (const vec3& p : corners)
      least = std::min(least, std::sqrt(static_cast<double>(lib::plain_distance2(p, s.at))));
    const float moved =
        random.below(2) == 0 ? 0 : static_cast<float>(std::exp2(random.range(-20, -4)));
    const auto highest = static_cast<float>(least * (1 - std::exp2(random.range(-22, -1))));
    const vec3 upper(highest, highest, highest);
    if (lib::may_be_closest(t, s, {upper, highest}, moved)) continue;
    ++left_out;
    wrong += least - 2 * static_cast<double>(moved) <= static_cast<double>(highest) ? 1 : 0;
  }
  CHECK(wrong == 0);
  CHECK(left_out > kCases / 20);
}

TEST_CASE("a cell is off B where its vertices cannot move it there, and classes follow planes") {
  CHECK(lib::is_off(1e-3f, 0.99e-3f));
  CHECK_FALSE(lib::is_off(1e-3f, 1e-3f));
  CHECK_FALSE(lib::is_off(0, 0));
  CHECK(lib::class_with(gpu::kClassUnseen, 0, 1) == gpu::kClassOver);
  CHECK(lib::class_with(gpu::kClassOver, 0, 1) == gpu::kClassOver);
  CHECK(lib::class_with(gpu::kClassOver, 0, -1) == gpu::kClassEdge);
  CHECK(lib::class_with(gpu::kClassUnder, 0, 0) == gpu::kClassEdge);
  CHECK(lib::class_with(gpu::kClassOver, gpu::kFaceTwoSided, -1) == gpu::kClassTwoSided);
  CHECK(lib::class_with(gpu::kClassOver, gpu::kFaceBare, 1) == gpu::kClassDegenerate);
}

// The most that one affine function reaches where another is not over t, exactly.
mpq_class exact_most(const vec3& one, const vec3& other, float t) {
  const std::array<mpq_class, 3> x{one.x, one.y, one.z}, y{other.x, other.y, other.z};
  mpq_class most = 0;
  for (size_t i = 0; i < 3; ++i) {
    if (x[i] > mpq_class(t)) continue;
    most = std::max(most, y[i]);
    for (size_t j = 0; j < 3; ++j) {
      if (x[j] <= mpq_class(t)) continue;
      const mpq_class end = y[i] + (mpq_class(t) - x[i]) / (x[j] - x[i]) * (y[j] - y[i]);
      most = std::max(most, end);
    }
  }
  return most;
}

TEST_CASE("most_within: an affine function is nowhere more where another is not over t") {
  Random random(11);
  const auto any = [&](double low) {
    return static_cast<float>(std::exp2(random.range(-20, 2)) * random.range(low, 1));
  };
  int cut = 0, nowhere = 0;
  for (int i = 0; i < 200'000; ++i) {
    const vec3 one(any(-1), any(-1), any(-1)), other(any(0), any(0), any(0));
    const float t = i % 2 == 0 ? 0 : any(-1), found = lib::most_within(one, other, t);
    const mpq_class most = exact_most(one, other, t);
    REQUIRE(mpq_class(found) >= most);
    CHECK(mpq_class(found) <= most * mpq_class(1.00001) + mpq_class(1e-37));
    nowhere += most == 0 ? 1 : 0;
    cut += std::max({one.x, one.y, one.z}) > t ? 1 : 0;
  }
  CHECK(nowhere > 1000);
  CHECK(cut - nowhere > 1000);
}

TEST_CASE("a cell that touches B is off it but near, and the ray starts where it is off") {
  const vec3 lower(-1e-9f, 0.5f, 0.25f), upper(1e-9f, 0.5f, 0.25f);
  CHECK(lib::is_off_but_near(lower, upper, 0, 1e-6f));
  CHECK_FALSE(lib::is_off_but_near(lower, upper, 0, 0));
  CHECK_FALSE(lib::is_off_but_near(lower, upper, 1e-6f, 1e-6f));
  CHECK(lib::is_off_but_near(lower, upper, 1e-6f, 1e-5f));
  CHECK_FALSE(lib::is_off_but_near(lower, {0.1f, 0.5f, 0.25f}, 0, 0.1f));
  CHECK_FALSE(lib::is_off_but_near({0.5f, 0.5f, 0.5f}, upper, 0, 0));
  for (uint32_t turn = 0; turn < 3; ++turn) {
    const vec3 w = lib::inner_weights(turn);
    CHECK(w.x + w.y + w.z == doctest::Approx(1).epsilon(1e-6));
    CHECK(std::max({w.x, w.y, w.z}) == (turn == 0 ? w.x : turn == 1 ? w.y : w.z));
    CHECK(lib::is_off_inside(lower, turn, 0));
    CHECK_FALSE(lib::is_off_inside(lower, turn, 0.5f));
    lib::CellFrame t{};
    t.at = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    CHECK(lib::inner_point(t, turn) == w);
  }
  CHECK(lib::is_off_inside({-1, 1, -1}, 1, 0));
  CHECK_FALSE(lib::is_off_inside({-1, 1, -1}, 0, 0));
}

// `near` is next to the most that is not off B: both what lies between 0 and `moved`, and that B
// may be nearer by it, have to count.
TEST_CASE("is_off_but_near: what is not off B is nearer, wherever the vertices are") {
  Random random(12);
  const auto any = [&](double low) {
    return static_cast<float>(std::exp2(random.range(-6, 2)) * random.range(low, 1));
  };
  int told = 0;
  for (int i = 0; i < 100'000; ++i) {
    const vec3 lower(any(-1), any(-1), any(-1)), more(any(0), any(0), any(0));
    const vec3 upper = max(lower, vec3(0, 0, 0)) + more;
    const float off = i % 2 == 0 ? 0 : std::abs(any(-1));
    const mpq_class most = exact_most(lower, upper, off) + mpq_class(off);
    const auto near = static_cast<float>(most.get_d() * random.range(0.9, 1.1));
    if (!lib::is_off_but_near(lower, upper, off, near)) continue;
    ++told;
    REQUIRE(most < mpq_class(near));
  }
  CHECK(told > 30'000);
}

// Values whose mean is a few roundings from `moved`.
TEST_CASE("is_off_inside: the affine function is over what the vertices move") {
  Random random(13);
  int told = 0;
  for (int i = 0; i < 100'000; ++i) {
    const auto turn = static_cast<uint32_t>(random.below(3));
    const vec3 w = lib::inner_weights(turn);
    const auto any = [&] { return static_cast<float>(random.range(-1, 1)); };
    const float off = i % 2 == 0 ? 0 : static_cast<float>(std::exp2(random.range(-20, 0)));
    vec3 lower(any(), any(), 0);
    const double mean = static_cast<double>(off) + random.range(-24, 24) * lib::kUlp;
    lower.z = static_cast<float>((mean - w.x * lower.x - w.y * lower.y) / w.z);
    if (!lib::is_off_inside(lower, turn, off)) continue;
    ++told;
    REQUIRE(mpq_class(w.x) * lower.x + mpq_class(w.y) * lower.y + mpq_class(w.z) * lower.z > off);
  }
  CHECK(told > 5'000);
}

}  // namespace
