// How far a survey has got with a percentile.
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
  // The first threshold at which the share may be reached, and the last one at which it may not
  // be: much area is undecided there, where at the ends there may be none.
  double first, last;
  Enclosure at_first, at_last;  // the shares within them
  bool is_gap = false;          // nearly no area lies between its ends

  static constexpr int kPieces = 5;  ///< into which a tally cuts each range
  static constexpr size_t kThresholds = 3 * (kPieces - 1) + 2;
  /// Adds thresholds at all that is known, and closer about both ends; the last two lie `beside`
  /// the ends, between them.
  void add_thresholds(double beside, std::vector<Threshold>& at) const;
  /// Takes in the shares within these.
  void look(std::span<const Threshold> at, std::span<const Enclosure> shares);
  /// Takes in that no distance is outside.
  void narrow(const Enclosure& all);

  double width() const { return known.upper - known.lower; }
  /// How far the ends may be from where the cells have them.
  double doubt() const { return (first - known.lower) + (known.upper - last); }
  /// Whether they may be too far, to see whether they are narrow, and what to split.
  bool is_coarse(double narrow) const;
  /// So much scores what is undecided at `first` and `last`.
  double weight() const;
};

}  // namespace vkh
