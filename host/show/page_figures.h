// The tolerances that a page can be set to, and where the bounds of a face stand among them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/base/limit.h"
#include "host/survey/field.h"

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

/// The steps between which a face stands: from step `within` on it is proven within it, before step
/// `beyond` it is proven beyond it. So a byte or two give the proven verdict of a face at every
/// step.
struct FaceSteps {
  uint32_t within = 0;  ///< as many as there are steps: within none of them
  uint32_t beyond = 0;
};
FaceSteps steps_of(const Enclosure& face, const std::vector<Step>& steps);

}  // namespace vkh
