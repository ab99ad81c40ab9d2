// A picture with the data of its pixels and of its page's texts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/show/map_places.h"
#include "host/show/map_scale.h"

namespace vkh::drawing {

/// The largest distance that is known of a picture's mesh.
double largest_known(const Picture& picture);

/// A picture that has a map, and that map's colours, shares and worst places.
struct MappedPicture {
  /// Without a map the picture gets one of the bounds of its faces.
  MappedPicture(const Picture& picture, const PictureOptions& options);
  MappedPicture(const MappedPicture&) = delete;
  MappedPicture& operator=(const MappedPicture&) = delete;

  bool is_of_bounds() const { return bounds.has_value(); }
  /// Says what the colours of such a map are.
  std::string colours_of_bounds() const;

  Picture drawn;
  std::vector<MapPlace> places;
  std::optional<CellMap> bounds;
  std::optional<MapScale> scale;
  MapCounts counts;
};

/// Draws a picture that check_picture() accepts. `options`: the ones that the map was made with.
Image draw(const MappedPicture& mapped, const PictureOptions& options);

}  // namespace vkh::drawing
