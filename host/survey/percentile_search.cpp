#include "host/survey/percentile_search.h"

#include <algorithm>
#include <array>

namespace vkh {
namespace {

// One end of a percentile, which is above one distance and not above another.
struct PercentileEnd {
  double share, low, likely, high;  // it was at the likely one before cells were split
  bool is_upper;

  static constexpr int kSections = 8;
  double width() const { return high - low; }
  double cut(int k) const {
    constexpr int kHalf = kSections / 2;
    return k <= kHalf ? low + (likely - low) * k / kHalf
                      : likely + (high - likely) * (k - kHalf) / kHalf;
  }
  bool is_reached(const Enclosure& within) const {
    return is_upper ? within.lower >= share : within.upper >= share;
  }
  void look(std::span<const Enclosure> at_cuts) {
    const PercentileEnd before = *this;
    for (int k = 1; k < kSections; ++k) {
      if (is_reached(at_cuts[static_cast<size_t>(k - 1)])) {
        high = std::min(high, before.cut(k));
      } else {
        low = std::max(low, before.cut(k));
      }
    }
    likely = low + (high - low) / 2;
  }
};

// Both ends of each percentile.
using PercentileEnds = std::vector<std::array<PercentileEnd, 2>>;

// The ends that are known worse than would do: nearer ones make no interval much narrower.
std::vector<PercentileEnd*> wide_ends(PercentileEnds& ends, double resolution) {
  constexpr double kOfWidth = 1.0 / 32;
  std::vector<PercentileEnd*> wide;
  for (auto& [lower, upper] : ends) {
    const double enough = std::max(resolution, kOfWidth * (upper.high - lower.low));
    for (PercentileEnd* end : {&lower, &upper}) {
      if (end->width() > enough) wide.push_back(end);
    }
  }
  return wide;
}

}  // namespace

// Each pass narrows the ends that are left. No cell is split between two passes.
std::vector<Enclosure> percentiles_by(const PercentileSearch& search, const KnownEnds& known_ends,
                                      AreaDistances& distances) {
  constexpr int kMostTallies = 20;
  PercentileEnds ends;
  for (const double share : search.shares) {
    const SharesSeen::Ends known = known_ends(share);
    ends.push_back({PercentileEnd{share, known.low, known.first, known.high, false},
                    {share, known.low, known.last, known.high, true}});
  }
  for (int pass = 0; pass < kMostTallies; ++pass) {
    const std::vector<PercentileEnd*> wide = wide_ends(ends, search.resolution);
    std::vector<Threshold> at;
    for (const PercentileEnd* end : wide) {
      for (int k = 1; k < PercentileEnd::kSections; ++k) at.push_back({end->cut(k), end->cut(k)});
    }
    if (at.empty()) break;
    const std::vector<Enclosure> shares = distances.tally({at}).shares;
    constexpr size_t kCuts = PercentileEnd::kSections - 1;
    for (size_t i = 0; i < wide.size(); ++i)
      wide[i]->look(std::span(shares).subspan(kCuts * i, kCuts));
  }
  std::vector<Enclosure> all;
  for (const auto& [lower, upper] : ends) all.push_back({lower.low, upper.high});
  return all;
}

}  // namespace vkh
