// Estimates of cells, for pictures and for the agreement of normals, from distances taken in double
// at a few points of each. They prove nothing, and are clamped to the proven interval, which moves
// none away from the truth.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/solve/cells.h"
#include "host/survey/statistics.h"
#include "host/survey/stoppable.h"

namespace vkh {

/// The distances of one cell, in the frame. Each lies within the cell's bounds.
struct CellEstimate {
  std::array<float, 3> corners{};
  float middle = 0;
  float mean = 0;  ///< of the distance over the cell
};

/// Estimates of all cells of a survey, in their order.
class Estimates {
 public:
  /// Takes the distance of each corner and of the middle from the faces of B that the cell's bounds
  /// name, which are closest there but for rounding, or nearly so. A coarse cell may not name them:
  /// it is measured from all faces. Once `goes_on` returns false, coarse cells are left as their
  /// bounds' faces tell.
  Estimates(const SurveyedPair& pair, const CellStore& cells, const GoesOn& goes_on = {});

  const CellEstimate& of(size_t cell) const { return of_cell_[cell]; }

 private:
  std::vector<CellEstimate> of_cell_;
};

}  // namespace vkh
