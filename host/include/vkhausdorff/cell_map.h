// A map of A by cells: what the distance probably is at each point, and how well it is known there.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "vkhausdorff/field.h"
#include "vkhausdorff/side.h"

namespace vkh {

/// The map that is asked for.
struct MapOptions {
  /// A's diagonal in pixels. A cell of at most an eighth of a pixel's area is not split, unless
  /// one of its edges is longer than two pixels.
  double pixels = 1000;
  /// The distance at the end of the colours, in the files' units; none: `CellMap::bar` finds one.
  std::optional<double> bar = {};
  /// Sides are wanted where they cost little: B has 50,000 faces at most, and an inside that is
  /// proven. CellMap::has_sides tells whether they are there.
  bool sides_if_cheap = false;
};

/// A part of a face of A, or one of its points. The drawn distance is affine over it, with these
/// values at its corners: it is off by `width` at most, anywhere on the cell.
struct MapCell {
  std::array<uint32_t, 4> corners{};  ///< as gpu::Cell has them; see weights_of()
  uint32_t face = 0;
  std::array<float, 3> estimate{};  ///< in CellMap::unit
  float width = 0;                  ///< in CellMap::unit
  float share = 0;                  ///< of A's area, or of its points
  SurfaceSide side = SurfaceSide::kUnsigned;
};

/// The barycentrics, on its face, of each corner of a cell.
std::array<DVec3, 3> weights_of(const MapCell& cell);

/// Cells that tile the faces of A that have an area; if A is points, one for each of them.
struct CellMap {
  /// A cell is unresolved if its width is over a twentieth of the bar.
  static constexpr double kUnresolved = 0.05;

  double unit = 1;  ///< the length of an estimate of 1, in the files' units
  /// The end of the colours, in the files' units: MapOptions::bar, or the distance that 99 % of A's
  /// area is probably within, without what is left out.
  double bar = 0;
  double least = 0;  ///< widths up to that, in `unit`, are what floats leave
  double slack = 0;  ///< how far storing coordinates moves a distance, in the files' units
  bool has_sides = false;
  InsideOut inside_out = InsideOut::kNone;  ///< of B, with sides
  /// SurveyOptions::max_distance, in the files' units: cells that are probably farther are left
  /// out.
  std::optional<double> max_distance = {};
  std::vector<MapCell> cells;

  /// Encloses the distance of a point of a cell of that width, where `estimate` is drawn; both are
  /// in `unit`, and the enclosure in the files' units.
  Enclosure around(double estimate, double width) const;

  /// Whether a cell is left out, by the mean of its estimates.
  bool is_left_out(const MapCell& cell) const {
    const double sum = static_cast<double>(cell.estimate[0]) +
                       static_cast<double>(cell.estimate[1]) +
                       static_cast<double>(cell.estimate[2]);
    return max_distance && sum / 3 * unit > *max_distance;
  }
  /// Whether the colours of a cell say less than they seem to, with a bar of that end.
  bool is_unresolved(const MapCell& cell, double end) const {
    return static_cast<double>(cell.width) > least &&
           static_cast<double>(cell.width) * unit > kUnresolved * end;
  }
};

/// The ends of a map's colours, in the files' units; `low` is negative where the map has sides.
struct MapBar {
  double low = 0, high = 1;
  std::optional<double> limit = {}, limit_under = {};  ///< `limit_under` is negative

  /// 0 at the lower end, and 1 at the upper one; what is not on the bar is outside.
  double share_of(double distance) const;
};

/// Shares of A's area, or of its points, by a map's estimates: what the colours of the bar cannot
/// show.
struct MapShares {
  MapBar bar;
  bool has_sides = false;
  double above = 0, below = 0;  ///< outside of the bar
  double unresolved = 0, no_side = 0;
  double left_out = 0;  ///< by CellMap::max_distance: in none of the others
  /// The share, of what is not left out, of cells that are probably within the limits, or within
  /// both limits if they have no side.
  double within = 0;
  double mean =
      0;  ///< of the distance of what is not left out, without a sign, in the files' units
};

}  // namespace vkh
