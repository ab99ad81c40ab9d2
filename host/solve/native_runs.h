// The runs of a Solver without a device: h(A,B), and cells of A, in doubles on the processor
// (host/native).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/solve/cells.h"
#include "host/solve/closest_search.h"
#include "host/solve/pair.h"
#include "vkhausdorff/solver.h"

namespace vkh {

/// Throws UsageError, which says that only a device does `what`.
[[noreturn]] void refuse_natively(const std::string& what);
/// Refuses pipelines that only devices have: presets, switches.
void check_native(const EngineOptions& options);

/// Threads may share it.
class NativeRuns {
 public:
  explicit NativeRuns(const NativeProcessor& processor)
      : processor_(processor), description_(describe(processor)) {}

  const DeviceDescription& description() const { return description_; }
  /// Does one pair after the other. `options`: one for each.
  std::vector<Report> distances(std::span<const PairView> pairs,
                                const std::vector<SolveOptions>& options) const;

  /// Stores B in its own frame, for closest points.
  KeptMesh kept(Mesh b) const;
  ClosestPoints closest(const KeptMesh& b, const ClosestQuestion& question) const;

  /// As hold_pairs() does. `options`: one for each pair.
  void hold(std::span<const PairView> pairs, const std::vector<SolveOptions>& options,
            const UsePairs& use) const;

 private:
  Report distance(const PairView& pair, const SolveOptions& options, size_t number) const;

  NativeProcessor processor_;
  DeviceDescription description_;
};

}  // namespace vkh
