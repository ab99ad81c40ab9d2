// Estimates of A's figures, from distances taken in double at a few points of each cell. They prove
// nothing, and are clamped to the proven interval, which moves none away from the truth.
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
  float mean = 0, square = 0;  ///< of the distance over the cell, and of its square
};

/// Estimates of all cells of a survey, in their order.
class Estimates {
 public:
  /// Takes the distance of each corner and of the middle from the faces of B that the cell's bounds
  /// name, which are closest there but for rounding, or nearly so. A coarse cell may not name them:
  /// it is measured from all faces. Where estimates serve the shares within `served` alone, and
  /// each has all of a cell or none, it is not measured. Once `goes_on` returns false, coarse cells
  /// are left as their bounds' faces tell.
  Estimates(const SurveyedPair& pair, const CellStore& cells, const Areas& areas,
            std::vector<Threshold> served = {}, const GoesOn& goes_on = {});

  /// Returns whether these are estimates for all figures, not for some shares alone.
  bool serve_all() const { return served_.empty(); }
  const CellEstimate& of(size_t cell) const { return of_cell_[cell]; }
  double mean() const;
  double rms() const;
  /// The shares of A's area within distances that ascend: affine between the middle of a cell and
  /// each two corners.
  std::vector<double> shares_within(std::span<const double> ascending) const;
  /// The least distance that each share of A's area is within; each is sought in its enclosure, and
  /// in the frame.
  std::vector<double> percentiles(std::span<const double> shares,
                                  std::span<const Enclosure> known) const;

 private:
  double area_of(size_t cell) const;
  /// Returns whether an estimate of the cell can move a figure.
  bool matters(size_t cell) const;

  const CellStore& cells_;
  const Areas& areas_;
  const std::vector<Threshold> served_;
  std::vector<CellEstimate> of_cell_;
};

/// Adds to each figure that the estimates serve, and to the share at each distance, what it
/// probably is. `percentiles`: the enclosures of the percentiles, in the frame.
void add_estimates(const Estimates& estimates, const SurveyedPair& pair,
                   std::span<const Enclosure> percentiles, Statistics& statistics);

}  // namespace vkh
