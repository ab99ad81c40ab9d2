// What a wave does under the paper's switches: sorting, the packet walk, which u comes first, and
// what becomes of a frontier that does not fit where nothing may wait. Include after `control`,
// `dispatches` and kSwitches are declared and candidate/dispatch.glsl is included.
#ifndef VKH_SHADERS_LIB_SCHEDULE_GLSL
#define VKH_SHADERS_LIB_SCHEDULE_GLSL

#include "shaders/sort/sort.glsl"

bool may_wait() { return (kSwitches & kUseDefer) != 0u; }

// Decides the wave's order, and returns how many of the `held` candidates stay in the frontier.
//
// Largest u first goes through a frontier breadth first: children have smaller u than their parent,
// so one that the reserve is spent on need not be followed by its own children, which alone are
// sure to fit it. So while only the reserve is free, the smallest come first all the same. Whenever
// that begins the whole reserve is free, a candidate is gone through with all its descendants, and
// its place is won; every wave refines at least one, and there are finitely many.
//
// Where nothing may wait, a frontier that does not fit is lost as a whole: wave/split.glsl keeps
// the u of each, and so it goes with what A's other faces leave, so that at the end every face has
// a bound.
uint schedule(uint held, uint room) {
  bool largest = (kSwitches & kUseLargestFirst) != 0u && room > kReserve + 3u;
  control.select_largest = largest ? 1u : 0u;
  control.sorted = (kSwitches & kUseSort) != 0u && held >= control.sort_from ? 1u : 0u;
  if (may_wait() || (control.deferred == 0u && control.lost == 0u)) return held;
  control.lost += held;
  control.parents = 0u;
  control.deferred = held;
  return 0u;
}

// Faces of A that the wave admits, beside `held` candidates, with so much room left: while the
// frontier is at most a quarter full, so that it can be refined as a whole.
uint roots_to_admit(uint held, uint room) {
  uint quarter = (control.capacity - kReserve) / 4u;
  uint waiting = control.face_count - control.root_cursor;
  return held < quarter ? min(waiting, min(quarter - held, room - kReserve)) : 0u;
}

// Whether the wave splits its `held` candidates twice: there are few, and there is room for their
// children and, in a stream for three of each of a quarter of the capacity, for their new points.
bool may_split_twice(uint held, uint room) {
  bool fits = 15u * held + kReserve < room && 20u * held <= control.capacity;
  return kMaySplitTwice && held > 0u && held <= kTwiceParents && fits;
}

// What a run ends with that decided all it held.
uint status_decided() {
  if (control.lost > 0u) return kStatusMemory;
  return control.culled[kCullPrecision] > 0u ? kStatusPrecision : kStatusDecided;
}

void write_query_sizes(uint parents, uint held) {
  bool packets = (kSwitches & kUsePacket) != 0u && !walks_in_groups(3u * parents);
  uint queries = packets ? 0u : points_each() * parents;
  if (control.measuring != 0u) queries = 1u;
  bool splits = kFused && control.measuring == 0u;
  dispatches[kDispatchQueryPoints] = splits ? groups_for_splits(held) : groups_for_queries(queries);
  dispatches[kDispatchPacket] = groups_for(packets ? parents : 0u);
}

void write_sort_sizes(uint held) {
  if ((kSwitches & kUseSort) == 0u) return;
  uint keys = control.sorted != 0u ? held : 0u;
  uint blocks = sort_blocks(keys);
  dispatches[kDispatchSortKeys] = groups_for(keys);
  dispatches[kDispatchSortBlocks] = groups_of(blocks);
  dispatches[kDispatchSortDigits] = groups_of(blocks > kSortFewBlocks ? kSortDigits : 0u);
}

#endif
