// The worst places of a mesh, which are clusters of cells: the same for picture, page and table.
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

/// The farthest places, at most `most`, the farthest first. Two places are separate if the distance
/// falls to under half of the smaller one on every path between them, on a grid of 1/64 of the
/// mesh's extent, or a coarser one for sparse points. Distances under a tenth of the largest one,
/// or of the map's bar if that is nearer, make no place. The place of the witness is always
/// included. No distance is larger than the witness's upper end. Cells that a map leaves out have
/// no place.
std::vector<MapPlace> map_places(const Mesh& mesh, const CellMap& map, size_t most,
                                 const std::optional<Witness>& witness = {});

/// The five worst places of a picture. Without a map they are faces, by their lower bounds, so that
/// every place is proven; `known` then encloses the largest distance over the face, whose middle is
/// the point.
std::vector<MapPlace> worst_places(const Picture& picture);

/// The distance of a place with its unit, and with a sign if the picture has sides: four digits,
/// or as many as it takes to be on the same side of the limit.
std::string place_text(const Picture& picture, const MapPlace& place);

}  // namespace vkh
