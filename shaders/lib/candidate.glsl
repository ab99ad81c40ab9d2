// Candidates in a wave: where they stand in the frontier, their geometry in their root's frame, and what closes them.
// Include after `control`, `frontier`, `positions` and `faces` are declared.
#ifndef VKH_SHADERS_LIB_CANDIDATE_GLSL
#define VKH_SHADERS_LIB_CANDIDATE_GLSL

#include "shaders/lib/bary.h"
#include "shaders/lib/bounds.h"

// The half of the frontier that this wave reads, and the one that it writes.
uint reading(uint i) { return control.parity * control.capacity + i; }
uint writing(uint i) { return (1u - control.parity) * control.capacity + i; }

Root load_root(uint face) {
  uvec3 f = faces[face];
  Corners t;
  t.a = positions[f.x];
  t.b = positions[f.y];
  t.c = positions[f.z];
  return make_root(t);
}

// Candidates with u <= this are closed: they can never widen the interval beyond the tolerance. `tolerant` is the switch
// kUseToleranceCull; without it only what is under the lower bound is closed.
float cull_threshold(bool tolerant) {
  float lower = uintBitsToFloat(control.maximum[kMaxLower]);
  return tolerant ? lower + control.cull_tolerance : lower;
}

// Whether 14 ulp of the distances at hand are more than a twentieth of the tolerance.
bool sharp_distances() { return 3.0e-5 * uintBitsToFloat(control.maximum[kMaxLower]) > control.cull_tolerance; }

#endif
