// One question on several devices at once, with B on each. A's faces are dealt out, and each
// device's findings go to the others while they run. A search for closest points deals out the
// points instead.
#pragma once

#include <span>

#include "vkhausdorff/mesh.h"
#include "vkhausdorff/solver.h"

namespace vkh {

/// Encloses h(a, b). The Solvers are of devices of their own, as a rule; each has as large a part
/// of A's faces as the others, B and its BVH, and a thread. After each submission, the bound that
/// it has proven is a known lower bound to the others.
///   The interval is true, and closed where every part can be. How much is pruned depends on which
/// device is sooner, so its bits may differ from run to run; a single Solver's do not. Counts and
/// times of stages are sums, other times those of the slowest; waves are not listed.
///   A device that is lost, or has no memory for it, leaves its part to the others; the last one's
/// error is thrown, and nothing else is lost (Report::left_out). Budgets hold for each part;
/// options.progress is called from other threads, one at a time, about all of A, and may not use
/// these Solvers.
Report distance_over(std::span<Solver* const> solvers, const Mesh& a, const Mesh& b,
                     const SolveOptions& options = {});

/// Finds what Solver::closest finds for each of `points`: a device takes some of them at a time,
/// until none is left, on a thread of its own. A point's answer is that of the device that took it,
/// bit for bit. `goes_on` is called on the caller's thread with the number of points that are done,
/// and may not use these Solvers.
///   A device that is lost, or has no memory for it, leaves its points to the others; the last
/// one's error is thrown. Also throws what Solver::closest throws, and UsageError for no Solver.
ClosestPoints closest_over(std::span<Solver* const> solvers, const Mesh& b,
                           std::span<const DVec3> points, const ClosestGoesOn& goes_on = {});
/// Does the same with B prepared on each device: `prepared` has one for each Solver, in their
/// order.
ClosestPoints closest_over(std::span<Solver* const> solvers,
                           std::span<const PreparedMesh* const> prepared,
                           std::span<const DVec3> points, const ClosestGoesOn& goes_on = {});

}  // namespace vkh
