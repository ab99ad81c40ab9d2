// The figures and the worst places of an answer as comma-separated values (RFC 4180).
#pragma once

#include <string>

#include "host/show/draw_answer.h"

namespace vkh {

/// One row per figure of each direction: from, figure, estimate, lower, upper, unit. Bounds have
/// the digits that JSON has, rounded outward; an end or an estimate that is not known is empty. The
/// unit of a share is 1. Throws OutputError if nothing was surveyed.
std::string figures_csv(const Measured& measured);

/// One row per worst place of each direction, as pictures and pages have them: from,
/// place, x, y, z, deviation, lower, upper, face, unit. The deviation is estimated, and negative
/// where it is proven to be under the other surface. `lower` and `upper` enclose the distance of
/// the point without a sign; of places by faces, the largest distance over the face. Throws
/// OutputError if nothing was surveyed.
std::string points_csv(const Measured& measured);

}  // namespace vkh
