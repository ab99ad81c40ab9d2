// Solves one pair on several devices at once: A's faces are dealt out, B is on each, and each
// device's findings go to the others while they run.
#pragma once

#include <span>

#include "vkhausdorff/mesh.h"
#include "vkhausdorff/solver.h"

namespace vkh {

/// Encloses h(a, b). The Solvers are of devices of their own, as a rule; each has as large a part
/// of A's faces as the others, B and its BVH, and a thread. After each submission, the bound that
/// it has proven is a known lower bound to the others (SolveOptions::known_since).
///   The interval is true, and closed where every part can be. How much is pruned depends on which
/// device is sooner, so its bits may differ from run to run; a single Solver's do not. Counts and
/// times of stages are sums, other times those of the slowest; waves are not listed.
///   A device that is lost, or has no memory for it, leaves its part to the others; the last one's
/// error is thrown, and nothing else is lost (Report::left_out). Budgets hold for each part;
/// options.progress is called from other threads, one at a time, about all of A, and may not use
/// these Solvers; options.survey is called for each part.
Report distance_over(std::span<Solver* const> solvers, const Mesh& a, const Mesh& b,
                     const SolveOptions& options = {});

}  // namespace vkh
