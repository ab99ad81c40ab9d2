#include "host/survey/distribution.h"

#include <algorithm>

#include "host/base/rounding.h"
#include "host/survey/lengths.h"

namespace vkh {

std::vector<Enclosure> Distribution::shares_within(std::span<const double> ascending) const {
  std::vector<Threshold> at;
  at.reserve(ascending.size());
  for (const double distance : ascending)
    at.push_back(threshold_at(pair_.frame, pair_.displacement, distance));
  std::vector<Enclosure> shares = distances_.tally({at}).shares;
  const double largest = in_files(pair_, {0, distances_.highest()}).upper;
  for (size_t i = 0; i < shares.size(); ++i) {
    // The threshold may show only nearly all area within the largest distance, since displacement
    // moves it.
    if (ascending[i] >= largest) shares[i] = {1, 1};
    shares[i].estimate = shares[i].lower + (shares[i].upper - shares[i].lower) / 2;
  }
  return shares;
}

double Distribution::undecided_area(const Enclosure& at) const {
  const std::vector<double> ends{at.lower, at.upper};
  double share = 0;
  for (const Enclosure& within : shares_within(ends)) share += within.upper - within.lower;
  return share * area().upper;
}

// The exact sum of the faces' areas is within `error` of `whole`, in the unit of the areas; its
// square is a power of four, by which scaling is exact except for subnormal results.
Enclosure Distribution::area() const {
  const Frame& unit = areas_.unit;
  const double least = add_down(areas_.whole, -areas_.error);
  const double most = add_up(areas_.whole, areas_.error);
  return {unit.length_down(unit.length_down(least)), unit.length_up(unit.length_up(most)),
          std::clamp(unit.length_up(unit.length_up(areas_.whole)), 0.0,
                     unit.length_up(unit.length_up(most)))};
}

double Distribution::rounding() const { return 2 * pair_.frame.length_up(pair_.displacement); }

double Distribution::least_width() const {
  return pair_.frame.length_up(vkh::least_width(pair_)) + rounding();
}

}  // namespace vkh
