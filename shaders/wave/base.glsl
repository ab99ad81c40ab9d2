// The base of a run: a float under the largest distance of a vertex of A, so that distances above
// it have more bits than the distances themselves. The kernel declares `control`.
#ifndef VKH_SHADERS_WAVE_BASE_GLSL
#define VKH_SHADERS_WAVE_BASE_GLSL

#include "shaders/base/switches.glsl"
#include "shaders/math/bounds.h"

// Lies 84 ulp under a distance: near enough to gain 16 bits, far enough for the rounding of the
// plain floats that it comes from.
float base_under(float distance) { return 0.99999 * distance; }

// Returns 0 if distances are as small as the error of plain floats: 1.04e-6 seen for a vertex on B.
float base_of_run() {
  return max(base_under(uintBitsToFloat(control.maximum[kMaxVertex])) - 1.0e-5, 0.0);
}

// Whether 14 ulp of the distances at hand, as plain floats leave them, are more than a twentieth of
// the tolerance. wave_bound measures coarser than that where a GPU gains by it: coarse_slack in
// math/triangle.h.
bool needs_sharp(float distance) { return 3.0e-5 * distance > control.cull_tolerance; }

// Whether a point may be so near to B that its closest point has to be found to 48 bits
// (View::fine). Runs of ordinary pairs never need it, and took 6 % longer with it.
bool is_fine(float base) { return has_subroots() && base == 0.0; }

// Whether plain floats are too coarse to compare samples in.
bool is_tight(float base) { return control.two_float != 0u || needs_sharp(base); }

// A distance that is at most this above the base is within the limit.
float limit_above_base() { return lowered(control.limit - control.base); }

// Whether a sample, `above` the base, is farther than the limit by more than it may be wrong: in
// plain floats by 14 ulp of its distance and about as many of the coordinates, which are of order 1
// (base_of_run); otherwise by far less than the tolerance, except for a position in plain floats.
// The report proves it.
bool is_beyond_limit(float above) {
  float position = control.two_float != 0u ? 0.0 : 2.5e-7;
  float error =
      control.tight != 0u ? control.cull_tolerance + position : 4.0e-6 * (control.limit_up + 1.0);
  return control.limit > 0.0 && (control.base - control.limit_up) + above > error;
}

#endif
