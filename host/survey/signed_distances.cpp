#include "host/survey/signed_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/rounding.h"
#include "host/survey/percentile_search.h"

namespace vkh {
namespace {

// The answers of the cells of one side: shares of A's area within distances, and at any distance.
struct OfSide {
  std::vector<Enclosure> within;
  Enclosure all;
  Enclosure mean;
};

// A threshold of either sign, as distances: at a negative one, -t or more is within under B. What
// is less than that must be surely less.
Threshold distance_of(const Threshold& at) {
  if (at.up >= 0) return at;
  return {std::nextafter(-at.up, 0.0), -at.down};
}

// 1 less a share of all.
Enclosure rest_of(const Enclosure& all, const Enclosure& share) {
  return {std::max(add_down(all.lower, -share.upper), 0.0), add_up(all.upper, -share.lower)};
}

Enclosure sum_of(const Enclosure& x, const Enclosure& y) {
  return {add_down(x.lower, y.lower), add_up(x.upper, y.upper)};
}

// The share within a threshold. Below 0: points under B that are this far, and perhaps points
// without a side. From 0 on: all points under B, and points over B or without a side that are no
// farther.
Enclosure share_at(const Threshold& at, size_t i, const std::array<OfSide, 3>& sides) {
  const auto& [over, under, other] = sides;
  Enclosure share;
  if (at.up < 0) {
    share = rest_of(under.all, under.within[i]);
    share.upper = add_up(share.upper, rest_of(other.all, other.within[i]).upper);
  } else if (at.down >= 0) {
    share = sum_of(under.all, over.within[i]);
    share = {add_down(share.lower, other.within[i].lower), add_up(share.upper, other.all.upper)};
  } else {
    share = {0, add_up(add_up(under.all.upper, over.within[i].upper), other.all.upper)};
  }
  return {std::clamp(share.lower, 0.0, 1.0), std::clamp(share.upper, 0.0, 1.0)};
}

}  // namespace

// Tallies the cells of one side. Thresholds of the other sign need no tally, since no distance is
// below 0.
std::optional<Tallied> SignedDistances::tally_side(const Tally& asked, uint32_t classes) {
  std::vector<Threshold> at;
  for (const Threshold& one : asked.at) {
    const bool is_other_side = one.up < 0 ? classes == kOverB : classes == kUnderB;
    at.push_back(is_other_side ? Threshold{-kAnyDistance, -kAnyDistance} : distance_of(one));
  }
  at.push_back({kAnyDistance, kAnyDistance});
  return waves_.tally_now({.at = at, .moments = asked.moments, .classes = classes});
}

Tallied SignedDistances::tally(const Tally& asked) {
  constexpr std::array kClasses{kOverB, kUnderB, kWithoutSide};
  std::array<OfSide, 3> sides;
  double highest = 0;
  for (size_t k = 0; k < sides.size(); ++k) {
    const std::optional<Tallied> tallied = tally_side(asked, kClasses[k]);
    if (!tallied) return last_answer(asked);
    sides[k] = {tallied->shares, tallied->shares.back(), tallied->moments.mean};
    highest = std::max(highest, tallied->highest);
  }
  Tallied all;
  for (size_t i = 0; i < asked.at.size(); ++i) {
    Enclosure share = share_at(asked.at[i], i, sides);
    if (asked.at[i].down >= highest) share.lower = 1;
    if (asked.at[i].up < -highest) share.upper = 0;
    all.shares.push_back(share);
  }
  shares_.add(asked.at, all.shares);
  if (asked.moments) {
    const auto& [over, under, other] = sides;
    mean_ = {add_down(over.mean.lower, -add_up(under.mean.upper, other.mean.upper)),
             add_up(add_up(over.mean.upper, other.mean.upper), -under.mean.lower)};
    plain_mean_ = over.mean.lower + under.mean.lower + other.mean.lower;
  }
  all.lowest = -highest;
  all.highest = highest;
  all.moments.mean = {std::max(mean_.lower, -highest), std::min(mean_.upper, highest)};
  return all;
}

// Repeats the last answer, which holds for the parts of its cells, too.
Tallied SignedDistances::last_answer(const Tally& asked) {
  Tallied all;
  all.highest = waves_.highest();
  all.lowest = -all.highest;
  for (const Threshold& one : asked.at) all.shares.push_back(shares_.within(one));
  all.moments.mean = {std::max(mean_.lower, all.lowest), std::min(mean_.upper, all.highest)};
  return all;
}

std::vector<Enclosure> SignedDistances::percentiles(const PercentileSearch& search) {
  const double most = highest();
  return percentiles_by(
      search, [&](double share) { return shares_.percentile(share, -most, most); }, *this);
}

}  // namespace vkh
