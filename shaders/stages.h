// The stages of a wave, one per line, in the order in which they run. These lines determine the
// recorded commands (engine/wave.cpp), the pipelines that a context creates (engine/kernels.cpp),
// the sizes that the plan writes (wave/sizes.glsl) and the columns of times (vkh_bench). A new
// stage is its kernel and a line here.
//
//   SIZED(kernel, given, size, needed, column, groups)   an indirect dispatch
//   ALONE(kernel, given, needed, column)                 one workgroup
//
// kernel: its type in C++. given: the buffers and push constants that engine/wave.cpp has for it.
// size: its name in WaveSizes. needed: one of the predicates below. column: of the times. groups:
// the workgroups, from the wave's counts in wave/sizes.glsl.
#ifndef VKH_SHADERS_STAGES_H
#define VKH_SHADERS_STAGES_H

#include "shaders/gpu_types.h"

// The needs of the switches and of the kind of device, stated once for both languages. In GLSL
// kSwitches and kWide are specialisation constants (base/switches.glsl).
#ifdef __cplusplus
namespace vkh::gpu {
#define VKH_PREDICATE(name, condition)                                                \
  constexpr bool name([[maybe_unused]] uint kSwitches, [[maybe_unused]] bool kWide) { \
    return condition;                                                                 \
  }
#else
#define VKH_PREDICATE(name, condition) \
  bool name() { return condition; }
#endif

VKH_PREDICATE(always, true)
// Whether a wave is two dispatches: `query` splits the candidates whose new points it queries, and
// the last workgroup of wave_bound plans the next wave. Otherwise separate kernels do both.
VKH_PREDICATE(is_fused, kWide && (kSwitches & kUseApart) == 0u)
VKH_PREDICATE(is_apart, !kWide || (kSwitches & kUseApart) != 0u)
VKH_PREDICATE(is_filtered, (kSwitches & kUseFilter) != 0u)
VKH_PREDICATE(asks_centroids, (kSwitches & kUseCentroid) != 0u)
VKH_PREDICATE(covers_area, (kSwitches & kUseCoverage) != 0u)
VKH_PREDICATE(bounds_cells, (kSwitches & kUseField) != 0u)
VKH_PREDICATE(has_subroots, (kSwitches & kUseSubroots) != 0u)
VKH_PREDICATE(finds_closest, (kSwitches & kUseClosest) != 0u)
VKH_PREDICATE(checks_input, (kSwitches & kUseInputCheck) != 0u)
// Whether a whole workgroup may traverse for one query.
VKH_PREDICATE(traverses_by_group, kWide && (kSwitches & kUseGroupWalk) != 0u)
VKH_PREDICATE(splits_apart,
              (kSwitches & kUseSort) == 0u && (!kWide || (kSwitches & kUseApart) != 0u))
VKH_PREDICATE(bounds_plainly, (kSwitches & kUseBesides) == 0u)
// Predicates of the paper's presets.
VKH_PREDICATE(sorts_frontier, (kSwitches & kUseSort) != 0u)
VKH_PREDICATE(packs_points, (kSwitches & kUsePacket) != 0u)
VKH_PREDICATE(bisects, (kSwitches & kUsePaperU3) != 0u)
VKH_PREDICATE(bounds_besides, (kSwitches & kUseBesides) != 0u)

// The stage that orders the frontier for refinement, for sizes and times only. engine/paper.cpp
// records the sort, whose passes repeat, and engine/kernels.cpp names WaveSort.
#define VKH_ORDER_STAGES(SIZED)                                                            \
  SIZED(WaveSort, wave, sort_keys, sorts_frontier, order, groups_for(keys))                \
  SIZED(SortCount, wave, sort_blocks, sorts_frontier, order, groups_of(sort_blocks(keys))) \
  SIZED(SortScan, wave, sort_digits, sorts_frontier, order, groups_for_digits(keys))

// The refined candidates, and their new points.
#define VKH_REFINE_STAGES(SIZED)                                                                  \
  SIZED(PaperSubdivide, wave, sorted, sorts_frontier, subdivide, groups_for(held* split_lanes())) \
  SIZED(WaveSubdivide, wave, subdivide, splits_apart, subdivide, groups_for(held* split_lanes())) \
  SIZED(WavePacket, wave, packet, packs_points, query, groups_for(packets))                       \
  SIZED(Query, points, query_points, always, query, groups_for_new_points(held, queries))

// The cheap bounds of all children, if more follows for those that they leave.
#define VKH_FILTER_STAGES(SIZED, ALONE)                                          \
  SIZED(WaveFilter, wave, filter_all, is_filtered, filter, groups_for(children)) \
  ALONE(WaveSurvivors, wave, is_filtered, filter)

// The bounds of all children, or of those past the filter, and the plan of the next wave.
#define VKH_BOUND_STAGES(SIZED, ALONE)                                                          \
  SIZED(Query, centroids, query_centroids, asks_centroids, query, groups_for_queries(children)) \
  SIZED(WaveBisect, wave, bisect, bisects, bound, groups_for(children))                         \
  SIZED(PaperBound, wave, bound_besides, bounds_besides, bound,                                 \
        groups_to_bound(children, running))                                                     \
  SIZED(WaveBound, wave, bound, bounds_plainly, bound, groups_to_bound(children, running))      \
  ALONE(WavePlan, wave, is_apart, plan)

// The sizes of a wave's indirect dispatches.
#define VKH_SIZE_MEMBER(kernel, given, size, needed, column, groups) Dispatch size;
#define VKH_NO_SIZE(kernel, given, needed, column)
struct WaveSizes {
  VKH_ORDER_STAGES(VKH_SIZE_MEMBER)
  VKH_REFINE_STAGES(VKH_SIZE_MEMBER)
  VKH_FILTER_STAGES(VKH_SIZE_MEMBER, VKH_NO_SIZE)
  VKH_BOUND_STAGES(VKH_SIZE_MEMBER, VKH_NO_SIZE)
};

#ifdef __cplusplus
}
#endif
#endif
