// Figures of sides, from the cells of a survey by waves.
#pragma once

#include "host/survey/sides.h"
#include "host/survey/signed_distances.h"

namespace vkh {

/// The sides of the cells have been looked for. A has an area, if `areas` says so.
SignedFigures signed_figures(const SurveyedPair& pair, const Areas& areas,
                             const SurveyOptions& options, const Sides& sides,
                             SignedDistances& distances);

}  // namespace vkh
