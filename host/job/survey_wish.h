// What is to be known of all of A besides its distance, before its meshes are.
#pragma once

#include <optional>
#include <vector>

#include "host/answer/answer.h"
#include "host/job/stop.h"

namespace vkh {

struct SurveyWish {
  bool faces = false;  ///< bounds of each: for a picture, or a file
  std::optional<Length> face_tolerance;
  bool statistics = false;
  std::vector<Length> bands;
  std::optional<double> area;  ///< gate: the share of A's area that is to be within the limit

  bool is_any() const { return faces || statistics || area; }
};

/// In the files' units, for as long as there is.
SurveyOptions survey_options(const SurveyWish& wish, const Answer& answer, const Stop& stop);

}  // namespace vkh
