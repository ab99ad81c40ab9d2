// Cells that the host holds are refined for a goal at a time: faces, maps, sides, normals, points.
// The figures of a surface are refined where the cells are: wave_survey.h.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/survey/goals.h"
#include "host/survey/point_distances.h"
#include "host/survey/survey_meter.h"

namespace vkh {

/// Bounds cells in batches, until time or the caller ends it. How large batches are decides neither
/// the cells' numbers nor their bounds.
class Refining {
 public:
  /// Both outlive it.
  Refining(const SurveyedPair& pair, SurveyMeter& meter) : pair_(pair), meter_(meter) {}

  /// Bounds whole faces.
  void bound_faces(CellStore& store);
  /// Refines for one goal after the other.
  SurveyEnd refine(CellStore& store, const std::vector<Goal>& goals);
  /// Refines for a picture, which may take half of the effort before figures, and what they leave
  /// after them.
  SurveyEnd refine_map(CellStore& store, const std::optional<Goal>& map, bool is_last);

 private:
  SurveyEnd refine(CellStore& store, const Goal& goal, size_t budget);
  void halve(CellStore& store, std::span<const size_t> which);
  void measure(CellStore& store, std::span<const size_t> which);
  size_t splits_left() const { return meter_.effort_left() / 2; }
  template <class Work>
  void in_batches(size_t count, const Work& work);

  const SurveyedPair& pair_;
  SurveyMeter& meter_;
  std::vector<size_t> which_;  // cells of a batch
  std::optional<PointDistances> distances_;
};

}  // namespace vkh
