// Outward-rounded double arithmetic: stands in for shaders/math/certified.h. The model is IEEE 754,
// rounding to nearest: |fl(x) - x| <= u |x| with u = 2^-53 for + - * / and the root, and 2^-1075
// more where a product or quotient is under 2^-1022 (FloatEnvironment asserts both; the build has
// -ffp-contract=off). One kUlp is 2 u, as in the float version, so that a count of kUlp there
// covers twice as many roundings here.
#pragma once

#define VKH_SHADERS_MATH_CERTIFIED_H

#include "host/native/two_double.h"
#define float double
#include "shaders/math/choose.h"
#undef float

namespace vkh::native {

/// 1 + k kUlp is a double for whole k, which 1 + k u is not.
inline constexpr double kUlp = 0x1p-52;

/// Covers every underflow: three squares of lengths lose 2^-1073 at most, whose root is under
/// 2^-536. Coordinates are of order 1, so that this is 2^-448 of an ulp.
inline constexpr double kTiny = 0x1p-500;

/// Squares of lengths of 2^-100, which count as points. Quotients by larger ones stay under 2^201,
/// so that no product of a few of them overflows.
inline constexpr double kSmallSquare = 0x1p-200;

/// >= any X >= 0 of which x is off by n kUlp X at most, n <= 64 and whole. The product and the sum
/// take 2 u = kUlp of what is added, second order included, so that n + 1 kUlp are left.
inline double round_up(double x, double n) { return x * (1.0 + (n + 2.0) * kUlp) + kTiny; }

/// <= such an X, and never below 0.
inline double round_down(double x, double n) {
  return max(x * (1.0 - (n + 2.0) * kUlp) - kTiny, 0.0);
}

inline double root(double x) { return std::sqrt(x); }

/// >= the length whose square is `square`, a dot3 of a vector with itself. That is off by 3 u, its
/// root by 1.5 u and its own rounding: 2.5 u, of which 4 are left.
inline double length_up(double square) { return round_up(root(square), 1.0); }
inline double norm_up(const vec3& v) { return length_up(dot3(v, v)); }

/// a / b where b is a square, 0 where b is too small to mean anything. It places a point, and any
/// point in its range is right.
inline double ratio(double a, double b) {
  const double quotient = a / b;
  return choose(b > kSmallSquare, quotient, 0.0);
}

/// Above x and below it by more than two roundings of x, for x of either sign.
inline double raised(double x) { return x + (4.0 * kUlp * abs(x) + kTiny); }
inline double lowered(double x) { return x - (4.0 * kUlp * abs(x) + kTiny); }

/// >= |v| - base: v is rounded by u of itself, and round_up leaves 4 u; the difference's rounding
/// is taken by `raised`. Doubles need nothing sharper.
inline double sharp_norm_above_up(const Two3& v, double base) {
  return raised(round_up(norm_up(rounded(v)), 1.0) - base);
}

/// <= a / b for a > 0 and b > 0: a quotient's rounding, and that of a, which is a difference.
inline double quotient_down(double a, double b) { return round_down(a / b, 1.0); }

/// For fine_separation_down and part_above, which doubles do not need: they have no definitions.
double quotient_above_down(const Two& reach, double off, const Two3& r, double base);
double sqrt_up(double x);

}  // namespace vkh::native
