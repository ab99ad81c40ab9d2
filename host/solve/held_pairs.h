// Pairs that lie on the device while a caller bounds cells of their A, and a run whose known lower
// bound rises meanwhile.
#pragma once

#include <functional>
#include <span>

#include "host/solve/cells.h"
#include "vkhausdorff/solver.h"

namespace vkh {

/// Uploads pairs to the device, all at once, and calls `use` while they are there. No distance is
/// searched beyond the first wave of each run. `use` is not called if options.progress returns
/// false before. Takes switches, memory and progress from `options`, and ignores limits and
/// budgets.
void hold_pairs(Solver& solver, std::span<const PairView> pairs, const SolveOptions& options,
                const UsePairs& use);
/// The same for one pair.
void hold_pair(Solver& solver, const PairView& pair, const SolveOptions& options,
               const UsePair& use);

/// Encloses h(a, b), as Solver::distances does for one pair. `known_since` is called between
/// submissions, on the running thread, and returns the current known lower bound, such as the one
/// that other devices found. How much is pruned then depends on when it rises.
Report distance_since(Solver& solver, const PairView& pair, const SolveOptions& options,
                      const std::function<double()>& known_since);

}  // namespace vkh
