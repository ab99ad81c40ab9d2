// The budgets of a run, the width that it has to reach, and its progress callback.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

#include "vkhausdorff/engine_options.h"
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

struct SolveOptions {
  double tolerance = 1e-6;  ///< fraction of diag(A), or in the files' units if absolute
  bool tolerance_is_absolute = false;
  double time_limit_s = std::numeric_limits<double>::infinity();
  uint32_t wave_limit = std::numeric_limits<uint32_t>::max();
  /// The workspace; 0: chosen from the meshes, and a larger one if the run wants it and the device
  /// has it.
  uint64_t memory_bytes = 0;
  EngineOptions engine;
  /// Return false to cancel; the interval so far is returned. May throw: the run ends, the solver
  /// stays usable.
  std::function<bool(const Progress&)> progress = {};
  /// A distance that the answer need not resolve below, in the files' units; 0: none. Candidates
  /// within the tolerance of it are closed, and a run that this decides ends as Status::kPruned.
  double known_lower = 0;
  /// Asks only whether the distance is within it: candidates within it are closed, and the run ends
  /// as soon as either answer is proven, as Status::kLimit (verdict_of). Neither is proven if the
  /// distance is within the tolerance of it, which is used where a coarser one does not decide.
  Limit limit = {};
};

}  // namespace vkh
