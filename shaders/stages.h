// The needs of a wave's stages, and the sizes of its dispatches, for both languages. The stages
// themselves, in the order in which they run, are recorded by engine/wave.cpp; engine/stages.h has
// the need of each.
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
VKH_PREDICATE(has_subroots, (kSwitches & kUseSubroots) != 0u)
#ifdef __cplusplus
VKH_PREDICATE(bounds_cells, (kSwitches & kUseField) != 0u)
VKH_PREDICATE(finds_closest, (kSwitches & kUseClosest) != 0u)
VKH_PREDICATE(checks_input, (kSwitches & kUseInputCheck) != 0u)
#endif
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

// The sizes of a wave's indirect dispatches, in the order in which they run. The plan writes each
// that is needed (wave/sizes.glsl).
struct WaveSizes {
  // The order of the frontier, if sorts_frontier.
  Dispatch sort_keys;
  Dispatch sort_blocks;
  Dispatch sort_digits;
  // The refined candidates, and their new points.
  Dispatch sorted;
  Dispatch subdivide;
  Dispatch packet;
  Dispatch query_points;
  // The cheap bounds of all children, if there is a filter.
  Dispatch filter_all;
  // The bounds of all children, or of the children that the filter leaves.
  Dispatch query_centroids;
  Dispatch bisect;
  Dispatch bound_besides;
  Dispatch bound;
};

#ifdef __cplusplus
}
#endif
#endif
