#include "host/job/survey_wish.h"

#include <algorithm>

namespace vkh {
namespace {

constexpr double kSeconds = 10;       // where --time leaves so many
constexpr double kPartOfTime = 0.85;  // adding up, and the outputs, need the rest

double resolved(const Length& length, const char* option, const Answer& answer) {
  return in_files(length, option, answer.unit, answer.a_to_b.diagonal_a).within;
}

}  // namespace

SurveyOptions survey_options(const SurveyWish& wish, const Answer& answer, const Stop& stop) {
  SurveyOptions options;
  options.faces = wish.faces;
  if (wish.face_tolerance)
    options.field_tolerance = resolved(*wish.face_tolerance, "--field-tol", answer);
  if (answer.max) options.limit = answer.max->limit;
  options.statistics = wish.statistics || wish.area;
  // Those of the limit come first: a share of area is told from them.
  if (wish.area) options.bands = {answer.max->limit.within, answer.max->limit.beyond};
  for (const Length& band : wish.bands) options.bands.push_back(resolved(band, "--bands", answer));
  if (wish.statistics && !wish.area && answer.max)
    options.bands.push_back(answer.max->limit.within);
  options.enough = wish.area;
  if (!wish.statistics) options.percentiles.clear();
  if (!wish.statistics) options.mean_tolerance = 1;  // a share of area is all that is asked
  options.time_limit_s = std::clamp(kPartOfTime * stop.left_s(), 1e-3, kSeconds);
  return options;
}

}  // namespace vkh
