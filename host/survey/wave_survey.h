// A survey by waves: cells stay on the device, where each wave scores them, splits the most
// important ones, bounds their parts and adds up all cells' figures. The host reads a table and
// plans.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "host/survey/area_figures.h"
#include "host/survey/area_table.h"
#include "host/survey/point_distances.h"
#include "host/survey/shares_seen.h"
#include "host/survey/survey_meter.h"
#include "host/survey/wave_goals.h"

namespace vkh {

/// The cells that hold `part` of all scores, the largest first, and `most` at most; `counts`: cells
/// of each bin. They follow from the counts alone.
SurveyChoice choose_cells(std::span<const uint32_t> counts, double part, size_t most);

class WaveSurvey : public AreaDistances {
 public:
  /// Bounds all faces of A, or its points. No distance is above `farthest`, in the frame. All
  /// arguments outlive it; pair.cells is there.
  WaveSurvey(const SurveyedPair& pair, const Areas& areas, SurveyMeter& meter, float farthest);

  /// Refines until the goals are met, or cannot be, by `effort` bounded cells at most since the
  /// survey began.
  SurveyEnd refine(WaveGoals& goals, size_t effort) { return refine(goals, effort, *this); }
  /// The same for goals about another distribution, such as that of signed distances.
  SurveyEnd refine(WaveGoals& goals, size_t effort, AreaDistances& distances);
  /// Looks at all cells for the goals, and splits none.
  void look(WaveGoals& goals, AreaDistances& distances);
  /// Finds the sides of all cells that are farther than `above` somewhere, in the frame, and from
  /// now on of new cells, too. Returns whether it was not ended. The search's data outlive it.
  bool find_sides(const SideSearch& search, double above);
  /// From now on new cells get no side, and the search is not used any more.
  void end_sides() { sides_.reset(); }
  /// Compares normals on all cells, which lose their sides, and on new cells from now on. Returns
  /// whether it was not ended. The search's data live until end_normals().
  bool find_normals(const NormalSearch& search);
  void end_normals() { has_normals_ = false; }
  /// Measures points of A that matter, at most `most`.
  PointDistances::Measured measure(const PointDistances::Asked& asked, size_t most);

  size_t count() const { return cells_.count(); }
  /// Returns, for each face, a distance that some point reaches, and then, for each, one that no
  /// point exceeds.
  const std::vector<float>& faces();
  /// The same for the cells of each face in one set of classes, and in the other.
  std::vector<float> faces(uint32_t reached_classes, uint32_t highest_classes);
  CellsRead read(const CellRange& some);
  /// An upper bound of all distances, in the frame.
  double farthest() const { return std::ldexp(1.0, unit_ - 127); }

  /// Returns the results of earlier tallies once the caller has called the survey off.
  Tallied tally(const Tally& asked) override;
  /// Tallies the cells of some classes, unless the caller has called the survey off.
  std::optional<Tallied> tally_now(const Tally& asked);
  /// Does so even then, for the figures of sides, which have few other bounds.
  Tallied tally_anyway(const Tally& asked);
  std::vector<Enclosure> percentiles(const PercentileSearch& search) override;
  double reached() override { return largest(0); }
  double highest() override { return largest(1); }

 private:
  bool bound_fresh(size_t count);
  bool split(WaveGoals& goals, size_t effort, SurveyEnd& ended);
  template <class GoesOn, class Look>
  bool go_over_cells(BatchSize& size, const GoesOn& goes_on, const Look& look);
  template <class Look>
  bool look_at_cells(bool may_end, const Look& look);
  bool score(const gpu::SurveyPlan& plan);
  bool add_up(const gpu::SurveyPlan& plan, int unit, bool may_end);
  std::optional<Tallied> tally_now(const Tally& asked, bool may_end);
  bool find_fresh_sides();
  bool find_fresh_normals();
  double largest(size_t which);

  const SurveyedPair& pair_;
  SurveyCells& cells_;
  const AreaWeights weights_;
  SurveyMeter& meter_;
  const int unit_;
  size_t spent_ = 0;
  std::vector<uint32_t> counts_;  // of the last score's bins
  gpu::SurveyTable table_;        // of the last tally
  SharesSeen shares_;
  Tallied seen_;  // all but shares
  std::optional<SideSearch> sides_;
  float sides_above_ = 0;
  bool has_normals_ = false;
  std::optional<PointDistances> distances_;
  std::vector<float> faces_;  // none until they are asked for
};

}  // namespace vkh
