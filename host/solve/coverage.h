// Checks whether a run lost any part of A, by sums that the device kept as integers.
#pragma once

#include <cstdint>
#include <span>

#include "vkhausdorff/report.h"

namespace vkh {

/// `areas`: the closed part of each face of A, then the open part of each, in units of 2^-40.
/// `bounded`: whether the run claims an upper bound, for which no face may be waiting.
CoverageCheck check_coverage(std::span<const uint64_t> areas, bool bounded);

}  // namespace vkh
