// Candidates in a wave: where they stand in the frontier, their geometry in their root's frame, and what closes them.
// Include after `control`, `frontier`, `positions` and `faces` are declared.
#ifndef VKH_SHADERS_LIB_CANDIDATE_GLSL
#define VKH_SHADERS_LIB_CANDIDATE_GLSL

#include "shaders/lib/bary.h"
#include "shaders/lib/bounds.h"

// The half of the frontier that this wave reads, and the one that it writes.
uint reading(uint i) { return control.parity * control.capacity + i; }
uint writing(uint i) { return (1u - control.parity) * control.capacity + i; }

// A root triangle of A: its first corner is the local origin.
struct Root {
  vec3 origin, ab, ac;
};

Root load_root(uint face) {
  uvec3 f = faces[face];
  Root r;
  r.origin = positions[f.x];
  r.ab = positions[f.y] - r.origin;
  r.ac = positions[f.z] - r.origin;
  return r;
}

// The position of a point of the root in the frame of the meshes, rounded; for steering and for queries.
vec3 global_position(Root r, uvec2 point) { return r.origin + place(point, r.ab, r.ac); }

// Candidates with u <= this are closed: they can never widen the interval beyond the tolerance. `tolerant` is the switch
// kUseToleranceCull; without it only what is under the lower bound is closed.
float cull_threshold(bool tolerant) {
  float lower = uintBitsToFloat(control.maximum[kMaxLower]);
  return tolerant ? lower + control.cull_tolerance : lower;
}

#endif
