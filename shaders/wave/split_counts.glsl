// The number of children and new points of a refined candidate in this wave: 4 and 3 or, if it is
// split twice, 16 and 15: three of its own and three of each child. The kernel declares `control`.
#ifndef VKH_SHADERS_WAVE_SPLIT_COUNTS_GLSL
#define VKH_SHADERS_WAVE_SPLIT_COUNTS_GLSL

#include "shaders/base/switches.glsl"
#include "shaders/math/bary.h"

// A loop over children one by one, or over a candidate's three points, takes one generation.
const bool kMaySplitTwice =
    (kSwitches & (kUseSplitTwice | kUseFilter | kUsePacket)) == kUseSplitTwice;

bool splits_twice() { return kMaySplitTwice && control.split_twice != 0u; }

uint children_each() { return splits_twice() ? 16u : 4u; }
uint points_each() { return splits_twice() ? 15u : 3u; }

// The split of a child of a candidate that is split twice.
uint child_split(Split split, uint child) {
  uint code = (split.child_splits >> (5u * child)) & 31u;
  return code == kChildSplitNone ? kSplitNone : code;
}

// The children and new points of all the wave's candidates; children of faces of A come behind.
uint child_count() { return children_each() * control.parents + control.roots; }
uint point_count() { return points_each() * control.parents; }

// New points, and survivors' centroids if they are queried.
uint query_count() {
  uint asked = (kSwitches & kUseCentroid) != 0u ? control.count[kCountSurvivors] : 0u;
  return point_count() + asked;
}

#endif
