// The bounds in doubles (host/native) against exact arithmetic: the CPU's own, rounding to nearest.
#include "host/native/separate.h"
// Its include guard keeps the float version of shaders/math out.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "tests/verification/math/exact_doubles.h"

namespace {

using namespace vkh::native;
using namespace vkh::native::test;

uvec2 any_place(Random& random) {
  const uint bits = random.below(kBits + 1);
  const uint j = random.below((1u << bits) + 1);
  const uint k = random.below((1u << bits) - j + 1);
  return {j << (kBits - bits), k << (kBits - bits)};
}
Bary3 any_part(Random& random) { return {any_place(random), any_place(random), any_place(random)}; }

Point position(const Corners& face, const uvec2& at) {
  const Point a = point(face.a);
  return a + Rational(at.x * kUnit) * (point(face.b) - a) +
         Rational(at.y * kUnit) * (point(face.c) - a);
}

// ---- arithmetic
// ----------------------------------------------------------------------------------

TEST_CASE("lengths in doubles are rounded up, from 1 down to where squares underflow") {
  Random random(1);
  for (uint64_t i = 0; i < case_count(); ++i) {
    const bool tiny = i % 4 == 0;
    const vec3 v = tiny ? hard_vec3(random, -560, -500) : hard_vec3(random, -60, 2);
    REQUIRE(covers(norm_up(v), square(point(v))));
    REQUIRE(covers(sharp_norm_above_up({v, vec3(0, 0, 0)}, 0.0), square(point(v))));
  }
}

TEST_CASE("norm_up and sharp_norm_above_up take the roundings of a vector of two doubles") {
  Random random(2);
  for (uint64_t i = 0; i < case_count(); ++i) {
    Two3 v{hard_vec3(random, -4, 1), vec3(0, 0, 0)};
    const auto low = [&random](double hi) { return hi * 0x1p-53 * (2 * random.unit() - 1); };
    v.lo = vec3(low(v.hi.x), low(v.hi.y), low(v.hi.z));
    const double base = random.below(2) == 0 ? 0.0 : norm_up(v.hi) * random.unit();
    const Rational bound = Rational(base) + Rational(sharp_norm_above_up(v, base));
    REQUIRE(bound * bound >= square(point(v)));
  }
}

TEST_CASE("round_up and round_down take n kUlp and their own roundings") {
  Random random(3);
  for (uint64_t i = 0; i < case_count(); ++i) {
    const double x = std::fabs(hard_double(random, -600, 2));
    const double n = random.below(65);
    const Rational error = Rational(n) * Rational(0x1p-52);
    REQUIRE(Rational(round_up(x, n)) * (1 - error) >= Rational(x));
    const double down = round_down(x, n);
    REQUIRE((down == 0 || Rational(down) * (1 + error) <= Rational(x)));
    const double y = std::fabs(hard_double(random, -600, 2));
    REQUIRE(Rational(kept_bound(x, y)) >= Rational(x) + Rational(y));
    REQUIRE(Rational(raised(x)) >= Rational(x) * (1 + Rational(0x1p-52)));
    REQUIRE(Rational(lowered(x)) <= Rational(x) * (1 - Rational(0x1p-52)));
  }
}

TEST_CASE("a quotient of a rounded difference is rounded down") {
  Random random(4);
  for (uint64_t i = 0; i < case_count(); ++i) {
    const double x = std::fabs(hard_double(random, -40, 2)), y = x * random.unit();
    const double b = std::fabs(hard_double(random, -40, 2));
    const double q = quotient_down(x - y, b);
    REQUIRE(Rational(q) * Rational(b) <= Rational(x) - Rational(y));
  }
}

TEST_CASE("sums and products of two doubles are exact, their combinations within kUlp2") {
  Random random(5);
  for (uint64_t i = 0; i < case_count(); ++i) {
    const double a = hard_double(random, -60, 2), b = hard_double(random, -60, 2);
    const Two sum = two_sum(a, b), product = two_product(a, b);
    REQUIRE(Rational(sum.hi) + Rational(sum.lo) == Rational(a) + Rational(b));
    REQUIRE(Rational(product.hi) + Rational(product.lo) == Rational(a) * Rational(b));
    const auto number = [&random](int lo, int hi) {
      Two3 v{hard_vec3(random, lo, hi), vec3(0, 0, 0)};
      if (random.below(2) == 0) return v;
      const auto low = [&random](double h) { return h * 0x1p-53 * (2 * random.unit() - 1); };
      v.lo = vec3(low(v.hi.x), low(v.hi.y), low(v.hi.z));
      return v;
    };
    const Two3 base = number(-3, 1), u = number(-3, 1), v = number(-3, 1);
    const double x = random.unit(), y = random.unit();
    // Squares of sums of lengths are bounded by three times those of the lengths.
    const Rational whole = square(point(base)) + Rational(x) * Rational(x) * square(point(u)) +
                           Rational(y) * Rational(y) * square(point(v));
    const Point off = point(base) + Rational(x) * point(u) + Rational(y) * point(v) -
                      point(two_combination(base, x, u, y, v));
    REQUIRE(square(off) <= 16 * Rational(kUlp2) * Rational(kUlp2) * whole);
    const Point off_difference = point(base) - point(u) - point(two_difference(base, u));
    REQUIRE(square(off_difference) <=
            Rational(kUlp2) * Rational(kUlp2) * (square(point(base)) + square(point(u))));
  }
}

// ---- places
// --------------------------------------------------------------------------------------

TEST_CASE("corners and cuts around a face's corner are within the face's slack") {
  Random random(6);
  for (uint64_t i = 0; i < case_count(); ++i) {
    const Corners t = i % 2 == 0 ? hard_corners(random)
                                 : Corners{hard_vec3(random, -3, 0), hard_vec3(random, -3, 0),
                                           hard_vec3(random, -3, 0)};
    const Face face = make_face(t.a, t.b, t.c);
    const Rational most = Rational(face.slack) * Rational(face.slack);
    const Bary3 part = any_part(random);
    const Point a = point(t.a);
    for (const uvec2& at : {part.a, part.b, part.c}) {
      const Point off = a + point(local_corner(face, at)) - position(t, at);
      REQUIRE(square(off) <= most);
    }
    const Corners local = local_corners(face, part);
    const Patch patch = make_patch(two(local.a), two(local.b), two(local.c));
    const vec3 side(random.unit() - 0.5, random.unit(), -random.unit());
    const Cut cut = cut_by(side);
    const double from = abs(pick3(side, cut.alone)), to = abs(pick3(side, cut.first));
    const Rational weight = Rational(min(from / (from + to), 1.0));
    const Point alone = position(t, corner_of(part, cut.alone));
    const Point exactly = alone + weight * (position(t, corner_of(part, cut.first)) - alone);
    REQUIRE(square(a + point(cut_point(patch, cut, 0, side)) - exactly) <= most);
  }
}

TEST_CASE("a sample's position is exact to kPositionError") {
  Random random(7);
  for (uint64_t i = 0; i < case_count(); ++i) {
    const Corners t = i % 2 == 0 ? hard_corners(random)
                                 : Corners{hard_vec3(random, -1, 0), hard_vec3(random, -1, 0),
                                           hard_vec3(random, -1, 0)};
    const uvec2 at = any_place(random);
    const Point off = point(exact_position(t, at)) - position(t, at);
    REQUIRE(square(off) <= Rational(kPositionError) * Rational(kPositionError));
  }
}

// ---- distances
// -----------------------------------------------------------------------------------

// A place from which surfaces are measured, and a point around it, next to the triangle or not.
struct Measured {
  vec3 origin, local;
};
Measured hard_measured(Random& random, const Corners& t) {
  StoredTriangle near;
  near.corner = {vkh::test::stored({t.a.x, t.a.y, t.a.z}), vkh::test::stored({t.b.x, t.b.y, t.b.z}),
                 vkh::test::stored({t.c.x, t.c.y, t.c.z})};
  const vec3 p = with_low_bits(random, vkh::test::hard_point(random, near));
  const uint32_t kind = random.below(3);
  vec3 origin = with_low_bits(random, random.in_cube(1.0));
  if (kind == 0) origin = p;
  if (kind == 1) origin = p + 0x1p-20 * origin;
  return {origin, p - origin};
}

TEST_CASE("the distance of a point from a surface is rounded up") {
  Random random(8);
  uint64_t tight = 0;
  for (uint64_t i = 0; i < case_count(); ++i) {
    const Corners t = hard_corners(random);
    const Measured m = hard_measured(random, t);
    const Surface s = make_surface(two(t.a), two(t.b), two(t.c), view_around(two(m.origin)));
    REQUIRE(s.coarse);
    const Rational squared = squared_distance(point(m.origin) + point(m.local), t);
    const double d = surface_distance_up(two(m.local), s);
    REQUIRE(covers(d, squared));
    tight += d <= vkh::test::sqrt_near(squared) + 0x1p-44 ? 1 : 0;
  }
  CHECK(tight >= case_count() - case_count() / 100);
}

TEST_CASE("the distance of a sample from a surface is rounded down") {
  Random random(9);
  uint64_t tight = 0;
  for (uint64_t i = 0; i < case_count(); ++i) {
    const Corners t = hard_corners(random);
    const Corners face = hard_corners(random);
    const Measured m = hard_measured(random, t);
    // Half of the samples lie next to the triangle, exactly; half have a low part.
    const uvec2 at = any_place(random);
    const Two3 p = i % 2 == 0 ? two(m.origin) : exact_position(face, at);
    const Surface s = make_surface(two(t.a), two(t.b), two(t.c), view_around(p));
    const Rational squared = squared_distance(point(p), t);
    const double d = distance_from_origin_down(s, 1e30);
    REQUIRE((d == 0 || Rational(d) * Rational(d) <= squared));
    tight += d >= vkh::test::sqrt_near(squared) - 0x1p-40 ? 1 : 0;
  }
  CHECK(tight >= case_count() - case_count() / 100);
}

// Whether bound >= d + sqrt(squared).
bool covers_sum(double bound, double d, const Rational& squared) {
  const Rational left = Rational(bound) - Rational(d);
  return left >= 0 && left * left >= squared;
}

Rational squared_enclosing_radius(const Point& ab, const Point& ac) {
  const Rational c2 = square(ab), b2 = square(ac), a2 = square(ac - ab);
  const Rational longest = std::max(a2, std::max(b2, c2));
  if (2 * longest >= a2 + b2 + c2) return longest / 4;
  const Rational along = dot(ab, ac);
  return a2 * b2 * c2 / (4 * (b2 * c2 - along * along));
}

TEST_CASE("u1 and u2 are rounded up for the part and the distances as given") {
  Random random(11);
  for (uint64_t i = 0; i < case_count(); ++i) {
    const Corners t = hard_corners(random);
    const Patch patch = make_patch(two(t.a), two(t.b), two(t.c));
    const double size = std::ldexp(1.0, -static_cast<int>(random.below(30)));
    const vec3 d(size * random.unit(), size * random.unit(), size * random.unit());
    const Point a = point(t.a), b = point(t.b), c = point(t.c);
    const Rational ab = square(b - a), bc = square(c - b), ca = square(a - c);
    const double u1 = bound_u1(patch, d);
    REQUIRE((covers_sum(u1, d.x, std::max(ab, ca)) || covers_sum(u1, d.y, std::max(ab, bc)) ||
             covers_sum(u1, d.z, std::max(bc, ca))));
    const Rational radius2 = squared_enclosing_radius(b - a, c - a);
    REQUIRE(covers(enclosing_radius_up(t), radius2));
    REQUIRE(covers_sum(bound_u2(patch, d), max3(d), radius2));
  }
}

TEST_CASE("a separating plane's distance is rounded down, for corners off by the slack") {
  Random random(12);
  for (uint64_t i = 0; i < case_count(); ++i) {
    Surface s;
    s.at = hard_corners(random);
    s.base = 0;
    s.slack = random.below(2) == 0 ? 0.0 : std::ldexp(1.0, -static_cast<int>(random.below(60)));
    const uint32_t kind = random.below(3);
    vec3 r = with_low_bits(random, random.direction());
    if (kind == 0) r = -s.at.a;
    if (kind == 1) r = closest_point(vec3(0, 0, 0), s.at).offset;
    const double down = coarse_distance_down(s, r);
    if (!(down > 0)) continue;
    const Rational claim =
        (Rational(down) + Rational(s.slack)) * (Rational(down) + Rational(s.slack));
    for (const vec3& corner : {s.at.a, s.at.b, s.at.c}) {
      const Rational along = dot(point(-corner), point(r));
      REQUIRE(along >= 0);
      REQUIRE(claim * square(point(r)) <= along * along);
    }
  }
}

TEST_CASE("the bounds over a part hold at its exact points") {
  Random random(10);
  for (uint64_t i = 0; i < case_count() / 4; ++i) {
    const Corners whole = hard_corners(random);
    const Face face = make_face(whole.a, whole.b, whole.c);
    const Bary3 part = any_part(random);
    const Corners local = local_corners(face, part);
    const Patch patch = make_patch(two(local.a), two(local.b), two(local.c));
    const auto surface = [&](const Corners& t) {
      return make_surface(two(t.a), two(t.b), two(t.c), view_around(two(whole.a)));
    };
    const Corners t = hard_corners(random), r = hard_corners(random);
    const Surface s = surface(t), o = surface(r);
    const auto distances = [&](const Surface& from) {
      return vec3(surface_distance_up(patch.a, from), surface_distance_up(patch.b, from),
                  surface_distance_up(patch.c, from));
    };
    const vec3 ds = distances(s), dr = distances(o);
    const double single = kept_bound(bound_single(ds), face.slack);
    const double u1 = kept_bound(bound_u1(patch, min(ds, dr)), face.slack);
    const double u2 = kept_bound(bound_u2(patch, min(ds, dr)), face.slack);
    double pair = kept_bound(min(bound_single(ds), bound_single(dr)), face.slack);
    const Cut cut = cut_by(ds - dr);
    if (!cut.none) {
      const double at_cut = bound_cut(patch, cut, ds - dr, s, o);
      pair = kept_bound(max(bound_nearer(ds, dr), at_cut), face.slack);
    }
    const std::array<Point, 3> corner{position(whole, part.a), position(whole, part.b),
                                      position(whole, part.c)};
    for (int k = 0; k < 4; ++k) {
      const glm::dvec3 w = k == 0 ? glm::dvec3(1, 0, 0) : vkh::test::barycentrics(random);
      const Rational v(w.y), u(w.z);
      const Point p = corner[0] + v * (corner[1] - corner[0]) + u * (corner[2] - corner[0]);
      const Rational from_s = squared_distance(p, t), from_r = squared_distance(p, r);
      const Rational nearer = from_s < from_r ? from_s : from_r;
      REQUIRE(covers(single, from_s));
      REQUIRE(covers(u1, nearer));
      REQUIRE(covers(u2, nearer));
      REQUIRE(covers(pair, nearer));
    }
  }
}

}  // namespace
