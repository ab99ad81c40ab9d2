// Decides how many faces of A a wave admits, whether it splits its candidates twice, how much room
// would be enough for all, and how a run ends. The kernel declares `control`.
#ifndef VKH_SHADERS_WAVE_ROOM_GLSL
#define VKH_SHADERS_WAVE_ROOM_GLSL

#include "shaders/wave/split_counts.glsl"

uint reserve() { return has_subroots() ? 2u * kReserve : kReserve; }

// Faces of A that the wave admits beside `held` candidates, with `room` places left: only while the
// frontier is at most a quarter full, so that it can be refined as a whole.
uint roots_to_admit(uint held, uint room) {
  uint quarter = (control.capacity - reserve()) / 4u;
  uint waiting = control.face_count - control.root_cursor;
  return held < quarter ? min(waiting, min(quarter - held, room - reserve())) : 0u;
}

// Whether the wave splits its `held` candidates twice: there are few, and there is room for their
// children and, in a stream for three of each of a quarter of the capacity, for their new points.
bool may_split_twice(uint held, uint room) {
  bool fits = 15u * held + reserve() < room && 20u * held <= control.capacity;
  return kMaySplitTwice && held > 0u && held <= kSplitTwiceParents && fits;
}

// Places of each half of the frontier with which the wave refines all of its `held` candidates,
// twice if they are few, and admits every face of A that waits. Proof that nothing overflows:
// both counts are at most kMaxTriangles, 2^28, and largest_capacity, 2^28, and the sum is less than
// 2^30.
uint room_for_all(uint held) {
  uint waiting = control.face_count - control.root_cursor;
  uint once = 4u * (held + waiting + 1u) + reserve();
  bool few = kMaySplitTwice && held <= kSplitTwiceParents;
  return few ? max(once, 20u * held + reserve()) : once;
}

// The status of a run that decided all it held.
uint status_decided() {
  if (control.spilled > 0u) return kStatusMemory;
  return control.culled[kCullPrecision] > 0u ? kStatusPrecision : kStatusDecided;
}

#endif
