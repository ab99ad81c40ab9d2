#include "host/survey/distribution.h"

#include <algorithm>
#include <utility>

#include "host/base/rounding.h"
#include "host/survey/goals.h"

namespace vkh {

Distribution::Distribution(const SurveyedPair& pair, CellStore cells, Areas areas, double largest)
    : cells_(std::move(cells)),
      areas_(std::move(areas)),
      frame_(pair.frame),
      displacement_(pair.displacement),
      largest_(largest),
      rounding_(2 * pair.frame.length_up(pair.displacement)),
      least_width_(pair.frame.length_up(vkh::least_width(pair)) + rounding_) {}

std::vector<Enclosure> Distribution::shares_within(std::span<const double> ascending) const {
  std::vector<Threshold> at;
  at.reserve(ascending.size());
  for (const double distance : ascending)
    at.push_back(threshold_at(frame_, displacement_, distance));
  std::vector<Enclosure> shares = vkh::shares_within(cells_, areas_, at);
  for (size_t i = 0; i < shares.size(); ++i) {
    // By the threshold, which displacement moves, only nearly all area may be within the largest.
    if (ascending[i] >= largest_) shares[i] = {1, 1};
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
// square is a power of four, by which scaling is exact but for subnormal results.
Enclosure Distribution::area() const {
  const Frame& unit = areas_.unit;
  const double least = add_down(areas_.whole, -areas_.error);
  const double most = add_up(areas_.whole, areas_.error);
  return {unit.length_down(unit.length_down(least)), unit.length_up(unit.length_up(most)),
          std::clamp(unit.length_up(unit.length_up(areas_.whole)), 0.0,
                     unit.length_up(unit.length_up(most)))};
}

}  // namespace vkh
