// The stages of a wave: when each is needed, and the column of its times. engine/wave.cpp records
// them in this order, engine/kernels.cpp creates their pipelines, and the benchmark's table reads
// them. The plan writes their sizes (shaders/wave/sizes.glsl).
#pragma once

#include <array>

#include "engine/kernels.h"
#include "engine/workspace.h"

namespace vkh {

// One of the predicates of shaders/stages.h.
using Need = bool (*)(uint32_t switches, bool wide);

struct Stage {
  uint32_t kernel;  // KernelIndex
  WaveSize size;    // null: one workgroup
  Need needed;
  const char* column;
};

// The sort has one kernel here, the only one that no build of a BVH needs: engine/paper.cpp records
// its passes.
inline constexpr std::array kStages{
    Stage{kIndexOfWaveSort, &gpu::WaveSizes::sort_keys, gpu::sorts_frontier, "order"},
    Stage{kIndexOfPaperSubdivide, &gpu::WaveSizes::sorted, gpu::sorts_frontier, "subdivide"},
    Stage{kIndexOfWaveSubdivide, &gpu::WaveSizes::subdivide, gpu::splits_apart, "subdivide"},
    Stage{kIndexOfWavePacket, &gpu::WaveSizes::packet, gpu::packs_points, "query"},
    Stage{kIndexOfQuery, &gpu::WaveSizes::query_points, gpu::always, "query"},
    Stage{kIndexOfWaveFilter, &gpu::WaveSizes::filter_all, gpu::is_filtered, "filter"},
    Stage{kIndexOfWaveSurvivors, nullptr, gpu::is_filtered, "filter"},
    Stage{kIndexOfQuery, &gpu::WaveSizes::query_centroids, gpu::asks_centroids, "query"},
    Stage{kIndexOfWaveBisect, &gpu::WaveSizes::bisect, gpu::bisects, "bound"},
    Stage{kIndexOfPaperBound, &gpu::WaveSizes::bound_besides, gpu::bounds_besides, "bound"},
    Stage{kIndexOfWaveBound, &gpu::WaveSizes::bound, gpu::bounds_plainly, "bound"},
    Stage{kIndexOfWavePlan, nullptr, gpu::is_apart, "plan"}};

// The stage of a kernel and a size. Used in constant expressions, where a missing stage does not
// compile.
constexpr const Stage& stage_of(uint32_t kernel, WaveSize size) {
  size_t at = 0;
  while (kStages.at(at).kernel != kernel || kStages.at(at).size != size) ++at;
  return kStages.at(at);
}

}  // namespace vkh
