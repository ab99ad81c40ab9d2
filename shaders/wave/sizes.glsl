// The sizes of a wave's indirect dispatches, each under the need of its stage (engine/stages.h).
// The kernel declares `control`, `sizes`.
#ifndef VKH_SHADERS_WAVE_SIZES_GLSL
#define VKH_SHADERS_WAVE_SIZES_GLSL

#include "shaders/wave/dispatch.glsl"
#include "shaders/bvh/sort.glsl"

// Workgroups of the sort's scan: none if blocks are few.
Dispatch groups_for_digits(uint keys) {
  return groups_of(sort_blocks(keys) > kSortFewBlocks ? kSortDigits : 0u);
}

// Workgroups of query, for the new points of a wave; if the wave is fused, for the candidates that
// it holds.
Dispatch groups_for_new_points(uint held, uint queries) {
  bool splits = is_fused() && control.measuring == 0u;
  return splits ? groups_for_splits(held) : groups_for_queries(queries);
}

// `parents`: candidates that are refined; `held`: these and the candidates that wait; `keys`:
// candidates to sort, or 0.
void write_refine_sizes(uint parents, uint held, uint keys) {
  keys = control.sorted != 0u ? keys : 0u;
  uint packets = asks_in_packets(parents) ? parents : 0u;
  uint queries = packets > 0u ? 0u : points_each() * parents;
  if (control.measuring != 0u) queries = 1u;
  if (sorts_frontier()) sizes.sort_keys = groups_for(keys);
  if (sorts_frontier()) sizes.sort_blocks = groups_of(sort_blocks(keys));
  if (sorts_frontier()) sizes.sort_digits = groups_for_digits(keys);
  if (sorts_frontier()) sizes.sorted = groups_for(held * split_lanes());
  if (splits_apart()) sizes.subdivide = groups_for(held * split_lanes());
  if (packs_points()) sizes.packet = groups_for(packets);
  if (always()) sizes.query_points = groups_for_new_points(held, queries);
}

// There are none after the end; otherwise one workgroup even if there is no child: the last one
// plans.
Dispatch groups_to_bound(uint children, bool running) {
  return running ? groups_for_children(children) : groups_of(0u);
}

// Writes the workgroups of the kernel that bounds `children` children, after the filter if there is
// one.
void write_bound_sizes(uint children, bool running) {
  if (asks_centroids()) sizes.query_centroids = groups_for_queries(children);
  if (bisects()) sizes.bisect = groups_for(children);
  if (bounds_besides()) sizes.bound_besides = groups_to_bound(children, running);
  if (bounds_plainly()) sizes.bound = groups_to_bound(children, running);
}

// Workgroups of all kernels that a wave's children go through. The survivors of a filter are
// counted later (wave_survivors).
void write_child_sizes(uint children, bool running) {
  if (is_filtered()) sizes.filter_all = groups_for(children);
  if (!is_filtered()) write_bound_sizes(children, running);
}

#endif
