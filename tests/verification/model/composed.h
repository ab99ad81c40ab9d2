// Composed expressions (shaders/doctor/composed.h) as a device would answer the doctor on them, in
// the arithmetic that lib_device.h was chosen with.
#pragma once

#include "tests/verification/model/lib_device.h"

#ifdef VKH_TEST_VULKAN_MODEL
#define float ::vkh::model::Real
#endif
#include "shaders/doctor/composed.h"
#undef float

namespace vkh::test {

inline math::Two3 pair(const gpu::vec3& hi, const gpu::vec3& lo) {
  math::Two3 t;
  t.hi = math::vec3(hi.x, hi.y, hi.z);
  t.lo = math::vec3(lo.x, lo.y, lo.z);
  return t;
}

inline gpu::vec3 plain(const math::vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

inline gpu::SelfTestComposed answer_composed(const gpu::SelfTestOperands& q) {
  math::ComposedQuestion asked;
  asked.u = pair(q.u_hi, q.u_lo);
  asked.v = pair(q.v_hi, q.v_lo);
  asked.w = pair(q.w_hi, q.w_lo);
  asked.x = q.x;
  asked.y = q.y;
  asked.reach.hi = q.reach_hi;
  asked.reach.lo = q.reach_lo;
  asked.norm_base = q.norm_base;
  asked.quotient_base = q.quotient_base;
  const math::ComposedAnswer c = math::composed(asked);
  return {.difference_hi = plain(c.difference.hi),
          .difference_lo = plain(c.difference.lo),
          .combination_hi = plain(c.combination.hi),
          .combination_lo = plain(c.combination.lo),
          .dot_hi = static_cast<float>(c.product.hi),
          .dot_lo = static_cast<float>(c.product.lo),
          .coarse = plain(c.coarse),
          .norm = static_cast<float>(c.norm),
          .norm_above = static_cast<float>(c.norm_above),
          .quotient = static_cast<float>(c.quotient),
          .quotient_above = static_cast<float>(c.quotient_above)};
}

}  // namespace vkh::test
