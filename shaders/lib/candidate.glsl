// Candidates in a wave: where they stand in the frontier, their geometry in their root's frame, and
// what closes them. Include after `control`, `frontier`, `vertices` and `faces` are declared.
#ifndef VKH_SHADERS_LIB_CANDIDATE_GLSL
#define VKH_SHADERS_LIB_CANDIDATE_GLSL

#include "shaders/lib/bary.h"
#include "shaders/lib/bounds.h"
#include "shaders/lib/root.glsl"

// The half of the frontier that this wave reads, and the one that it writes.
uint reading(uint i) { return control.parity * control.capacity + i; }
// Refined candidates stand behind the deferred ones.
uint parent_at(uint i) { return reading(control.deferred + i); }
uint writing(uint i) { return (1u - control.parity) * control.capacity + i; }

// What candidates are closed against: the best sample's distance, or a known one above it.
float reached() { return max(uintBitsToFloat(control.maximum[kMaxLower]), control.known_lower); }

// How far above that a candidate may be closed. Of the tolerance, 16 ulp of the distance are kept
// for the certificate of the lower bound; asking for less than 16 ulp would refine the rounding of
// distances.
float effective_tolerance() {
  float ulp = kUlp * reached();
  return max(control.cull_tolerance - 16.0 * ulp, 16.0 * ulp);
}

// Candidates with u <= this are closed: they can never widen the interval beyond the tolerance.
// `tolerant` is the switch kUseToleranceCull; without it only what is under the lower bound is
// closed.
float cull_threshold(bool tolerant) {
  return tolerant ? reached() + effective_tolerance() : reached();
}

// How a candidate's surfaces are measured: sharply where 14 ulp of the distances at hand are more
// than a twentieth of the tolerance. (Plain floats for small surfaces were tried and did not pay:
// bunny and 79741 within 1 % on lavapipe.)
View view_of(Placement placed) {
  float lower = uintBitsToFloat(control.maximum[kMaxLower]);
  return View(placed.origin, placed.reach, 3.0e-5 * lower > control.cull_tolerance);
}

#endif
