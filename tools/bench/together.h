// vkh_bench --together N: pairs in groups of N like sizes, each alone and then all side by side
// (Solver::distances), alternately; one CSV row per group. Then runs all of them through a
// PairStream, pass after pass, and prints what a pass takes when the host's work for one group runs
// beside another's waves.
#pragma once

#include "tools/bench/manifest.h"
#include "vkhausdorff/solver.h"

namespace vkh::bench {

struct Groups {
  size_t size;  ///< pairs per group, of one family
  int repeat;
};

/// The number of reports that differ by a bit between a pair alone and beside others, or did not
/// close.
int run_together(Solver& solver, const std::vector<Row>& rows, const Groups& groups,
                 SolveOptions options);

/// Prints the wall time of a pass of all pairs through a stream, `groups.size` a submission, from
/// the end of a first pass. `device` is StreamOptions' selector.
void run_stream(const std::string& device, const std::vector<Row>& rows, const Groups& groups,
                const SolveOptions& options);

}  // namespace vkh::bench
