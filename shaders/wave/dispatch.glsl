// The sizes of indirect dispatches: one invocation per item, or the layout in which `query` takes
// its points. The kernel declares `control`.
#ifndef VKH_SHADERS_WAVE_DISPATCH_GLSL
#define VKH_SHADERS_WAVE_DISPATCH_GLSL

#include "shaders/base/switches.glsl"
#include "shaders/wave/split_counts.glsl"

Dispatch groups_of(uint groups) {
  uint x = min(groups, kMaxGroupsX);
  return Dispatch(x, x == 0u ? 0u : (groups + x - 1u) / x, 1u);
}

Dispatch groups_for(uint items) { return groups_of((items + kGroupSize - 1u) / kGroupSize); }

// Whether each of `queries` queries has a whole workgroup.
bool traverses_in_groups(uint queries) {
  return traverses_by_group() && queries <= kGroupTraversalQueries;
}

// Whether the new points of `parents` candidates are queried in packets.
bool asks_in_packets(uint parents) { return packs_points() && !traverses_in_groups(3u * parents); }

// Workgroups of query, for points that exist.
Dispatch groups_for_queries(uint queries) {
  if (traverses_in_groups(queries)) return groups_of(queries);
  return groups_of((queries + kQueryGroup - 1u) / kQueryGroup);
}

// Whether a workgroup of a fused query has one new point, and not all those of some candidates.
bool splits_in_groups() { return control.deferred == 0u && traverses_in_groups(point_count()); }

// Candidates whose new points a workgroup of a fused query has.
uint candidates_a_group() { return kQueryGroup / points_each(); }

// Workgroups of a fused query, for `held` candidates, refined or deferred.
Dispatch groups_for_splits(uint held) {
  if (splits_in_groups()) return groups_of(held * points_each());
  uint candidates = candidates_a_group();
  return groups_of((held + candidates - 1u) / candidates);
}

// Invocations of wave_subdivide per candidate. Each new point has one where a wave is a chain of
// steps.
uint split_lanes() {
  if (!kWide) return 1u;
  return splits_twice() ? kSplitTwiceLanes : kSplitLanes;
}

// Whether a child may know more triangles than its corners' three.
const bool kKnowsMore = (kSwitches & (kUseCentroid | kUseParentSamples)) != 0u;
// Children of a workgroup of wave_bound at most, so that its shared memory is small enough.
const uint kMostChildren = kKnowsMore ? kGroupSize / 2u : kGroupSize;

// The number of children that a workgroup of wave_bound takes: more if the wave has more.
uint children_a_group(uint total) {
  if (!kWide) return kMostChildren;
  uint children = kFewestChildren;
  while (children < kMostChildren && children * kBoundGroups < total) children *= 2u;
  return children;
}

// Workgroups of wave_bound, whose last one plans: there is one even if there is no child. If a
// filter has left few children, there are enough to go over the wave's samples (wave/witness.glsl).
Dispatch groups_for_children(uint total) {
  uint children = children_a_group(total);
  uint groups = max((total + children - 1u) / children, 1u);
  return groups_of(max(groups, point_count() / (16u * kGroupSize)));
}

#endif
