// Reports of A's parts as one of A.
#pragma once

#include <span>

#include "host/solve/report.h"

namespace vkh {

/// Lower the largest, with its witness; upper the largest: comparisons alone, so nothing is
/// rounded. Work is added up, times that run side by side are the longest. The status is that of
/// the first part, and joined_status() the whole's. There is at least one part.
Report joined_report(std::span<const Report> parts);

/// Closed where the whole interval meets the tolerance, whatever ended its parts. Else what ended
/// one that is open, a caller's wish before a budget; kPruned by whole.known_lower alone.
Status joined_status(const Report& whole, std::span<const Report> parts);

/// Of two runs of the same part: both intervals are true.
Report narrowed(const Report& first, Report second);

}  // namespace vkh
