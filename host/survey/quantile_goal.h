// The state of a survey's search for a percentile.
#pragma once

#include <span>
#include <vector>

#include "host/survey/statistics.h"

namespace vkh {

struct QuantileGoal {
  QuantileGoal(double share_, const Enclosure& known_)
      : share(share_), known(known_), first(known_.upper), last(known_.lower) {}

  double share;
  Enclosure known;
  // The first threshold at which the share may be reached, and the last one at which it may not be.
  // Much area is undecided at these, while at the ends there may be none.
  double first, last;
  Enclosure at_first, at_last;  // the shares within them
  bool is_gap = false;          // nearly no area lies between its ends

  static constexpr int kPieces = 5;  ///< into which a tally cuts each range
  static constexpr size_t kThresholds = 3 * (kPieces - 1) + 2;
  /// Adds thresholds over the known interval, closer together at both ends. The last two lie
  /// between the ends, `beside` away from them.
  void add_thresholds(double beside, std::vector<Threshold>& at) const;
  /// Uses the shares within these thresholds.
  void look(std::span<const Threshold> at, std::span<const Enclosure> shares);
  /// Narrows the percentile to an interval that contains all distances.
  void narrow(const Enclosure& all);

  double width() const { return known.upper - known.lower; }
  /// How far the ends may be from the best that the cells prove.
  double doubt() const { return (first - known.lower) + (known.upper - last); }
  /// Whether that is too far to decide whether the percentile is narrow, and what to split.
  bool is_coarse(double narrow) const;
  /// The score of the undecided area at `first` and `last`.
  double weight() const;
};

}  // namespace vkh
