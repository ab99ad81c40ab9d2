// Joins the reports of A's parts into one of A.
#pragma once

#include <span>

#include "vkhausdorff/report.h"

namespace vkh {

/// The lower bound is the largest one, with its witness, and the upper is the largest: comparisons
/// alone, so nothing is rounded. Work is added up; times that run side by side are the longest. The
/// status is that of the first part; joined_status() returns the whole's. There is at least one
/// part.
Report joined_report(std::span<const Report> parts);

/// Closed if the whole interval meets the tolerance, no matter what ended its parts. Otherwise the
/// status that ended an open part: a caller's wish comes before a budget, and only
/// whole.known_lower makes it kPruned.
Status joined_status(const Report& whole, std::span<const Report> parts);

/// Adds the counts of what bounds closed, by the bounds' names: another device may have other
/// bounds.
void add_culled(const std::vector<CullCount>& culled, std::vector<CullCount>& all);

/// Joins two runs of the same part: both intervals are true.
Report narrowed(const Report& first, Report second);

}  // namespace vkh
