// Two-float arithmetic, outward-rounded where stated. An unevaluated sum hi + lo of two floats
// holds about 48 bits (Dekker 1971; Knuth's TwoSum).
//
// No step relies on fma: lavapipe's is not fused, and a contracted product is only more accurate.
// two_product is exact in any direction of rounding. two_sum is where + and - round to nearest, and
// otherwise off by at most kUlp2 / 8 of its operands (docs/proofs.md).
#ifndef VKH_SHADERS_MATH_TWO_FLOAT_H
#define VKH_SHADERS_MATH_TWO_FLOAT_H

#include "shaders/math/dot.h"

VKH_LIB_BEGIN

VKH_CONST float kUlp2 = 5.6843419e-14f;  // 2^-44

struct Two {
  float hi, lo;
};

struct Two3 {
  vec3 hi, lo;
};

VKH_FN Two3 two_sum(vec3 a, vec3 b) {
  VKH_PRECISE vec3 s = a + b;
  VKH_PRECISE vec3 from_b = s - a;
  VKH_PRECISE vec3 from_a = s - from_b;
  VKH_PRECISE vec3 e = (a - from_a) + (b - from_b);
  Two3 r;
  r.hi = s;
  r.lo = e;
  return r;
}

// x cut to 12 bits; the rest has 12 bits too, so that products of halves are exact.
VKH_FN float upper_half(float x) { return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u); }

VKH_FN Two two_product(float a, float b) {
  float ah = upper_half(a);
  float bh = upper_half(b);
  VKH_PRECISE float al = a - ah;
  VKH_PRECISE float bl = b - bh;
  VKH_PRECISE float p = a * b;
  VKH_PRECISE float e = ((ah * bh - p) + ah * bl + al * bh) + al * bl;
  Two r;
  r.hi = p;
  r.lo = e;
  return r;
}

VKH_FN Two3 two_product(float a, vec3 b) {
  Two x = two_product(a, b.x);
  Two y = two_product(a, b.y);
  Two z = two_product(a, b.z);
  Two3 r;
  r.hi = vec3(x.hi, y.hi, z.hi);
  r.lo = vec3(x.lo, y.lo, z.lo);
  return r;
}

VKH_FN Two3 two(vec3 hi) {
  Two3 r;
  r.hi = hi;
  r.lo = vec3(0.0f, 0.0f, 0.0f);
  return r;
}

// a - b; off by kUlp2 (|a| + |b|), since the low parts are under an ulp of the high ones.
VKH_FN Two3 two_difference(Two3 a, Two3 b) {
  Two3 d = two_sum(a.hi, -b.hi);
  d.lo = d.lo + (a.lo - b.lo);
  return d;
}

// base + x u + y v; off by 4 kUlp2 (|base| + |x u| + |y v|).
VKH_FN Two3 two_combination(Two3 base, float x, Two3 u, float y, Two3 v) {
  Two3 p = two_product(x, u.hi);
  Two3 q = two_product(y, v.hi);
  Two3 s = two_sum(base.hi, p.hi);
  Two3 t = two_sum(s.hi, q.hi);
  vec3 low = ((base.lo + s.lo) + t.lo) + ((p.lo + q.lo) + (x * u.lo + y * v.lo));
  return two_sum(t.hi, low);
}

VKH_FN Two two_sum(float a, float b) {
  VKH_PRECISE float s = a + b;
  VKH_PRECISE float from_b = s - a;
  VKH_PRECISE float from_a = s - from_b;
  VKH_PRECISE float e = (a - from_a) + (b - from_b);
  Two r;
  r.hi = s;
  r.lo = e;
  return r;
}

// a . b; off by 8 kUlp2 |a| |b|.
VKH_FN Two two_dot(Two3 a, Two3 b) {
  Two x = two_product(a.hi.x, b.hi.x);
  Two y = two_product(a.hi.y, b.hi.y);
  Two z = two_product(a.hi.z, b.hi.z);
  Two s = two_sum(x.hi, y.hi);
  Two t = two_sum(s.hi, z.hi);
  float low = ((x.lo + y.lo) + (z.lo + s.lo)) + (t.lo + (dot3(a.hi, b.lo) + dot3(a.lo, b.hi)));
  return two_sum(t.hi, low);
}

VKH_FN float rounded(Two a) { return a.hi + a.lo; }

VKH_FN vec3 rounded(Two3 a) { return a.hi + a.lo; }

VKH_LIB_END
#endif
