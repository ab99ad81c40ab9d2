// The contribution of a workgroup of wave_bound to the control block. On GPUs it is summed up
// first: its words are in a cache line or two, where the atomics of all workgroups wait for each
// other. On CPU devices a barrier costs more than an atomic. The kernel declares what
// wave/bound_group.glsl needs.
#ifndef VKH_SHADERS_WAVE_BOUND_TALLY_GLSL
#define VKH_SHADERS_WAVE_BOUND_TALLY_GLSL

#include "shaders/base/stream.glsl"
#include "shaders/wave/bound_group.glsl"

// Words 0 to kCullLowerRaised: children closed, by kCull*.
const uint kTallyClosed = kCullLowerRaised + 1u;  // the largest u of these, as bits
const uint kTallyNext = kTallyClosed + 1u;        // the largest u of the children that stay open
const uint kTallyOpen =
    kTallyNext + 1u;  // the number of these; then the start of their slots in the stream
const uint kTallies = kTallyOpen + 1u;

// The tally reuses the words of known triangles, which are not read after the cuts: shared memory
// is scarce.
uint tally_word(uint i) { return known_triangle[i]; }

// Called by every invocation, like the functions below; a barrier stands before count_and_place.
void begin_tally() {
  if (gl_LocalInvocationID.x < kTallies) known_triangle[gl_LocalInvocationID.x] = 0u;
}

// Returns how many were counted before this invocation.
uint tally_count(uint word, bool counts) {
  uvec4 counted = subgroupBallot(counts);
  uint before = 0u;
  if (subgroupElect()) before = atomicAdd(known_triangle[word], subgroupBallotBitCount(counted));
  return subgroupBroadcastFirst(before) + subgroupBallotExclusiveBitCount(counted);
}

// Requires value >= 0.
void tally_raise(uint word, float value) {
  float highest = subgroupMax(value);
  if (subgroupElect()) atomicMax(known_triangle[word], bits_of(highest));
}

// One invocation per word.
void give_tally() {
  uint i = gl_LocalInvocationID.x;
  if (i >= kTallies || tally_word(i) == 0u) return;
  if (i < kTallyClosed) atomicAdd(control.culled[i], tally_word(i));
  if (i == kTallyClosed) atomicMax(control.maximum[kMaxClosed], tally_word(i));
  if (i == kTallyNext) atomicMax(control.maximum[kMaxNext], tally_word(i));
  if (i == kTallyOpen) known_triangle[i] = atomicAdd(control.count[kCountNext], tally_word(i));
}

// A child that is closed, or open, or neither. Returns the slot of an open one in the stream.
uint count_and_place(bool closed, bool open, Verdict v) {
  float closed_u = closed ? v.upper : 0.0;
  float next = open ? v.upper : 0.0;
  if (!kWide) {
    for (uint why = kCullExact; why <= kCullLowerRaised; ++why)
      count_culled(why, closed && v.by == why);
    raise(kMaxClosed, closed_u);
    raise(kMaxNext, next);
    return stream_append(kCountNext, open);
  }
  for (uint why = kCullExact; why <= kCullLowerRaised; ++why)
    tally_count(why, closed && v.by == why);
  tally_raise(kTallyClosed, closed_u);
  tally_raise(kTallyNext, next);
  uint slot = tally_count(kTallyOpen, open);
  barrier();
  give_tally();
  barrier();
  return tally_word(kTallyOpen) + slot;
}

#endif
