// The colours of a map by cells: what a distance looks like, and what cells look like to a camera.
#pragma once

#include <optional>

#include "host/show/raster.h"
#include "vkhausdorff/colour_map.h"

namespace vkh::drawing {

/// The colour of what is above the bar, or below a signed one's lower end; of cells that have no
/// side; and of what is left out.
inline constexpr Rgb kOver{214, 32, 140}, kBelow{91, 15, 128}, kNoSide{150, 150, 150},
    kLeftOut{205, 209, 218};

/// Distances to shares of a bar, and shares to colours. Distances are signed where the map has
/// sides.
class MapScale {
 public:
  /// The picture has a map.
  MapScale(const Picture& picture, const PictureOptions& options);

  double low() const { return low_; }
  double high() const { return high_; }
  double length() const { return high_ - low_; }
  bool is_signed() const { return is_signed_; }
  /// The limits, where there are some: the lower one is of a signed bar alone.
  std::optional<double> limit() const { return limit_; }
  std::optional<double> limit_under() const { return limit_under_; }
  /// 0 at the bar's lower end, and 1 at its upper one; what is not on the bar is outside.
  double share_of(double distance) const;
  Rgb colour(double distance) const;
  const Palette& palette() const { return palette_; }

  bool is_left_out(const MapCell& cell) const { return map_.is_left_out(cell); }
  /// Whether a cell has no colour but grey: it has no side, and is not so near that it looks like
  /// nought.
  bool is_without_side(const MapCell& cell) const;
  /// The colour of a cell that the bar does not have; none: its distances are coloured.
  std::optional<Rgb> plain_colour(const MapCell& cell) const;
  /// The distance by which a corner of a cell is coloured.
  double distance_at(const MapCell& cell, size_t corner) const;
  double distance_of(const MapCell& cell) const;  ///< about its middle
  bool is_unresolved(const MapCell& cell) const;

 private:
  void set_range(const Picture& picture, const PictureOptions& options);
  void set_palette(const PictureOptions& options);

  const CellMap& map_;
  double low_ = 0, high_ = 1;
  bool is_signed_;
  std::optional<double> limit_, limit_under_;
  Palette palette_;
};

/// Fills in the cells of the picture's map for a raster, as the camera sees them.
FillFaces cells_for(const Picture& picture, const MapScale& scale, const Camera& camera);

/// Shares of A's area, or of its points, that the colours do not tell, and the distribution of what
/// they tell.
struct MapCounts {
  static constexpr size_t kBins = 36;
  double above = 0, below = 0;  ///< outside of the bar
  double unresolved = 0, no_side = 0;
  double left_out = 0;               ///< in none of the others
  double within = 0;                 ///< of what is not left out: probably within the limits
  double mean = 0;                   ///< of the distance of what is not left out, without a sign
  std::array<double, kBins> bins{};  ///< shares of area along the bar
};
MapCounts counts_of(const CellMap& map, const MapScale& scale);

}  // namespace vkh::drawing
