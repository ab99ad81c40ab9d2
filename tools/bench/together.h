// vkh_bench --together N: pairs in groups of N like sizes, each alone and then all side by side
// (Solver::distances), in turn; one CSV row a group.
#pragma once

#include "host/solve/solver.h"
#include "tools/bench/manifest.h"

namespace vkh::bench {

struct Groups {
  size_t size;  ///< pairs a group, of one family
  int repeat;
};

/// How many reports differ by a bit between a pair alone and beside others, or did not close.
int run_together(Solver& solver, const std::vector<Row>& rows, const Groups& groups,
                 SolveOptions options);

}  // namespace vkh::bench
