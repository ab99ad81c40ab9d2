// The expressions that bounds are composed of, once each, for the doctor: a driver that regroups
// sums would falsify them, even if each of its operations rounds as it should.
#ifndef VKH_SHADERS_DOCTOR_COMPOSED_H
#define VKH_SHADERS_DOCTOR_COMPOSED_H

#include "shaders/math/lower.h"

VKH_LIB_BEGIN

struct ComposedQuestion {
  Two3 u, v, w;
  float x, y;
  Two reach;
  float norm_base, quotient_base;
};

// The results in the order of SelfTestComposed.
struct ComposedAnswer {
  Two3 difference, combination;
  Two product;
  vec3 coarse;
  float norm, norm_above;
  float quotient, quotient_above;
};

VKH_FN ComposedAnswer composed(ComposedQuestion q) {
  ComposedAnswer c;
  c.difference = two_difference(q.u, q.v);
  c.combination = two_combination(q.u, q.x, q.v, q.y, q.w);
  c.product = two_dot(q.u, q.v);
  c.coarse = coarse_difference(q.u, q.v);
  c.norm = sharp_norm_up(q.u);
  c.norm_above = sharp_norm_above_up(q.u, q.norm_base);
  c.quotient = quotient_down(q.reach.hi, abs(q.x));
  c.quotient_above = quotient_above_down(q.reach, 0.0f, scaled(q.w), q.quotient_base);
  return c;
}

VKH_LIB_END
#endif
