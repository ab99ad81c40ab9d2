// The figures and the worst places of an answer as comma-separated values (RFC 4180).
#pragma once

#include <string>

#include "host/show/draw_answer.h"

namespace vkh {

/// One row per figure of each direction: from, figure, lower, upper, unit. Bounds have the digits
/// that JSON has, rounded outward; an end that is not known is empty. The unit of a share is 1.
/// Throws OutputError if nothing was surveyed.
std::string figures_csv(const Measured& measured);

/// One row per worst place of each direction, as the page lists them: from, place, x, y, z, lower,
/// upper, face, unit. `lower` and `upper` enclose the largest distance over the face, or of the
/// point where it is the farthest that was found. Throws OutputError if nothing was surveyed.
std::string points_csv(const Measured& measured);

}  // namespace vkh
