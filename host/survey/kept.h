// Figures of the part K of A that is within a distance D: the figures of all of A, divided by the
// share of K. The moments of d over K are the moments over A of a function that is d on K and 0
// elsewhere.
#pragma once

#include "host/survey/area_figures.h"

namespace vkh {

struct KeptPart {
  const FiguresAsked& asked;  ///< with max_distance
  const SurveyedPair& pair;
  Enclosure share;  ///< of A's area
  Moments moments;  ///< over A, of d on K and 0 elsewhere
};
/// Makes shares of A shares of K, and adds its moments and percentiles.
void keep_within(const KeptPart& part, AreaDistances& distances, Statistics& s);

}  // namespace vkh
