#include "host/survey/quantile_goal.h"

#include <algorithm>

#include "host/survey/wave_goals.h"

namespace vkh {

void QuantileGoal::add_thresholds(double beside, std::vector<Threshold>& at) const {
  const auto cut = [&](double from, double to) {
    for (int k = 1; k < kPieces; ++k) {
      const double distance = std::clamp(from + (to - from) * k / kPieces, from, to);
      at.push_back({distance, distance});
    }
  };
  cut(known.lower, known.upper);
  cut(known.lower, std::clamp(first, known.lower, known.upper));
  cut(std::clamp(last, known.lower, known.upper), known.upper);
  at.push_back({known.lower + beside, known.lower + beside});
  at.push_back({known.upper - beside, known.upper - beside});
}

// If less than the share can be within a distance, the distance is below the percentile; if at
// least the share surely is, it is not.
void QuantileGoal::look(std::span<const Threshold> at, std::span<const Enclosure> shares) {
  first = known.upper;
  last = known.lower;
  at_first = at_last = {};
  for (size_t k = 0; k < kThresholds - 2; ++k) {
    const double distance = at[k].down;
    const bool is_perhaps = shares[k].upper >= share, is_surely = shares[k].lower >= share;
    if (!is_perhaps) known.lower = std::max(known.lower, distance);
    if (is_surely) known.upper = std::min(known.upper, distance);
    if (is_perhaps && distance <= first) {
      first = distance;
      at_first = shares[k];
    }
    if (!is_surely && distance >= last) {
      last = distance;
      at_last = shares[k];
    }
  }
}

void QuantileGoal::narrow(const Enclosure& all) {
  known.lower = std::clamp(all.lower, known.lower, known.upper);
  known.upper = std::clamp(all.upper, known.lower, known.upper);
}

bool QuantileGoal::is_coarse(double narrow) const {
  return doubt() > std::min(width(), narrow) / 8;
}

double QuantileGoal::weight() const {
  return weight_of_width((at_first.upper - at_first.lower) + (at_last.upper - at_last.lower));
}

}  // namespace vkh
