// The bar of a map by cells, and the shares of area that it does not show: the same for pictures,
// pages and JSON.
#pragma once

#include <optional>

#include "vkhausdorff/cell_map.h"
#include "vkhausdorff/limit.h"
#include "vkhausdorff/side.h"

namespace vkh {

/// The lengths that decide a map's bar, in the files' units.
struct BarOptions {
  std::optional<Limit> limit = {};
  std::optional<SidedLimits> sided = {};  ///< in place of `limit`
  double upper = 0;                       ///< no distance is above it
  std::optional<Enclosure> range = {};    ///< the ends that the user asked for
};
/// A bar ends at 1.5 times the limit, or where the map says; a bar with sides is as long below 0.
MapBar bar_of(const CellMap& map, const BarOptions& options);

/// Whether a cell is drawn in grey: it has no side, and is not surely within a tenth of the bar's
/// upper end. Within that tenth a cell without a side has the colour of 0.
bool is_without_side(const CellMap& map, const MapBar& bar, const MapCell& cell);
/// Whether the colours of a cell say less than they seem to.
bool is_unresolved(const CellMap& map, const MapBar& bar, const MapCell& cell);
/// The distance by which a corner of a cell is coloured, signed where the map has sides.
double distance_at(const CellMap& map, const MapCell& cell, size_t corner);
double distance_of(const CellMap& map, const MapCell& cell);  ///< about its middle

MapShares shares_of(const CellMap& map, const MapBar& bar);

}  // namespace vkh
