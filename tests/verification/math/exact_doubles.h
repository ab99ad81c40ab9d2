// Points and triangles of doubles with any low bits, and their exact distances. Include after the
// headers of host/native, whose include guards keep the float versions of shaders/math out.
#pragma once

#include <array>
#include <cmath>
#include <cstdlib>

#include "tests/shapes/adversarial.h"
#include "tests/verification/oracle/exact.h"

namespace vkh::native::test {

using vkh::test::Integer;
using vkh::test::Random;
using vkh::test::Rational;
using vkh::test::StoredTriangle;
namespace exact = vkh::test::exact;

inline uint64_t case_count() {
  const char* given = std::getenv("VKH_CASES");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 20'000;
}

// A double next to x with any low bits, or x itself: adversarial shapes have 48.
inline double with_low_bits(Random& random, double x) {
  return random.below(4) == 0 ? x : x * (1 + (random.unit() - 0.5) * 0x1p-44);
}
inline vec3 with_low_bits(Random& random, const glm::dvec3& p) {
  return {with_low_bits(random, p.x), with_low_bits(random, p.y), with_low_bits(random, p.z)};
}
inline Corners hard_corners(Random& random) {
  const StoredTriangle t = vkh::test::hard_triangle(random);
  return {with_low_bits(random, t.at(0)), with_low_bits(random, t.at(1)),
          with_low_bits(random, t.at(2))};
}
// All ones, a power of two, or any mantissa; of an exponent in [lo, hi).
inline double hard_double(Random& random, int lo, int hi) {
  const int exponent = lo + static_cast<int>(random.below(static_cast<uint32_t>(hi - lo)));
  const uint32_t kind = random.below(4);
  double mantissa = 1 + random.unit();
  if (kind == 0) mantissa = 2 - 0x1p-52;
  if (kind == 1) mantissa = 1 + random.below(4) * 0x1p-52;
  return std::ldexp(random.below(2) == 0 ? mantissa : -mantissa, exponent);
}
inline vec3 hard_vec3(Random& random, int lo, int hi) {
  const int from = hi - lo > 4 && random.below(2) == 0 ? hi - 4 : lo;  // of one size, or of many
  return {hard_double(random, from, hi), hard_double(random, from, hi),
          hard_double(random, from, hi)};
}

// Rational points, since doubles of any exponents meet.
struct Point {
  Rational x, y, z;
};
inline Point point(const vec3& v) { return {Rational(v.x), Rational(v.y), Rational(v.z)}; }
inline Point point(const Two3& v) {
  const Point hi = point(v.hi), lo = point(v.lo);
  return {hi.x + lo.x, hi.y + lo.y, hi.z + lo.z};
}
inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(const Rational& s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Rational dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Rational square(const Point& a) { return dot(a, a); }

inline Integer common_denominator(const std::array<Point, 4>& points) {
  Integer out = 1;
  for (const Point& p : points) {
    for (const Rational* x : {&p.x, &p.y, &p.z}) {
      if (x->get_den() > out) out = x->get_den();  // powers of two
    }
  }
  return out;
}
inline Rational squared_distance(const Point& p, const Corners& t) {
  const std::array<Point, 4> points{p, point(t.a), point(t.b), point(t.c)};
  const Integer scale = common_denominator(points);
  const auto whole = [&scale](const Point& q) {
    const auto one = [&scale](const Rational& x) -> Integer {
      return x.get_num() * (scale / x.get_den());
    };
    return exact::Vector{one(q.x), one(q.y), one(q.z)};
  };
  const exact::Fraction f =
      exact::to_triangle(whole(points[0]), whole(points[1]), whole(points[2]), whole(points[3]));
  Rational out(f.numerator, f.denominator * scale * scale);
  out.canonicalize();
  return out;
}

inline bool covers(double bound, const Rational& squared) {
  return vkh::test::is_upper_bound(bound, squared);
}

}  // namespace vkh::native::test
