// Exact arithmetic on the shared headers' results: every float is an integer over 2^150, so
// that points add without a common denominator to look for.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <glm/vec3.hpp>
#include <string>

#include "tests/shapes/adversarial.h"
#include "tests/verification/oracle/exact.h"

namespace vkh::test {

inline constexpr int kFixedBits = 150;

/// x * 2^150; x is 0 or a multiple of it, as floats are, and doubles that are sums of two.
inline Integer fixed(double x) {
  const exact::Dyadic d(x);
  Integer out(d.mantissa);
  if (d.mantissa != 0) {
    const int shift = d.exponent + kFixedBits;
    if (shift >= 0) {
      out <<= static_cast<unsigned>(shift);
    } else {
      std::abort();
    }
  }
  return out;
}

/// x * 2^-bits to a double's precision: to compare with a bound that is wider than that.
inline double to_double(const Integer& x, int bits = kFixedBits) {
  signed long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, x.get_mpz_t());
  return std::ldexp(mantissa, static_cast<int>(exponent) - bits);
}
inline double length_near(const exact::Vector& v, int bits = kFixedBits) {
  return std::hypot(to_double(v.x, bits), to_double(v.y, bits), to_double(v.z, bits));
}

template <class P>
exact::Vector fixed_vector(const P& p) {
  return {fixed(p.x), fixed(p.y), fixed(p.z)};
}
template <class P>
exact::Vector fixed_sum(const P& hi, const P& lo) {
  return {fixed(hi.x) + fixed(lo.x), fixed(hi.y) + fixed(lo.y), fixed(hi.z) + fixed(lo.z)};
}
inline exact::Vector fixed_vector(const Stored& p) { return fixed_sum(p.hi, p.lo); }

inline Integer fixed_sum(float hi, float lo) {
  return fixed(static_cast<double>(hi)) + fixed(static_cast<double>(lo));
}

inline exact::Vector operator+(const exact::Vector& a, const exact::Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline exact::Vector operator*(const Integer& s, const exact::Vector& v) {
  return {s * v.x, s * v.y, s * v.z};
}

/// The square of a length in units of 2^-bits.
inline Rational square_of(const exact::Vector& v, int bits = kFixedBits) {
  return exact::scaled({exact::dot(v, v), 1}, -bits);
}

struct ExactTriangle {
  exact::Vector a, b, c;

  ExactTriangle() = default;
  ExactTriangle(exact::Vector x, exact::Vector y, exact::Vector z)
      : a(std::move(x)), b(std::move(y)), c(std::move(z)) {}
  explicit ExactTriangle(const StoredTriangle& t)
      : a(fixed_vector(t.corner[0])), b(fixed_vector(t.corner[1])), c(fixed_vector(t.corner[2])) {}

  ExactTriangle moved(const exact::Vector& by) const { return {a - by, b - by, c - by}; }
  Rational squared_distance(const exact::Vector& p) const {
    return exact::scaled(exact::to_triangle(p, a, b, c), -kFixedBits);
  }
};

/// Squared radius of the smallest ball that holds the triangle.
inline Rational squared_enclosing_radius(const ExactTriangle& t, int bits = kFixedBits) {
  const exact::Vector ab = t.b - t.a, ac = t.c - t.a, bc = t.c - t.b;
  const Integer c2 = exact::dot(ab, ab), b2 = exact::dot(ac, ac), a2 = exact::dot(bc, bc);
  const Integer longest = std::max({a2, b2, c2});
  if (Integer(2 * longest) >= Integer(a2 + b2 + c2)) return exact::scaled({longest, 4}, -bits);
  const exact::Vector n = exact::cross(ab, ac);
  return exact::scaled({a2 * b2 * c2, 4 * exact::dot(n, n)}, -bits);
}

inline std::string hex(const Stored& p) {
  const auto one = [](const glm::vec3& v) {
    char text[80];
    std::snprintf(text, sizeof text, "(%a, %a, %a)", static_cast<double>(v.x),
                  static_cast<double>(v.y), static_cast<double>(v.z));
    return std::string(text);
  };
  return "{" + one(p.hi) + " + " + one(p.lo) + "}";
}
inline std::string hex(const StoredTriangle& t) {
  return hex(t.corner[0]) + " " + hex(t.corner[1]) + " " + hex(t.corner[2]);
}

}  // namespace vkh::test
