// Figures of sides, and the goal of limits that differ by side.
#pragma once

#include <vector>

#include "host/survey/goals.h"
#include "host/survey/sides.h"

namespace vkh {

/// The sides of the cells of a survey. They are found when they are asked for, once: they are kept
/// where a split does not change them.
class SidedCells {
 public:
  /// `goes_on` ends the search of sides: goals are then neither met nor nearer, and what was not
  /// looked at has no side, by Doubt::kEnded.
  SidedCells(const SurveyedPair& pair, GoesOn goes_on);

  const Sides& sides() const { return sides_; }

  /// A cell scores if it may be beyond the limit of its side, or has none and may be beyond the
  /// smaller one. Met, too, as soon as some point is beyond.
  Scores score_limits(const CellStore& cells, const SidedLimits& limits);

  /// A cell without a side scores by its area, until a twentieth of A's is left that has none and
  /// is farther from B than a hundredth of the largest distance.
  Scores score_unsigned(const CellStore& cells, const Areas& areas);

  /// A cell scores by its part of the width of the signed mean.
  Scores score_mean(const CellStore& cells, const Areas& areas, const SurveyOptions& options);

  /// A cell scores by its area that is undecided at the ends of signed percentiles that are too
  /// wide.
  Scores score_percentiles(const CellStore& cells, const Areas& areas,
                           const SurveyOptions& options);

  /// Finds the sides that are not known yet.
  SignedFigures figures(const SurveyedArea& surface, const SurveyOptions& options);

  /// The sides of all cells, in their order.
  std::vector<CellSide> of(const CellStore& cells);

 private:
  bool look_at(const CellStore& cells, double above);
  double enough(const Enclosure& figure, const Moments& plain, const SurveyOptions& options) const;
  void add_witnesses(const CellStore& cells, const std::vector<CellSide>& sides,
                     SignedFigures& figures) const;

  SurveyedPair pair_;
  double diagonal_;  // A's, in the frame
  double ms_;        // the time that was spent on sides so far; it must be before sides_
  Sides sides_;
  KnownSides known_;
  std::vector<Enclosure> percentiles_;  // of the signed distance, as far as they are known
};

/// The goals of signed figures, in their order, as goals_of() has those of plain ones.
void add_signed_goals(SidedCells& sided, const SurveyOptions& options, const Areas& areas,
                      std::vector<Goal>& goals);

}  // namespace vkh
