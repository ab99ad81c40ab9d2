// Arithmetic on unevaluated sums hi + lo of two doubles, some 106 bits: stands in for
// shaders/math/two_float.h. A product's error is exact by a fused operation; splitting factors, as
// there, is false for 53 bits. u is 2^-53; additions round to nearest (FloatEnvironment).
#pragma once

#define VKH_SHADERS_MATH_TWO_FLOAT_H

#include "host/native/arithmetic.h"
#define float double
#include "shaders/math/dot.h"
#undef float

namespace vkh::native {

/// 16 u^2, as two_float.h has 16 of its own.
inline constexpr double kUlp2 = 0x1p-102;

struct Two {
  double hi, lo;
};
struct Two3 {
  vec3 hi, lo;
};

/// Exact (Knuth), unless it overflows.
inline Two two_sum(double a, double b) {
  const double s = a + b;
  const double from_b = s - a;
  return {s, (a - (s - from_b)) + (b - from_b)};
}

/// Exact, unless the low part is under 2^-1074.
inline Two two_product(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

inline Two3 of_components(const Two& x, const Two& y, const Two& z) {
  return {{x.hi, y.hi, z.hi}, {x.lo, y.lo, z.lo}};
}
inline Two3 two_sum(const vec3& a, const vec3& b) {
  return of_components(two_sum(a.x, b.x), two_sum(a.y, b.y), two_sum(a.z, b.z));
}
inline Two3 two_product(double a, const vec3& b) {
  return of_components(two_product(a, b.x), two_product(a, b.y), two_product(a, b.z));
}

inline Two3 two(const vec3& hi) { return {hi, {}}; }

/// a - b; off by kUlp2 (|a| + |b|): low parts are under u of the high ones, and two roundings, of
/// sums of 4 u (|a| + |b|) at most, take u of them each. Exact where neither has a low part.
inline Two3 two_difference(const Two3& a, const Two3& b) {
  Two3 d = two_sum(a.hi, -b.hi);
  d.lo = d.lo + (a.lo - b.lo);
  return d;
}

/// base + x u + y v; off by 4 kUlp2 S, where S = |base| + |x u| + |y v|: seven low parts, of 7 u S
/// together, are rounded eight times: 56 u^2 S of 64.
inline Two3 two_combination(const Two3& base, double x, const Two3& u, double y, const Two3& v) {
  const Two3 p = two_product(x, u.hi);
  const Two3 q = two_product(y, v.hi);
  const Two3 s = two_sum(base.hi, p.hi);
  const Two3 t = two_sum(s.hi, q.hi);
  const vec3 low = ((base.lo + s.lo) + t.lo) + ((p.lo + q.lo) + (x * u.lo + y * v.lo));
  return two_sum(t.hi, low);
}

/// a . b; it only steers: nothing certified uses it.
inline Two two_dot(const Two3& a, const Two3& b) {
  return {dot3(a.hi, b.hi), dot3(a.hi, b.lo) + dot3(a.lo, b.hi)};
}

inline double rounded(const Two& a) { return a.hi + a.lo; }
inline vec3 rounded(const Two3& a) { return a.hi + a.lo; }

}  // namespace vkh::native
