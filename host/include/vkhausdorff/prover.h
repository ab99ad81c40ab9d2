// A proof of an upper bound: A in parts, each with what proves it. The device finds which faces of
// B are near a part; no proof rests on that.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "vkhausdorff/solver.h"

namespace vkh {

struct ProofJob {
  const Mesh &a, &b;
  const Report& report;         ///< from a run of these meshes: report.upper is the bound to prove
  const SolveOptions& options;  ///< options of that run
  /// Called between submissions with the number of leaves so far. After false, what is left gets
  /// the bound that can be proven at once, and the bound of the whole is larger.
  std::function<bool(size_t)> goes_on;
};

/// The proof of one direction.
struct Proof {
  double upper = 0;    ///< the bound that is proven; never less than the one that was asked for
  std::string blocks;  ///< docs/certificate-file.md
  size_t bytes = 0;    ///< the size of `blocks`, which JSON has without them
  size_t leaves = 0, cut_leaves = 0, asked_cells = 0;
  size_t unproven = 0;  ///< leaves that proved more than was asked: `upper` is larger for them
  double ms = 0;
};

/// Proves the bound in a run of its own.
Proof prove(Solver& solver, const ProofJob& job);

}  // namespace vkh
