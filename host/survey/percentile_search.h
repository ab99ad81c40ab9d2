// The search for percentiles by tallies at distances that close in on them.
#pragma once

#include <functional>
#include <vector>

#include "host/survey/area_figures.h"
#include "host/survey/shares_seen.h"

namespace vkh {

/// Returns the bounds that earlier tallies gave for the percentile of a share.
using KnownEnds = std::function<SharesSeen::Ends(double share)>;

std::vector<Enclosure> percentiles_by(const PercentileSearch& search, const KnownEnds& known_ends,
                                      AreaDistances& distances);

}  // namespace vkh
