// The tolerances that a page can be set to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vkhausdorff/limit.h"

namespace vkh {

/// A tolerance that people can read: few digits, or the limit that was asked about.
struct Step {
  double value = 0;
  Limit limit;
  std::string label;       ///< without the unit
  bool is_linear = false;  ///< one of the steps that are evenly apart
  bool is_log = false;     ///< one of the steps with even ratios
};

/// Returns steps that ascend from 0 to at least `top`, the largest distance to be shown: evenly up
/// to `fine` (at most `top`), then by even ratios.
std::vector<Step> tolerance_steps(double top, double fine, const std::optional<Limit>& asked);

}  // namespace vkh
