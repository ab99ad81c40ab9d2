#include "host/survey/shares_seen.h"

#include <algorithm>
#include <iterator>

namespace vkh {
namespace {

// At least `share` is within this distance, and so within larger ones.
void note_surely(double distance, double share, std::map<double, double>& surely) {
  auto next = surely.upper_bound(distance);
  if (next != surely.begin() && std::prev(next)->second >= share) return;
  while (next != surely.end() && next->second <= share) next = surely.erase(next);
  surely.insert_or_assign(distance, share);
}

// At most `share` is within this distance, and so within smaller ones.
void note_perhaps(double distance, double share, std::map<double, double>& perhaps) {
  auto next = perhaps.lower_bound(distance);
  if (next != perhaps.end() && next->second <= share) return;
  while (next != perhaps.begin() && std::prev(next)->second >= share)
    perhaps.erase(std::prev(next));
  perhaps.insert_or_assign(distance, share);
}

// The first distance with such a share; both ascend.
std::map<double, double>::const_iterator first_with(const std::map<double, double>& shares,
                                                    double share) {
  return std::find_if(shares.begin(), shares.end(),
                      [&](const auto& at) { return at.second >= share; });
}

double before(const std::map<double, double>& shares, std::map<double, double>::const_iterator at,
              double least) {
  return at == shares.begin() ? least : std::max(std::prev(at)->first, least);
}

}  // namespace

void SharesSeen::add(std::span<const Threshold> thresholds, std::span<const Enclosure> shares) {
  for (size_t i = 0; i < thresholds.size(); ++i) {
    note_surely(thresholds[i].down, shares[i].lower, surely_);
    note_perhaps(thresholds[i].up, shares[i].upper, perhaps_);
  }
}

Enclosure SharesSeen::within(const Threshold& at) const {
  const auto behind = surely_.upper_bound(at.down);
  const auto next = perhaps_.lower_bound(at.up);
  return {behind == surely_.begin() ? 0 : std::prev(behind)->second,
          next == perhaps_.end() ? 1 : next->second};
}

SharesSeen::Ends SharesSeen::percentile(double share, double least, double most) const {
  const auto first = first_with(perhaps_, share), high = first_with(surely_, share);
  Ends ends{before(perhaps_, first, least), first == perhaps_.end() ? most : first->first,
            before(surely_, high, least), high == surely_.end() ? most : high->first};
  ends.high = std::clamp(ends.high, ends.low, most);
  ends.first = std::clamp(ends.first, ends.low, ends.high);
  ends.last = std::clamp(ends.last, ends.low, ends.high);
  return ends;
}

}  // namespace vkh
