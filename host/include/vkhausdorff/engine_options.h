// The parts of the method that are on, and what benchmarks and tests set besides: the defaults are
// what pays. No member changes what an interval says, but for `certified`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vkhausdorff/needs_cpp20.h"

namespace vkh {

struct EngineOptions {
  std::string preset = {};                 ///< see preset_names(); empty: default
  std::vector<std::string> enabled = {};   ///< switch names, see switch_names(), on besides
  std::vector<std::string> disabled = {};  ///< switch names to take from those
  /// Takes the pipelines of a fine tolerance (VKH_CONTEXT_FINE), whatever the tolerance: for the
  /// runs of one question, which would otherwise create two sets.
  bool fine = false;
  /// Takes the pipelines that a survey needs (VKH_CONTEXT_CELLS), so that one of the same pair
  /// creates no others.
  bool cells = false;
  /// Takes the pipelines that Solver::closest() needs (VKH_CONTEXT_CLOSEST), for the same reason.
  bool closest = false;
  bool coverage = false;  ///< add up what was closed of each face of A: Report::coverage_check
  /// false: BVH and solution alone are timed, as Times has them; each timestamp between stages
  /// waits for what is before it, which all together costs an H200 2 %.
  bool stage_times = true;

  // For benchmarks and tests alone.
  /// The bytes of the workspace to begin with, if SolveOptions::memory_bytes is 0; 0: chosen.
  uint64_t start_memory_bytes = 0;
  /// With `sort`: smaller frontiers are not sorted; 0: as was measured to pay.
  uint32_t sort_from = 0;
  /// false: bounds in plain floats, a report that nothing vouches for: what the certificate costs.
  bool certified = true;
};

/// The names that `enabled` and `disabled` take.
std::vector<std::string> switch_names();
/// "default": what pays on the device. "paper": what the paper's method has and no more.
/// "baseline-gpu": the paper's baseline, its cascade of bounds with none of its optimisations.
std::vector<std::string> preset_names();

}  // namespace vkh
