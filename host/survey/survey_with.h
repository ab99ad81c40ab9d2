// A survey in the run that searches.
#pragma once

#include "host/solve/run_hooks.h"
#include "vkhausdorff/survey.h"

namespace vkh {

/// RunHooks::survey that writes `result` when the run has ended. Both must outlive it. Throws what
/// survey_mesh() names.
Survey survey_with(const SurveyOptions& options, SurveyResult& result);

}  // namespace vkh
