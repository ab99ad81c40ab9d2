// The bounds of cells in doubles (host/native/cell.h) against exact arithmetic.
#include "host/native/cell.h"
// Its include guards keep the float versions of shaders/math out.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/verification/math/exact_doubles.h"

namespace {

using namespace vkh::native;
using namespace vkh::native::test;

Bary3 halved(Random& random) {
  Bary3 t = whole_root();
  for (uint k = random.below(24); k > 0; --k) {
    const uint opposite = random.below(3);
    if (!has_middle_opposite(t, opposite)) break;
    const Halves h = halves_of(t, opposite, middle_opposite(t, opposite));
    t = random.below(2) == 0 ? h.first : h.second;
  }
  return t;
}

/// A cell of a hard triangle, or of one around the origin, and its exact corners.
struct CellCase {
  CellFrame cell;
  std::array<Point, 3> corner;

  CellCase(const Corners& root, const Bary3& t)
      : cell(make_cell(make_root(two(root.a), two(root.b), two(root.c)), t)) {
    const Point a = point(root.a);
    const auto exactly = [&](const uvec2& at) {
      return a + Rational(at.x * kBaryUnit) * (point(root.b) - a) +
             Rational(at.y * kBaryUnit) * (point(root.c) - a);
    };
    corner = {exactly(t.a), exactly(t.b), exactly(t.c)};
  }

  Point at(const std::array<int, 3>& quarters) const {
    return Rational(quarters[0], 4) * corner[0] + Rational(quarters[1], 4) * corner[1] +
           Rational(quarters[2], 4) * corner[2];
  }
};

CellCase hard_cell(Random& random) {
  const Corners any{hard_vec3(random, -3, 0), hard_vec3(random, -3, 0), hard_vec3(random, -3, 0)};
  return {random.below(2) == 0 ? hard_corners(random) : any, halved(random)};
}

Surface surface(const CellFrame& t, const Corners& s) {
  return make_surface(two(s.a), two(s.b), two(s.c), cell_view(t));
}

Gathered gathered_over(const CellFrame& t, const std::vector<Corners>& b) {
  Gathered g = begin_gathering(t, surface(t, b[0]), 0);
  for (uint i = 0; i < b.size(); ++i) g = gathered(g, t, surface(t, b[i]), i);
  for (size_t i = 1; i < b.size(); ++i) {
    const Surface s = surface(t, b[i - 1]), r = surface(t, b[i]);
    g = cut_between(g, t, s, cell_distances(t, s), r, cell_distances(t, r));
  }
  return g;
}

constexpr std::array<std::array<int, 3>, 7> kPoints = {
    {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {2, 2, 0}, {0, 2, 2}, {1, 1, 2}, {2, 1, 1}}};

Rational affine(const vec3& at, const std::array<int, 3>& quarters) {
  return Rational(quarters[0], 4) * Rational(at.x) + Rational(quarters[1], 4) * Rational(at.y) +
         Rational(quarters[2], 4) * Rational(at.z);
}

bool is_square_of_more(const Rational& bound, const Rational& squared) {
  return bound >= 0 && bound * bound >= squared;
}

TEST_CASE("a cell's corners, and a point between two, are within its slack") {
  Random random(1);
  for (uint64_t i = 0; i < case_count(); ++i) {
    const CellCase c = hard_cell(random);
    const CellFrame& t = c.cell;
    const Point origin = point(t.origin);
    const std::array<vec3, 3> at{t.at.a, t.at.b, t.at.c};
    const Rational most = Rational(t.slack) * Rational(t.slack);
    for (size_t k = 0; k < 3; ++k) {
      REQUIRE(square(origin + point(at[k]) - c.corner[k]) <= most);
      REQUIRE(is_square_of_more(Rational(t.radius), square(point(at[k]))));
      const size_t j = (k + 1) % 3;
      const double part = random.unit();
      const vec3 cut = at[k] + part * (at[j] - at[k]);
      const Point exactly = c.corner[k] + Rational(part) * (c.corner[j] - c.corner[k]);
      REQUIRE(square(origin + point(cut) - exactly) <= most);
    }
  }
}

TEST_CASE("what is gathered over a cell encloses the distance at every point of it") {
  Random random(2);
  uint64_t tight = 0;
  for (uint64_t i = 0; i < case_count() / 8; ++i) {
    const CellCase c = hard_cell(random);
    std::vector<Corners> b;
    for (uint k = random.below(4) + 1; k > 0; --k) b.push_back(hard_corners(random));
    const Gathered g = gathered_over(c.cell, b);
    const vec3 lower = lower_of(g, c.cell);
    Rational farthest = 0;
    for (const std::array<int, 3>& at : kPoints) {
      Rational d2 = squared_distance(c.at(at), b[0]);
      for (const Corners& s : b) d2 = std::min(d2, squared_distance(c.at(at), s));
      const Rational below = affine(lower, at);
      REQUIRE((below <= 0 || below * below <= d2));
      REQUIRE(is_square_of_more(affine(g.upper, at), d2));
      REQUIRE(covers(g.highest, d2));
      if (at[0] == 4 || at[1] == 4 || at[2] == 4) farthest = std::max(farthest, d2);
    }
    REQUIRE(Rational(reached_of(g)) * Rational(reached_of(g)) <= farthest);
    tight += g.highest <= vkh::test::sqrt_near(farthest) * (1 + 0x1p-40) + 0x1p-40 ? 1 : 0;
  }
  CHECK(tight >= case_count() / 16);
}

// Over a plane a distance is an affine function, whose mean and mean square are closed forms.
TEST_CASE("means over a plane are rounded up, of one triangle and of two") {
  Random random(3);
  const double h = 0.28125;
  const std::vector<Corners> plane{{{-8, -8, h}, {8, -8, h}, {-8, 8, h}},
                                   {{8, -8, h}, {8, 8, h}, {-8, 8, h}}};
  for (uint64_t i = 0; i < case_count() / 4; ++i) {
    const bool is_above = random.below(2) == 0;
    const auto beside = [&](vec3 p) {
      p.z = is_above ? max(p.z, h) : min(p.z, h);
      return p;
    };
    const Corners any{hard_vec3(random, -3, 0), hard_vec3(random, -3, 0), hard_vec3(random, -3, 0)};
    const CellCase c({beside(any.a), beside(any.b), beside(any.c)}, halved(random));
    const Gathered g = gathered_over(c.cell, plane);
    std::array<Rational, 3> d;
    for (size_t k = 0; k < 3; ++k) d[k] = abs(Rational(c.corner[k].z - Rational(h)));
    REQUIRE(3 * Rational(g.mean) >= d[0] + d[1] + d[2]);
    REQUIRE(6 * Rational(g.square) >=
            d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + d[0] * d[1] + d[1] * d[2] + d[2] * d[0]);
    const double mean = Rational((d[0] + d[1] + d[2]) / 3).get_d();
    REQUIRE(g.mean <= mean * (1 + 0x1p-20) + 0x1p-42);
  }
}

// Whether bound <= exactly - off |g|.
bool is_less_by(double bound, const Rational& exactly, const Rational& off, const vec3& g) {
  const Rational left = exactly - Rational(bound);
  return left >= 0 && left * left >= off * off * square(point(g));
}

TEST_CASE("a minorant takes its own roundings, and corners off by both slacks") {
  Random random(8);
  for (uint64_t i = 0; i < case_count(); ++i) {
    CellFrame t{};
    t.at = {hard_vec3(random, -3, 0), hard_vec3(random, -3, 0), hard_vec3(random, -3, 0)};
    t.radius = radius_up(t.at);
    Surface s{};
    s.at = hard_corners(random);
    const auto any = [&] { return std::fabs(hard_double(random, -60, -4)); };
    t.slack = random.below(2) == 0 ? 0 : any();
    s.slack = random.below(2) == 0 ? 0 : any();
    const vec3 g = shortened(with_low_bits(random, random.direction()));
    const Minorant m = minorant(t, s, g, minorant_off(t, s));
    Rational farthest = dot(point(g), point(s.at.a));
    for (const vec3& q : {s.at.b, s.at.c}) farthest = std::max(farthest, dot(point(g), point(q)));
    const Rational off = Rational(t.slack) + Rational(s.slack);
    const auto exactly = [&](const vec3& x) -> Rational {
      return dot(point(g), point(x)) - farthest;
    };
    REQUIRE(is_less_by(m.centre, -farthest, off, g));
    REQUIRE(is_less_by(m.at_corners.x, exactly(t.at.a), off, g));
    REQUIRE(is_less_by(m.at_corners.y, exactly(t.at.b), off, g));
    REQUIRE(is_less_by(m.at_corners.z, exactly(t.at.c), off, g));
  }
}

TEST_CASE(
    "a minorant is under what separates at exact corners, and no direction is longer than 1") {
  Random random(4);
  for (uint64_t i = 0; i < case_count() / 2; ++i) {
    const CellCase c = hard_cell(random);
    const Corners b = hard_corners(random);
    const Surface s = surface(c.cell, b);
    const vec3 g = shortened(random.below(2) == 0 ? closest_point(vec3(0, 0, 0), s.at).offset
                                                  : with_low_bits(random, random.direction()));
    REQUIRE(square(point(g)) <= 1);
    const Minorant m = minorant(c.cell, s, g, minorant_off(c.cell, s));
    const auto exactly = [&](const Point& x) {
      Rational least = dot(point(g), x - point(b.a));
      for (const vec3& q : {b.b, b.c}) least = std::min(least, dot(point(g), x - point(q)));
      return least;
    };
    REQUIRE(Rational(m.at_corners.x) <= exactly(c.corner[0]));
    REQUIRE(Rational(m.at_corners.y) <= exactly(c.corner[1]));
    REQUIRE(Rational(m.at_corners.z) <= exactly(c.corner[2]));
    REQUIRE(Rational(m.centre) <= exactly(point(c.cell.origin)));
  }
}

TEST_CASE("an affine function through what is known of a cut is above it") {
  Random random(5);
  for (uint64_t i = 0; i < case_count(); ++i) {
    const auto any = [&] { return std::fabs(hard_double(random, -6, 0)); };
    const vec3 at(any(), any(), any());
    const double to_p = random.unit(), to_q = random.unit(), p = any(), q = any();
    Cut cut;
    cut.none = false;
    cut.alone = 0;
    cut.first = 1;
    cut.second = 2;
    const vec3 above = plane_above(cut, at, to_p, p, to_q, q);
    const auto at_cut = [](double from, double to, double part) -> Rational {
      return (1 - Rational(part)) * Rational(from) + Rational(part) * Rational(to);
    };
    REQUIRE((above.x >= at.x && above.y >= at.y && above.z >= at.z));
    REQUIRE(at_cut(above.x, above.y, to_p) >= Rational(p));
    REQUIRE(at_cut(above.x, above.z, to_q) >= Rational(q));
  }
}

TEST_CASE("floats around a double leave room for 53 bits more") {
  Random random(6);
  for (uint64_t i = 0; i < case_count(); ++i) {
    const double x = hard_double(random, i % 4 == 0 ? -160 : -40, 3);
    const Rational low = abs(Rational(x)) * Rational(0x1p-53);
    REQUIRE(Rational(double{float_below(x)}) < Rational(x) - low);
    REQUIRE(Rational(double{float_above(x)}) > Rational(x) + low);
  }
}

TEST_CASE("a reach is not under what it covers, and a box's distance not above what it is") {
  Random random(7);
  const Rational underflow(0x1p-148);
  for (uint64_t i = 0; i < case_count(); ++i) {
    CellFrame t{};
    const auto any = [&](int lo) { return std::fabs(hard_double(random, lo, 1)); };
    t.radius = any(-60);
    t.slack = random.below(2) == 0 ? any(-60) : t.radius * 0x1p-50;
    Gathered g = nothing_gathered();
    g.highest = any(-60);
    const Rational reach = Rational(g.highest) + Rational(t.radius) + Rational(t.slack);
    REQUIRE(Rational(double{cell_reach(g.highest, t)}) >= reach * reach + underflow);
    const double distance2 = random.below(4) == 0 ? any(-148) : any(-30);
    const Rational d(box_distance_down(t.slack, distance2));
    REQUIRE((d == 0 ||
             (d + Rational(t.slack)) * (d + Rational(t.slack)) + underflow <= Rational(distance2)));
  }
}

}  // namespace
