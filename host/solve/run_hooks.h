// Callbacks that the library gives a run besides its options: a survey of the pair, and a known
// lower bound that rises meanwhile.
#pragma once

#include "host/solve/cells.h"
#include "vkhausdorff/solver.h"

namespace vkh {

/// Any may be empty.
struct RunHooks {
  /// Called once, on the thread that runs, when the run has ended; with a limit there may be two.
  Survey survey = {};
  /// Asked between submissions, on the thread that runs: a known_lower that has risen since, such
  /// as what other devices found. How much is pruned then depends on when it rises.
  std::function<double()> known_since = {};
};

/// Encloses h(a, b), as Solver::distances does for one pair.
Report distance_with(Solver& solver, const PairView& pair, const SolveOptions& options,
                     const RunHooks& hooks);

/// Calls `use` once while the pair lies on the device, to bound cells of A. Before that it makes
/// one wave. Takes switches, memory and progress from `options`, and neither limits nor budgets.
void with_cells(Solver& solver, const PairView& pair, const SolveOptions& options,
                const Survey& use);

}  // namespace vkh
