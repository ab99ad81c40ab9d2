// Cells that the host holds are refined for a goal at a time: for normals. For all else they are
// refined where they are: wave_survey.h.
#pragma once

#include <span>
#include <vector>

#include "host/survey/goals.h"
#include "host/survey/survey_meter.h"

namespace vkh {

/// Bounds cells in batches, until time or the caller ends it. How large batches are decides neither
/// the cells' numbers nor their bounds.
class Refining {
 public:
  /// Both outlive it.
  Refining(const SurveyedPair& pair, SurveyMeter& meter) : pair_(pair), meter_(meter) {}

  /// Refines for one goal after the other.
  SurveyEnd refine(CellStore& store, const std::vector<Goal>& goals);

 private:
  SurveyEnd refine_one(CellStore& store, const Goal& goal);
  void halve(CellStore& store, std::span<const size_t> which);
  template <class Work>
  void in_batches(size_t count, const Work& work);

  const SurveyedPair& pair_;
  SurveyMeter& meter_;
  std::vector<size_t> which_;  // cells of a batch
};

}  // namespace vkh
