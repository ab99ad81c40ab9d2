// Outward-rounded float32 arithmetic: the only file that may divide or take a root.
//
// The model is the precision table of the Vulkan specification ("Precision and Operation of SPIR-V
// Instructions"), not one device's behaviour:
//   + - *         correctly rounded, in a direction that is not defined: |fl(x) - x| <= kUlp |x|
//   /             2.5 ulp for divisors in [2^-126, 2^126]
//   inversesqrt   2 ulp; sqrt(x) is 1 / inversesqrt(x), so 4.5 ulp and a rounding: under 6 ulp,
//                 for x that is not flushed to 0; see root()
//   results below 2^-126 may be flushed to zero, and a zero may have either sign
// One ulp is at most kUlp times the value. The build decorates every operation, so that drivers
// neither regroup sums nor contract a product and a sum (tools/kernels/float_order.py).
#ifndef VKH_SHADERS_MATH_CERTIFIED_H
#define VKH_SHADERS_MATH_CERTIFIED_H

#include "shaders/math/choose.h"
#include "shaders/math/two_float.h"

VKH_LIB_BEGIN

VKH_CONST float kUlp = 1.1920929e-7f;  // 2^-23

// Covers every flush to zero. A square under 2^-126 comes from a length under 2^-63; the few that
// are added in one formula stay under this. Coordinates are of order 1
// (host/include/vkhausdorff/frame.h), so this is 2^-40 of an ulp.
VKH_CONST float kTiny = 8.6736174e-19f;  // 2^-60

// Denominators under this are squares of lengths under 2^-48, far below an ulp of the coordinates:
// such an edge is treated as a point. It also keeps quotients under 2^49, so that no product of
// them overflows.
VKH_CONST float kSmallSquare = 1.2621774e-29f;  // 2^-96

// Smallest float that is sure to be >= x for x >= 0 with a relative error of up to n * kUlp (n <=
// 64); the product's own rounding and the flush are included.
VKH_FN float round_up(float x, float n) { return x * (1.0f + (n + 2.0f) * kUlp) + kTiny; }

// The same for <= x, and never below 0.
VKH_FN float round_down(float x, float n) {
  return max(x * (1.0f - (n + 2.0f) * kUlp) - kTiny, 0.0f);
}

VKH_CONST float kLeastNormal = 1.1754944e-38f;  // 2^-126

// sqrt(x) for x >= 0, but 2^-63 if x may be flushed: 1 / inversesqrt(0) is outside of the table.
// The excess is under kTiny, which every use adds or takes off.
VKH_FN float root(float x) { return sqrt(max(x, kLeastNormal)); }

// The bits of x >= 0, which order as floats do. A zero may have either sign: it is taken off.
VKH_FN uint bits_of(float x) { return floatBitsToUint(x) & 0x7fffffffu; }

// >= sqrt(x) for x >= 0 that is itself >= the square that is meant (see norm_up).
VKH_FN float sqrt_up(float x) { return round_up(root(x), 6.0f); }

// <= sqrt(x), in the same way.
VKH_FN float sqrt_down(float x) { return round_down(root(x), 6.0f); }

// >= |v|. Three products and two sums: 3 ulp on the square, so under 2 on the root, whose own error
// sqrt_up covers.
VKH_FN float norm_up(vec3 v) { return round_up(root(dot3(v, v)), 8.0f); }

// >= the length whose square is `square`, a dot product of a vector with itself.
VKH_FN float length_up(float square) { return round_up(root(square), 8.0f); }

// <= |v|.
VKH_FN float norm_down(vec3 v) { return round_down(root(dot3(v, v)), 8.0f); }

// A float above x and one below it, for x >= 0: the neighbours where x is normal; around 0, where
// results may be flushed, kTiny above and 0 below.
VKH_FN float next_up(float x) {
  return x > kTiny ? uintBitsToFloat(floatBitsToUint(x) + 1u) : 2.0f * kTiny;
}
VKH_FN float next_down(float x) {
  return x > kTiny ? uintBitsToFloat(floatBitsToUint(x) - 1u) : 0.0f;
}

// a / b where b is a square, 0 where b is too small to mean anything. Not certified: a quotient
// only places a point, and any point in its range is right.
VKH_FN float ratio(float a, float b) {
  float quotient = a / b;
  return choose(b > kSmallSquare, quotient, 0.0f);
}

// >= |v|, within 4 ulp. From s near sqrt(x), sqrt(x) = sqrt(s^2 + e) <= s + e / (2 s) for either
// sign of e: the root's own error only enters through e, which is taken to 48 bits. The dot
// product's 8 kUlp2 are under one ulp by far.
VKH_FN float sharp_norm_up(Two3 v) {
  Two x = two_dot(v, v);
  if (!(x.hi > 1e-30f)) return round_up(norm_up(v.hi) + norm_up(v.lo), 1.0f);
  float s = root(x.hi);
  Two square = two_product(s, s);
  float e = ((x.hi - square.hi) - square.lo) + x.lo;
  return next_up(next_up(s + 0.5f * ratio(e, s)));
}

// Numbers above x and below it by more than two roundings of x, whatever its sign.
VKH_FN float raised(float x) { return x + (4.0f * kUlp * abs(x) + kTiny); }
VKH_FN float lowered(float x) { return x - (4.0f * kUlp * abs(x) + kTiny); }

// >= |v| - base for base >= 0, within 6 ulp of the difference and 16 kUlp2 of |v|: where distances
// are close to base, their difference keeps the bits that the distances themselves have no room
// for. As sharp_norm_up, but s and e / (2 s) are not added before base is taken off: s - base is
// exact where they are within a factor of two, and elsewhere raised takes its rounding. Off by, in
// units of kUlp2 |v|: the dot product 3, e's sums 5, its quotient 5, the last sum 2.
VKH_FN float sharp_norm_above_up(Two3 v, float base) {
  Two x = two_dot(v, v);
  if (!(x.hi > 1e-30f)) return raised(round_up(norm_up(v.hi) + norm_up(v.lo), 2.0f) - base);
  float s = root(x.hi);
  Two square = two_product(s, s);
  float e = ((x.hi - square.hi) - square.lo) + x.lo;
  return raised((s - base) + (0.5f * ratio(e, s) + 16.0f * kUlp2 * s));
}

// <= (reach - off) / |r| - base for reach > 0 and |r| >= 1, or -base. With l near |r| and |r| <= l
// + extra, and q near the quotient, it is q + (reach - off - q l - q extra) / |r| - base. Off by,
// in units of kUlp2 q: extra 13, the sums 10, their quotient by l in place of |r| 32, the last sum
// 3; q - base as in sharp_norm_above_up.
VKH_FN float quotient_above_down(Two reach, float off, Two3 r, float base) {
  Two square = two_dot(r, r);
  float l = root(square.hi);
  if (!(reach.hi > 0.0f) || l < 0.5f) return lowered(-base);
  Two back = two_product(l, l);
  float e = ((square.hi - back.hi) - back.lo) + square.lo;
  float extra = 0.5f * ratio(e, l);
  float q = reach.hi / l;
  Two product = two_product(q, l);
  float rest = (((reach.hi - product.hi) - product.lo) + reach.lo) - q * extra;
  float less = round_up(off / l, 16.0f) + 64.0f * kUlp2 * q;
  return lowered((q - base) + (rest / l - less));
}

// <= a / b for a > 0 and b >= 2^-50, within 4 ulp: the quotient's own error is taken out by its
// remainder.
VKH_FN float quotient_down(float a, float b) {
  float q = a / b;
  Two back = two_product(q, b);
  float remainder = (a - back.hi) - back.lo;
  return max(next_down(next_down(q + remainder / b)) - kTiny, 0.0f);
}

VKH_LIB_END
#endif
