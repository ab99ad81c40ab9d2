// Functions that append to streams and raise maxima in the control block, one atomic per subgroup.
// They read the subgroup's size, and never assume it. Every invocation of the subgroup calls these
// together; an invocation without a value passes false or 0. The kernel declares `control`.
#ifndef VKH_SHADERS_BASE_STREAM_GLSL
#define VKH_SHADERS_BASE_STREAM_GLSL

#include "shaders/math/certified.h"

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require

// Reserves a slot of stream `which` for every invocation that keeps something.
uint stream_append(uint which, bool keep) {
  uvec4 keepers = subgroupBallot(keep);
  uint base = 0u;
  if (subgroupElect()) base = atomicAdd(control.count[which], subgroupBallotBitCount(keepers));
  return subgroupBroadcastFirst(base) + subgroupBallotExclusiveBitCount(keepers);
}

// maximum[which] = max(maximum[which], value), for value >= 0.
void raise(uint which, float value) {
  float highest = subgroupMax(value);
  if (subgroupElect() && highest > 0.0) {
    atomicMax(control.maximum[which], bits_of(highest));
  }
}

void count_culled(uint why, bool culled) {
  uint n = subgroupBallotBitCount(subgroupBallot(culled));
  if (subgroupElect() && n > 0u) atomicAdd(control.culled[why], n);
}

#endif
