// The plan under the paper's switches: sorting, the order of u, and the handling of a frontier that
// does not fit if nothing may wait. The kernel declares `control`.
#ifndef VKH_SHADERS_WAVE_SCHEDULE_GLSL
#define VKH_SHADERS_WAVE_SCHEDULE_GLSL

#include "shaders/wave/room.glsl"

bool may_wait() { return (kSwitches & kUseDefer) != 0u; }

// Decides the wave's order, and returns how many of the `held` candidates stay in the frontier.
//
// Largest u first traverses a frontier breadth first: children have smaller u than their parent,
// so the candidate after one that used up the reserve need not be its own child, and only its
// children are sure to fit. So while only the reserve is free, the smallest come first, under this
// switch, too. Whenever that begins, the whole reserve is free: a candidate is traversed with all
// its descendants, which frees its place. Every wave refines at least one candidate, and there are
// finitely many.
//
// If nothing may wait, a frontier that does not fit is spilled as a whole: wave/split.glsl keeps
// the u of each, and the same happens to the children of A's other faces, so that at the end every
// face has a bound.
uint schedule(uint held, uint room) {
  bool largest = (kSwitches & kUseLargestFirst) != 0u && room > reserve() + 3u;
  control.select_largest = largest ? 1u : 0u;
  control.sorted = sorts_frontier() && held >= control.sort_from ? 1u : 0u;
  if (may_wait() || (control.deferred == 0u && control.spilled == 0u)) return held;
  control.spilled += held;
  control.parents = 0u;
  control.deferred = held;
  return 0u;
}

#endif
