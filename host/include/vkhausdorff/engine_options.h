// The parts of the method that are on, and more that benchmarks and tests set. The defaults are
// what pays. Only `certified` changes what an interval says.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vkhausdorff/needs_cpp20.h"

namespace vkh {

struct EngineOptions {
  std::string preset = {};  ///< see preset_names(); empty: default
  std::vector<std::string> enabled =
      {};  ///< names of further switches to turn on, see switch_names()
  std::vector<std::string> disabled = {};  ///< names of switches to turn off
  /// Takes the pipelines of a fine tolerance (VKH_CONTEXT_FINE) for any tolerance: the runs of one
  /// question would otherwise create two sets.
  bool fine = false;
  /// Takes the pipelines that a survey needs (VKH_CONTEXT_CELLS), so that a survey of the same pair
  /// creates none.
  bool cells = false;
  /// Takes the pipelines that Solver::closest() needs (VKH_CONTEXT_CLOSEST), for the same reason.
  bool closest = false;
  bool coverage = false;  ///< add up what was closed of each face of A: Report::coverage_check
  /// false: only the BVH and the solution are timed, as Times has them. Each timestamp between
  /// stages waits for what precedes it; on an H200 the timestamps cost 2 % in all.
  bool stage_times = true;

  // For benchmarks and tests alone.
  /// The bytes of the workspace to begin with, if SolveOptions::memory_bytes is 0; 0: chosen.
  uint64_t start_memory_bytes = 0;
  /// With `sort`: smaller frontiers are not sorted; 0: as was measured to pay.
  uint32_t sort_from = 0;
  /// false: bounds in plain floats, and a report without a guarantee, to measure what the
  /// certificate costs.
  bool certified = true;
};

/// The names that `enabled` and `disabled` accept.
std::vector<std::string> switch_names();
/// "default": what pays on the device. "paper": exactly what the paper's method has.
/// "baseline-gpu": the paper's baseline, which is its cascade of bounds without its optimisations.
std::vector<std::string> preset_names();

}  // namespace vkh
