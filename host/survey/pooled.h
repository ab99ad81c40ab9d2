// Two surfaces as one: the share of their area within a distance is w F_A + (1 - w) F_B, with
// w = a_A / (a_A + a_B).
#pragma once

#include <functional>
#include <vector>

#include "host/survey/distribution.h"
#include "host/survey/goals.h"

namespace vkh {

/// The shares of one surface's area within distances in the files' units, which ascend.
using SharesWithin = std::function<std::vector<Enclosure>(const std::vector<double>&)>;

/// One surface of two.
struct PooledPart {
  SharesWithin shares;
  Enclosure area;
};
PooledPart part_of(const Distribution& distribution);

/// The least distance that `share` of both surfaces' area is within. `known` encloses it.
Enclosure pooled_percentile(const PooledPart& a, const PooledPart& b, double share,
                            const Enclosure& known);

/// Whether an enclosure of that percentile that is wider than `enough` stays so at any effort:
/// nearly no area lies between its ends.
bool is_pooled_jump(const PooledPart& a, const PooledPart& b, const Enclosure& e, double enough);

/// The goal of a survey that narrows the pooled percentile by the cells of one surface; all
/// arguments must outlive it. It is left at a jump, and when the other surface's cells are more in
/// the way.
Goal pooled_goal(const PooledSearch& search, const SurveyedPair& pair, const Areas& areas);

}  // namespace vkh
