#include "host/survey/map_shares.h"

#include <algorithm>
#include <limits>

namespace vkh {

namespace {

constexpr double kLikeNought = 2 * CellMap::kUnresolved;

double longer_end(const MapBar& bar) { return std::max(bar.high, -bar.low); }

}  // namespace

double MapBar::share_of(double distance) const {
  const double width = high - low;
  if (!(width > 0)) return distance > high ? 2 : 0;  // a bar without width has one colour
  return distance / width - low / width;
}

MapBar bar_of(const CellMap& map, const BarOptions& options) {
  constexpr double kTimesLimit = 1.5;
  MapBar bar;
  if (options.limit) bar.limit = options.limit->within;
  if (options.limit && map.has_sides) bar.limit_under = -options.limit->within;
  if (options.sided) {
    bar.limit = options.sided->over.within;
    bar.limit_under = -options.sided->under.within;
  }
  bar.high = bar.limit ? kTimesLimit * *bar.limit : std::min(map.bar, options.upper);
  if (map.has_sides) bar.low = bar.limit_under ? kTimesLimit * *bar.limit_under : -bar.high;
  if (options.range) {
    bar.low = map.has_sides ? -options.range->upper : options.range->lower;
    bar.high = options.range->upper;
  }
  return bar;
}

bool is_without_side(const CellMap& map, const MapBar& bar, const MapCell& cell) {
  if (!map.has_sides || cell.side != SurfaceSide::kUnsigned) return false;
  const float most = std::max({cell.estimate[0], cell.estimate[1], cell.estimate[2]});
  const double reach = static_cast<double>(most) + static_cast<double>(cell.width);
  return static_cast<double>(most) > map.least && reach * map.unit > kLikeNought * longer_end(bar);
}

bool is_unresolved(const CellMap& map, const MapBar& bar, const MapCell& cell) {
  return !map.is_left_out(cell) && map.is_unresolved(cell, longer_end(bar));
}

double distance_at(const CellMap& map, const MapCell& cell, size_t corner) {
  const double distance = map.unit * static_cast<double>(cell.estimate[corner]);
  if (!map.has_sides) return distance;
  return cell.side == SurfaceSide::kUnsigned ? 0 : distance * static_cast<double>(cell.side);
}

double distance_of(const CellMap& map, const MapCell& cell) {
  return (distance_at(map, cell, 0) + distance_at(map, cell, 1) + distance_at(map, cell, 2)) / 3;
}

MapShares shares_of(const CellMap& map, const MapBar& bar) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  MapShares shares{.bar = bar, .has_sides = map.has_sides};
  const auto is_within = [&](double distance) {
    return !bar.limit || (distance <= *bar.limit && -distance <= -bar.limit_under.value_or(-inf));
  };
  for (const MapCell& cell : map.cells) {
    const auto area = static_cast<double>(cell.share);
    if (map.is_left_out(cell)) {
      shares.left_out += area;
      continue;
    }
    const float sum = cell.estimate[0] + cell.estimate[1] + cell.estimate[2];
    shares.mean += area * map.unit * static_cast<double>(sum) / 3;
    if (is_unresolved(map, bar, cell)) shares.unresolved += area;
    if (is_without_side(map, bar, cell)) {
      const double distance = map.unit * static_cast<double>(sum) / 3;
      if (is_within(distance) && is_within(-distance)) shares.within += area;
      shares.no_side += area;
      continue;
    }
    const double distance = distance_of(map, cell), share = bar.share_of(distance);
    if (is_within(distance)) shares.within += area;
    if (share > 1) shares.above += area;
    if (share < 0) shares.below += area;
  }
  if (shares.left_out < 1) {
    shares.mean /= 1 - shares.left_out;
    shares.within /= 1 - shares.left_out;
  }
  for (double* part : {&shares.above, &shares.below, &shares.unresolved, &shares.no_side,
                       &shares.left_out, &shares.within})
    *part = std::min(*part, 1.0);  // a cell's share is a float
  return shares;
}

}  // namespace vkh
