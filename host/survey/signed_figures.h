// Figures of sides, and the goal of limits that differ by side.
#pragma once

#include <vector>

#include "host/survey/goals.h"
#include "host/survey/sides.h"

namespace vkh {

/// The sides of the cells of a survey. They are found when they are asked for, and kept where a
/// split does not change them.
class SidedCells {
 public:
  explicit SidedCells(const SurveyedPair& pair);

  const Sides& sides() const { return sides_; }

  /// A cell scores if it may be beyond the limit of its side, or has none and may be beyond the
  /// smaller one. Met, too, as soon as some point is beyond.
  Scores score_limits(const CellStore& cells, const SidedLimits& limits);

  /// A cell without a side scores by its area, until a twentieth of A's is left that has none and
  /// is farther from B than a hundredth of the largest distance.
  Scores score_unsigned(const CellStore& cells, const Areas& areas);

  SignedFigures figures(const SurveyedArea& surface, const SurveyOptions& options) const;

 private:
  struct Known {
    CellSide side;
    gpu::uvec4 corners{};  ///< of the cell that was looked at
    bool is_known = false;
  };
  void look_at(const CellStore& cells, double above);

  SurveyedPair pair_;
  double ms_;  // the time that was spent on sides so far; it must be before sides_
  Sides sides_;
  std::vector<Known> known_;
};

}  // namespace vkh
