// The ends of a search or a survey, in words, for first lines, tables and pages.
#pragma once

#include "vkhausdorff/report.h"
#include "vkhausdorff/survey.h"

namespace vkh {

struct EndWords {
  const char* reason;   ///< "the time budget ended"
  const char* hint;     ///< what decides more: "; ask for more --time"; null: the caller knows
  const char* on_page;  ///< "the time that was set is over"; null: a page does not warn of it
};

const EndWords& end_words(Status status);
const EndWords& end_words(SurveyEnd end);

}  // namespace vkh
