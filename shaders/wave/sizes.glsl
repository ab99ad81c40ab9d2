// The sizes of a wave's indirect dispatches, by the lines of stages.h. The kernel declares
// `control`, `sizes`.
#ifndef VKH_SHADERS_WAVE_SIZES_GLSL
#define VKH_SHADERS_WAVE_SIZES_GLSL

#include "shaders/wave/dispatch.glsl"
#include "shaders/bvh/sort.glsl"

#define VKH_WRITE_SIZE(kernel, given, size, needed, column, groups) \
  if (needed()) sizes.size = groups;

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

// `parents` candidates are refined, `held` counts those that wait, too, `keys` are sorted if any
// are.
void write_refine_sizes(uint parents, uint held, uint keys) {
  keys = control.sorted != 0u ? keys : 0u;
  uint packets = asks_in_packets(parents) ? parents : 0u;
  uint queries = packets > 0u ? 0u : points_each() * parents;
  if (control.measuring != 0u) queries = 1u;
  VKH_ORDER_STAGES(VKH_WRITE_SIZE)
  VKH_REFINE_STAGES(VKH_WRITE_SIZE)
}

// There are none after the end; otherwise one workgroup even if there is no child: the last one
// plans.
Dispatch groups_to_bound(uint children, bool running) {
  return running ? groups_for_children(children) : groups_of(0u);
}

// Workgroups of the kernel that bounds so many children, behind the filter if there is one.
void write_bound_sizes(uint children, bool running) {
  VKH_BOUND_STAGES(VKH_WRITE_SIZE, VKH_NO_SIZE)
}

// Workgroups of all kernels that a wave's children go through. The survivors of a filter are
// counted later (wave_survivors).
void write_child_sizes(uint children, bool running) {
  VKH_FILTER_STAGES(VKH_WRITE_SIZE, VKH_NO_SIZE)
  if (!is_filtered()) write_bound_sizes(children, running);
}

#endif
