// Candidates in a wave: their place in the frontier, their geometry in their root's frame, and the
// tests that close them. The kernel declares `control`, `frontier`, `vertices`, `faces`.
#ifndef VKH_SHADERS_WAVE_CANDIDATE_GLSL
#define VKH_SHADERS_WAVE_CANDIDATE_GLSL

#include "shaders/math/bary.h"
#include "shaders/wave/base.glsl"
#include "shaders/wave/subroot.glsl"
#include "shaders/math/bounds.h"
#include "shaders/math/hash.h"

// The half of the frontier that this wave reads, and the one that it writes.
uint reading(uint i) { return control.parity * control.capacity + i; }
uint writing(uint i) { return (1u - control.parity) * control.capacity + i; }

// A bound that was kept above the old base.
float rebased(float upper) {
  float error = kUlp2 * control.base;
  float moved = (upper + control.rebase_hi) + (control.rebase_lo + error);
  return control.rebase_hi == 0.0 ? upper : max(raised(moved), 0.0);
}

// A candidate's u, of the frontier being read.
float upper_of(Candidate c) { return rebased(c.upper); }

// The best sample's distance, above the base: with this wave's samples, complete once its queries
// have ended; and as it was when the wave began, which stays until the plan.
float lower_with_this_wave() { return uintBitsToFloat(control.maximum[kMaxLower]); }
float adopted_lower() { return control.witness.distance; }

// The distance that candidates are closed against: the best sample's, or a known one that is
// larger.
float lower_to_beat(float lower) { return max(lower, control.known_lower - control.base); }

// The margin above the lower bound within which a candidate is closed: the tolerance, less what the
// distances of samples may be wrong by. They are wrong by 32 ulp of what lies above the base and,
// if compared in plain floats, by 32 ulp of the base too; otherwise by 64 kUlp2 of it. At least a
// quarter of the tolerance stays, even if the part above the base is too coarse, because the next
// plan then moves the base. The margin is never under the error of the base: with less, a run would
// refine rounding errors.
float effective_tolerance(float lower) {
  float noise = control.base * (control.tight != 0u ? 64.0 * kUlp2 : 32.0 * kUlp);
  float above_noise = 32.0 * kUlp * lower_to_beat(lower);
  float left = max(control.cull_tolerance - noise - above_noise, 0.25 * control.cull_tolerance);
  return max(left, noise);
}

// Candidates with u <= this are closed: they can never widen the interval beyond the tolerance, or
// are proven to be within the limit. The tolerance does not widen the limit: of thousands of
// candidates some would stop there, undecided, though h is far below. `tolerant` is the switch
// kUseToleranceCull; without it only candidates under the lower bound are closed.
float cull_threshold(float lower, bool tolerant) {
  float threshold =
      tolerant ? lower_to_beat(lower) + effective_tolerance(lower) : lower_to_beat(lower);
  return control.limit > 0.0 ? max(threshold, limit_above_base()) : threshold;
}

// The view from which a candidate's surfaces are measured.
View view_of(LocalCorners placed, bool plain) {
  float distance = control.base + uintBitsToFloat(control.maximum[kMaxLower]);
  return View(placed.origin, placed.reach, control.base, needs_sharp(distance), plain, 0.0,
              is_fine(control.base));
}

// The order in which candidates are refined if there is no room for all: the smallest u first; of
// equal ones the smallest in area, so that a candidate's children come before its equals
// (kReserve); then by a hash of what the candidate is. The choice does not depend on their places
// in the frontier.
struct Key {
  uint first, second;
};

// `largest`: the wave's order, control.select_largest.
uint first_of_key(float upper, bool largest) {
  uint u = bits_of(upper);
  return largest ? ~u : u;
}

Key key_of(Candidate c, bool largest) {
  Bary3 t = unpack_corners(c.corners);
  vec2 ab = vec2(ivec2(t.b) - ivec2(t.a));
  vec2 ac = vec2(ivec2(t.c) - ivec2(t.a));
  // A dyadic area is a power of two: its exponent, 0 to 42, and 26 bits of the hash.
  uint exponent = (floatBitsToUint(max(abs(ab.x * ac.y - ab.y * ac.x), 1.0)) >> 23) - 127u;
  // A split takes two from it. Candidates in a subroot come before all others.
  if (has_subroots()) exponent = exponent / 2u + (is_subroot(c.root) ? 0u : 22u);
  uint hash = mixed(mixed(mixed(mixed(root_hash(c.root), c.corners.x), c.corners.y), c.corners.z),
                    c.corners.w);
  return Key(first_of_key(c.upper, largest), (exponent << 26) | (hash >> 6));
}

bool not_after(Key k, Key than) {
  return k.first < than.first || (k.first == than.first && k.second <= than.second);
}

#endif
