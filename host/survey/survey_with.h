// A survey of a pair that lies on the device.
#pragma once

#include "host/solve/held_pairs.h"
#include "vkhausdorff/survey.h"

namespace vkh {

/// For hold_pair(): surveys the pair and writes `result`. Both must outlive it. Throws what
/// survey_mesh() names.
UsePair survey_with(const SurveyOptions& options, SurveyResult& result);

}  // namespace vkh
