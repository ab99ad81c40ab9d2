// Distances without rounding, for floats and doubles alike: the reference for certified bounds.
// Coordinates become integers over one power of two, so that the arithmetic is GMP's on integers
// and one fraction is reduced at the end: 3.5 us a triangle, where mpq_class throughout takes 10.5
// and Boost's cpp_rational 44.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <climits>
#include <cmath>
#include <cstdint>

#include "vkhausdorff/mesh.h"

namespace vkh::test {

using Integer = mpz_class;
using Rational = mpq_class;

namespace exact {

/// A coordinate as mantissa * 2^exponent, the mantissa odd or 0.
struct Dyadic {
  int64_t mantissa = 0;
  int exponent = INT_MAX;

  explicit Dyadic(double x) {
    int e = 0;
    mantissa = static_cast<int64_t>(std::ldexp(std::frexp(x, &e), 53));
    if (mantissa == 0) return;
    const int zeros = std::countr_zero(static_cast<uint64_t>(mantissa));
    mantissa /= int64_t{1} << zeros;
    exponent = e - 53 + zeros;
  }
};

struct Vector {
  Integer x, y, z;
};

inline Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Integer dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A squared length as numerator / denominator, denominator > 0, not reduced.
struct Fraction {
  Integer numerator;
  Integer denominator;
};

inline bool less(const Fraction& a, const Fraction& b) {
  return Integer(a.numerator * b.denominator) < Integer(b.numerator * a.denominator);
}

/// Points of one power of two: integer coordinates times 2^exponent.
template <size_t N>
struct Points {
  std::array<Vector, N> at;
  int exponent = 0;
};

/// P has x, y and z, floats or doubles, finite.
template <class... P>
Points<sizeof...(P)> integers(const P&... points) {
  constexpr size_t kCount = 3 * sizeof...(P);
  std::array<Dyadic, kCount> all = [&]<size_t... I>(std::index_sequence<I...>) {
    const std::array<double, kCount> values = [&] {
      std::array<double, kCount> out{};
      size_t i = 0;
      ((out[i] = points.x, out[i + 1] = points.y, out[i + 2] = points.z, i += 3), ...);
      return out;
    }();
    return std::array<Dyadic, kCount>{Dyadic(values[I])...};
  }
  (std::make_index_sequence<kCount>{});
  Points<sizeof...(P)> out;
  out.exponent = std::min_element(all.begin(), all.end(), [](const Dyadic& a, const Dyadic& b) {
                   return a.exponent < b.exponent;
                 })->exponent;
  if (out.exponent == INT_MAX) out.exponent = 0;
  const auto integer = [&](const Dyadic& d) {
    Integer value(d.mantissa);
    if (d.mantissa != 0) value <<= static_cast<unsigned>(d.exponent - out.exponent);
    return value;
  };
  for (size_t i = 0; i < sizeof...(P); ++i) {
    out.at[i] = {integer(all[3 * i]), integer(all[3 * i + 1]), integer(all[3 * i + 2])};
  }
  return out;
}

/// Squared distance of r to the segment from the origin to e.
inline Fraction to_segment(const Vector& r, const Vector& e) {
  const Integer along = dot(r, e);
  const Integer length = dot(e, e);
  if (along <= 0) return {dot(r, r), 1};
  if (along >= length) {
    const Vector beyond = r - e;
    return {dot(beyond, beyond), 1};
  }
  return {dot(r, r) * length - along * along, length};
}

inline Fraction to_triangle(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = b - a, bc = c - b, ca = a - c;
  const Vector ap = p - a, bp = p - b, cp = p - c;
  const Vector n = cross(ab, bc);
  const Integer area = dot(n, n);
  if (area > 0 && dot(cross(ab, ap), n) >= 0 && dot(cross(bc, bp), n) >= 0 &&
      dot(cross(ca, cp), n) >= 0) {
    const Integer height = dot(ap, n);
    return {height * height, area};
  }
  Fraction best = to_segment(ap, ab);
  for (Fraction other : {to_segment(bp, bc), to_segment(cp, ca)}) {
    if (less(other, best)) best = std::move(other);
  }
  return best;
}

/// fraction * 4^exponent, reduced.
inline Rational scaled(const Fraction& fraction, int exponent) {
  Rational out(fraction.numerator, fraction.denominator);
  out.canonicalize();
  if (exponent >= 0) return out << static_cast<unsigned>(2 * exponent);
  return out >> static_cast<unsigned>(-2 * exponent);
}

}  // namespace exact

/// Squared distance of p to the triangle abc; corners may coincide or be collinear.
template <class P, class Q>
Rational squared_distance_exact(const P& p, const Q& a, const Q& b, const Q& c) {
  const auto points = exact::integers(p, a, b, c);
  const auto& [q, u, v, w] = points.at;
  return exact::scaled(exact::to_triangle(q, u, v, w), points.exponent);
}

/// Squared distance of p to the segment ab.
template <class P, class Q>
Rational squared_distance_exact(const P& p, const Q& a, const Q& b) {
  return squared_distance_exact(p, a, b, b);
}

template <class P, class Q>
Rational squared_distance_exact(const P& p, const Q& a) {
  const auto points = exact::integers(p, a);
  const exact::Vector d = points.at[0] - points.at[1];
  return exact::scaled({exact::dot(d, d), 1}, points.exponent);
}

/// Squared distance of p to the mesh, over all faces.
template <class P>
Rational squared_distance_exact(const P& p, const Mesh& mesh) {
  Rational best = -1;
  for (const glm::uvec3& f : mesh.faces) {
    Rational each =
        squared_distance_exact(p, mesh.vertices[f.x], mesh.vertices[f.y], mesh.vertices[f.z]);
    if (best < 0 || each < best) best = std::move(each);
  }
  return best;
}

/// bound >= sqrt(squared), decided exactly.
inline bool is_upper_bound(double bound, const Rational& squared) {
  if (std::isnan(bound) || bound < 0.0) return false;
  if (std::isinf(bound)) return true;
  const Rational b(bound);
  return Rational(b * b) >= squared;
}

/// base + above >= sqrt(squared), and <= it, decided exactly.
inline bool is_upper_bound(double base, double above, const Rational& squared) {
  if (std::isnan(above)) return false;
  if (std::isinf(above)) return above > 0;
  const Rational b = Rational(base) + Rational(above);
  return b >= 0 && Rational(b * b) >= squared;
}
inline bool is_lower_bound(double base, double above, const Rational& squared) {
  if (std::isnan(above)) return false;
  const Rational b = Rational(base) + Rational(above);
  return b <= 0 || Rational(b * b) <= squared;
}

/// bound <= sqrt(squared), decided exactly.
inline bool is_lower_bound(double bound, const Rational& squared) {
  if (std::isnan(bound)) return false;
  if (bound <= 0.0) return true;
  if (std::isinf(bound)) return false;
  const Rational b(bound);
  return Rational(b * b) <= squared;
}

/// The same for bounds of the square itself.
inline bool is_upper_bound_of_square(double bound, const Rational& squared) {
  return !std::isnan(bound) && (std::isinf(bound) ? bound > 0.0 : Rational(bound) >= squared);
}
inline bool is_lower_bound_of_square(double bound, const Rational& squared) {
  return !std::isnan(bound) && (std::isinf(bound) ? bound < 0.0 : Rational(bound) <= squared);
}

/// sqrt(squared) to 2^-51 of itself: for measuring slack, not for deciding.
inline double sqrt_near(const Rational& squared) {
  if (squared <= 0) return 0.0;
  const auto bits = [](const Integer& i) { return mpz_sizeinbase(i.get_mpz_t(), 2); };
  // Scaled by 4^shift into the middle of double's range, so that no exponent is too small.
  const long shift =
      (static_cast<long>(bits(squared.get_den())) - static_cast<long>(bits(squared.get_num()))) / 2;
  const Rational middle = shift >= 0 ? Rational(squared << static_cast<unsigned long>(2 * shift))
                                     : Rational(squared >> static_cast<unsigned long>(-2 * shift));
  return std::ldexp(std::sqrt(middle.get_d()), static_cast<int>(-shift));
}

}  // namespace vkh::test
