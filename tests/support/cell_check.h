// Compares a device's bounds of cells with closest points in double precision.
#pragma once

#include <cstdint>
#include <span>

#include "host/solve/cells.h"
#include "tests/verification/oracle/closest.h"

namespace vkh::test {

struct CellTally {
  uint64_t cells = 0, samples = 0;
  uint64_t below = 0;    ///< a lower bound above the distance
  uint64_t above = 0;    ///< an upper bound below it
  uint64_t means = 0;    ///< a mean, or mean square, outside of its bounds
  uint64_t reached = 0;  ///< no point of the cell is so far

  void add(const CellTally& other) {
    cells += other.cells;
    samples += other.samples;
    below += other.below;
    above += other.above;
    means += other.means;
    reached += other.reached;
  }
  uint64_t wrong() const { return below + above + means + reached; }
};

/// Bounds random cells of A's faces, of every size, and measures points of each: corners, on
/// edges, inside. `b`: the other mesh, as given.
class CellCheck {
 public:
  CellCheck(const SurveyedPair& pair, const Mesh& b);
  void check(const BoundCells& bound, uint64_t seed, size_t count, CellTally& tally) const;
  /// Checks these cells, too.
  void check(std::span<const gpu::Cell> cells, std::span<const gpu::CellBounds> bounds,
             uint64_t seed, CellTally& tally) const;

 private:
  struct Placed;
  double distance(const glm::dvec3& p) const;
  void check_one(const Placed& cell, uint64_t seed, CellTally& tally) const;
  void check_means(const Placed& cell, CellTally& tally) const;

  const SurveyedPair& pair_;
  Mesh a_;  // both in the frame's units, about the files' origin
  ClosestTree tree_;
  double margin_;  // of double precision
};

}  // namespace vkh::test
