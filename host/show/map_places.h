// The worst places of a mesh: clusters of cells, not cells. Picture, page and table have the same.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "host/show/draw.h"

namespace vkh {

/// The farthest point of a cluster.
struct MapPlace {
  glm::dvec3 point{};
  double distance = 0;  ///< estimated, in the files' units
  SurfaceSide side = SurfaceSide::kUnsigned;
  size_t face = 0;           ///< of the mesh
  Enclosure known = {};      ///< encloses the distance of the point
  bool is_farthest = false;  ///< the point that proves the lower end of the largest distance
};

/// The farthest places, at most so many, the farthest first. Two places are apart where the
/// distance falls to under half of the nearer one's on every way between them, as a grid of 1/64 of
/// the mesh's extent sees it, or a coarser one for points that are farther apart; what is under a
/// tenth of the largest distance, or of the map's bar where that is nearer, is no place. A place
/// that has the witness is there. No distance is larger than the witness's upper end. What a map
/// leaves out has no place.
std::vector<MapPlace> map_places(const Mesh& mesh, const CellMap& map, size_t most,
                                 const std::optional<Witness>& witness = {});

/// The five worst places of a picture. Without a map they are of faces, by their lower bounds, so
/// that nothing is a place that is not proven; `known` then encloses the largest distance over the
/// face, whose middle is the point.
std::vector<MapPlace> worst_places(const Picture& picture);

/// The distance of a place with a sign where the picture has sides, and with its unit: four digits,
/// or as many as it takes to be on the same side of the limit.
std::string place_text(const Picture& picture, const MapPlace& place);

}  // namespace vkh
