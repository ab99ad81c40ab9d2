// Does the operations that certificates rest on, once per item, for the host to compare with exact
// results: +
// - * / sqrt, the error-free transformations as the bounds use them, the expressions that bounds
// are composed of, bits of floats, subgroup operations in whole and divergent subgroups, atomic
// maxima of bits. Invariant: nothing here knows the right result, so that no compiler can put it
// in. Source: docs/certificate.md, "The model of arithmetic".
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "shaders/doctor/composed.h"
#include "shaders/base/invocation.glsl"
#include "shaders/base/subgroup.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Questions { SelfTestQuestion questions[]; };
layout(scalar, binding = 1) writeonly buffer Answers { SelfTestAnswer answers[]; };
layout(scalar, binding = 2) buffer Totals { SelfTestTotals totals; };
layout(scalar, binding = 3) readonly buffer Operands { SelfTestOperands operands[]; };
layout(scalar, binding = 4) writeonly buffer Composed { SelfTestComposed results[]; };
layout(scalar, binding = 5) writeonly buffer Groups { SelfTestGroups groups[]; };

// A number for the subgroup, the same in all of its invocations.
uint name_subgroup() {
  uint name = 0u;
  if (subgroupElect()) name = atomicAdd(totals.subgroups, 1u);
  return subgroupBroadcastFirst(name);
}

SelfTestComposed ask_composed(SelfTestOperands q) {
  ComposedAnswer c = composed(
      ComposedQuestion(Two3(q.u_hi, q.u_lo), Two3(q.v_hi, q.v_lo), Two3(q.w_hi, q.w_lo), q.x, q.y,
                       Two(q.reach_hi, q.reach_lo), q.norm_base, q.quotient_base));
  return SelfTestComposed(c.difference.hi, c.difference.lo, c.combination.hi, c.combination.lo,
                          c.product.hi, c.product.lo, c.coarse, c.norm, c.norm_above, c.quotient,
                          c.quotient_above);
}

SelfTestGroup look_around(uint subgroup, uint item, float a, float b) {
  SelfTestGroup seen;
  seen.ballot = subgroupBallot(true);
  seen.subgroup = subgroup;
  seen.lane = gl_SubgroupInvocationID;
  seen.first = subgroupBroadcastFirst(gl_SubgroupInvocationID);
  seen.first_lane = first_lane(seen.ballot);
  seen.elected = subgroupElect() ? 1u : 0u;
  seen.members = subgroupBallotBitCount(seen.ballot);
  seen.rank = subgroupBallotExclusiveBitCount(seen.ballot);
  seen.sum = subgroupInclusiveAdd(item + 1u);
  seen.shuffled = subgroupShuffle(item, seen.first_lane);
  seen.least = subgroupMin(a);
  seen.highest = subgroupMax(a);
  seen.all_least = subgroupMin(vec3(a, b, -a));
  seen.all_highest = subgroupMax(vec3(a, b, -a));
  return seen;
}

// In the two branches, and in a turn of the loop, a and b change places: the operands differ, so
// that no compiler merges two pieces of code.
SelfTestGroups look_around_everywhere(uint subgroup, uint item, SelfTestQuestion q) {
  SelfTestGroups seen;
  seen.whole = look_around(subgroup, item, q.a, q.b);
  if (q.a > q.b) {
    seen.branch = look_around(subgroup, item, q.a, q.b);
  } else {
    seen.branch = look_around(subgroup, item, q.b, q.a);
  }
  for (uint turn = 0u; turn <= (q.bits & 3u); ++turn)
    seen.loop = look_around(subgroup, item + turn, q.a, q.b);
  return seen;
}

void main() {
  // The host gives whole workgroups, so that every invocation of a subgroup takes part.
  uint i = item_index();
  float a = questions[i].a;
  float b = questions[i].b;
  Two sum = two_sum(a, b);
  Two product = two_product(a, b);
  bool keep = a > b;
  SelfTestAnswer answer;
  answer.sum = a + b;
  answer.difference = a - b;
  answer.product = a * b;
  answer.quotient = a / b;     // uncertified: this is the measurement
  answer.root = sqrt(abs(a));  // uncertified: the same
  answer.sum_hi = sum.hi;
  answer.sum_lo = sum.lo;
  answer.product_hi = product.hi;
  answer.product_lo = product.lo;
  answer.bits = floatBitsToUint(uintBitsToFloat(questions[i].bits));
  answer.larger = max(a, b);
  answer.smaller = min(a, b);
  answer.subgroup = name_subgroup();
  answer.highest = subgroupMax(abs(a));
  answer.keepers = subgroupBallotBitCount(subgroupBallot(keep));
  answer.rank = subgroupBallotExclusiveBitCount(subgroupBallot(keep));
  answers[i] = answer;
  // Either every invocation of a workgroup has an item, or none has.
  if (i < groups.length()) groups[i] = look_around_everywhere(answer.subgroup, i, questions[i]);
  if (i < operands.length()) results[i] = ask_composed(operands[i]);
  atomicMax(totals.highest, floatBitsToUint(abs(a)));
  atomicMin(totals.lowest, floatBitsToUint(abs(a)));
  atomicAdd(totals.items, 1u);
}
