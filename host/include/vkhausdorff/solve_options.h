// The budgets of a run, the width that it has to reach, and its progress callback.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "vkhausdorff/limit.h"

namespace vkh {

/// Handed to the progress callback between submissions.
struct Progress {
  uint32_t wave = 0;
  uint64_t candidates = 0;  ///< undecided now
  double lower = 0,
         upper = 0;   ///< in the files' units; upper is infinite before the first bounds exist
  double gap = 0;     ///< (upper - lower) / diag(A)
  bool back = false;  ///< true for h(B,A) in a symmetric run
  size_t pair = 0;    ///< index of the pair in Solver::distances; StreamPair::number in a stream
};

struct SurveyedPair;  // host/solve/cells.h
struct CellBatch;
/// Bounds cells of A; blocks until it is done.
using BoundCells = std::function<void(const CellBatch&)>;
/// Called once, on the thread that runs, while the pair still lies on the device.
using Survey = std::function<void(const SurveyedPair&, const BoundCells&)>;

struct SolveOptions {
  double tolerance = 1e-6;  ///< fraction of diag(A), or in the files' units if absolute
  bool tolerance_is_absolute = false;
  /// Takes the pipelines of a fine tolerance (VKH_CONTEXT_FINE), whatever the tolerance: for the
  /// runs of one question, which would otherwise create two sets.
  bool subroots = false;
  double time_limit_s = std::numeric_limits<double>::infinity();
  uint32_t wave_limit = std::numeric_limits<uint32_t>::max();
  /// The workspace; 0: chosen from the meshes, and a larger one if the run wants it and the device
  /// has it.
  uint64_t memory_bytes = 0;
  uint64_t start_memory_bytes = 0;    ///< to begin with, if memory_bytes is 0; 0: chosen
  std::string preset;                 ///< see preset_names(); empty: default
  std::vector<std::string> enabled;   ///< switch names, see switch_names(), besides the preset's
  std::vector<std::string> disabled;  ///< switch names to take from those
  uint32_t sort_from =
      0;  ///< with `sort`: smaller frontiers are not sorted; 0: as was measured to pay
  /// false: BVH and solution alone are timed, as Times has them; each timestamp between stages
  /// waits for what is before it, which all together costs an H200 2 %.
  bool stage_times = true;
  Survey survey;  ///< called for A's cells, after each run; with a limit there may be two. See
                  ///< Solver::with_cells
  bool coverage = false;  ///< add up what was closed of each face of A: Report::coverage_check
  /// false: bounds in plain floats, a report that nothing vouches for; for vkh_bench alone, which
  /// measures what the certificate costs.
  bool certified = true;
  std::function<bool(const Progress&)>
      progress;  ///< return false to cancel; the interval so far is returned. May throw: the run
                 ///< ends, the solver stays usable
  /// A distance that the answer need not resolve below, in the files' units; 0: none. Candidates
  /// within the tolerance of it are closed, and a run that this decides ends as Status::kPruned.
  double known_lower = 0;
  /// Asked between submissions, on the thread that runs: a known_lower that has risen since, such
  /// as what other devices found (host/include/vkhausdorff/together.h). How much is pruned then
  /// depends on when it rises. Empty: none.
  std::function<double()> known_since;
  /// Asks only whether the distance is within it: candidates within it are closed, and the run ends
  /// as soon as either answer is proven, as Status::kLimit (verdict_of). Neither is proven if the
  /// distance is within the tolerance of it, which is used where a coarser one does not decide.
  Limit limit = {};
};

/// The names that `enabled` and `disabled` take.
std::vector<std::string> switch_names();
/// "default": what pays on the device. "paper": what the paper's method has and no more.
/// "baseline-gpu": the paper's baseline, its cascade of bounds with none of its optimisations.
std::vector<std::string> preset_names();

}  // namespace vkh
