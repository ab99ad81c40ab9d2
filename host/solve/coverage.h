// Checks whether a run lost any part of A, by sums that it kept as integers.
#pragma once

#include <cstdint>
#include <span>

#include "vkhausdorff/report.h"

namespace vkh {

/// `areas`: the closed part of each face of A, then the open part of each, in units of which a face
/// has `of_face`.
/// `bounded`: whether the run claims an upper bound, for which no face may be waiting.
CoverageCheck check_coverage(std::span<const uint64_t> areas, uint64_t of_face, bool bounded);

/// A whole face, in the units in which a device adds up areas.
inline constexpr uint64_t kDeviceArea = uint64_t{1} << 40;

}  // namespace vkh
