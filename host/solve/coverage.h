// Whether a run lost any part of A: sums that the device kept as integers.
#pragma once

#include <cstdint>
#include <span>

#include "host/solve/report.h"

namespace vkh {

/// `areas`: of each face of A the closed part, then of each the open one, in units of 2^-40.
/// `bounded`: whether the run claims an upper bound, for which no face may be waiting.
CoverageCheck check_coverage(std::span<const uint64_t> areas, bool bounded);

}  // namespace vkh
