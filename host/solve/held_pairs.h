// Pairs that lie on the device while a caller bounds cells of their A, and a run whose known lower
// bound rises meanwhile.
#pragma once

#include <functional>
#include <span>

#include "host/solve/cells.h"
#include "vkhausdorff/solver.h"

namespace vkh {

/// Lays pairs on the device, all at once, and calls `use` while they lie there. No distance is
/// searched, but that each run makes its first wave. `use` is not called if options.progress says
/// no before. Takes switches, memory and progress from `options`, and neither limits nor budgets.
void hold_pairs(Solver& solver, std::span<const PairView> pairs, const SolveOptions& options,
                const UsePairs& use);
/// The same for one pair.
void hold_pair(Solver& solver, const PairView& pair, const SolveOptions& options,
               const UsePair& use);

/// Encloses h(a, b), as Solver::distances does for one pair. `known_since` is asked between
/// submissions, on the thread that runs: a known_lower that has risen since, such as what other
/// devices found. How much is pruned then depends on when it rises.
Report distance_since(Solver& solver, const PairView& pair, const SolveOptions& options,
                      const std::function<double()>& known_since);

}  // namespace vkh
