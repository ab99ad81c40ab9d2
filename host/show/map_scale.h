// The colours of a map by cells: of distances, and of the cells that a camera sees.
#pragma once

#include <optional>

#include "host/show/raster.h"
#include "host/survey/map_shares.h"
#include "vkhausdorff/colour_map.h"

namespace vkh::drawing {

/// The colours of distances above the bar, or below a signed bar's lower end; of cells without a
/// side; and of cells that are left out.
inline constexpr Rgb kOver{214, 32, 140}, kBelow{91, 15, 128}, kNoSide{150, 150, 150},
    kLeftOut{205, 209, 218};
/// The colour between the stripes of the legend's swatch for unresolved cells.
inline constexpr Rgb kUnresolved{215, 215, 215};

/// Distances to shares of a bar, and shares to colours. Distances are signed where the map has
/// sides.
class MapScale {
 public:
  /// The picture has a map.
  MapScale(const Picture& picture, const PictureOptions& options);

  const MapBar& bar() const { return bar_; }
  double low() const { return bar_.low; }
  double high() const { return bar_.high; }
  double length() const { return bar_.high - bar_.low; }
  bool is_signed() const { return map_.has_sides; }
  /// The limits, if there are any. Only a signed bar has the lower one.
  std::optional<double> limit() const { return bar_.limit; }
  std::optional<double> limit_under() const { return bar_.limit_under; }
  double share_of(double distance) const { return bar_.share_of(distance); }
  Rgb colour(double distance) const;
  const Palette& palette() const { return palette_; }

  bool is_left_out(const MapCell& cell) const { return map_.is_left_out(cell); }
  /// Call the functions of the same names with the picture's map and this bar.
  bool is_without_side(const MapCell& cell) const { return vkh::is_without_side(map_, bar_, cell); }
  bool is_unresolved(const MapCell& cell) const { return vkh::is_unresolved(map_, bar_, cell); }
  /// The colour of a cell that is not coloured by its distances; nothing: it is.
  std::optional<Rgb> plain_colour(const MapCell& cell) const;
  double distance_at(const MapCell& cell, size_t corner) const {
    return vkh::distance_at(map_, cell, corner);
  }
  double distance_of(const MapCell& cell) const { return vkh::distance_of(map_, cell); }

 private:
  static MapBar bar_of(const Picture& picture, const PictureOptions& options);
  void set_palette(const PictureOptions& options);

  const CellMap& map_;
  MapBar bar_;
  Palette palette_;
};

/// Fills in the cells of the picture's map for a raster, as the camera sees them.
FillFaces cells_for(const Picture& picture, const MapScale& scale, const Camera& camera);

/// Shares of A's area, or of its points, and their distribution along the bar.
struct MapCounts : MapShares {
  static constexpr size_t kBins = 36;
  std::array<double, kBins> bins{};
};
/// `known`: the map's shares by the scale's bar, if the survey has added them up.
MapCounts counts_of(const CellMap& map, const MapScale& scale, const MapShares* known = nullptr);

}  // namespace vkh::drawing
