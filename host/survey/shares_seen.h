// Remembers the shares of A's area within distances that tallies have found. A share only grows
// with the distance, and a survey only narrows it: so a share at one distance bounds the shares at
// all others, and stays true.
#pragma once

#include <map>
#include <span>

#include "host/survey/statistics.h"

namespace vkh {

class SharesSeen {
 public:
  /// Notes what was proven of the share within each threshold.
  void add(std::span<const Threshold> thresholds, std::span<const Enclosure> shares);

  /// Encloses the share within a threshold.
  Enclosure within(const Threshold& at) const;

  /// Encloses a percentile: it is above `low`, and not above `high`. With the cells of the last
  /// tally, its lower end was at most `first`, and its upper end at least `last`. These two only
  /// steer. Without bounds the ends are `least` and `most`.
  struct Ends {
    double low, first, last, high;
  };
  Ends percentile(double share, double least, double most) const;

 private:
  std::map<double, double> surely_;   // lower ends of shares by distances, both ascending
  std::map<double, double> perhaps_;  // upper ends
};

}  // namespace vkh
