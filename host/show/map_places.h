// The worst places of a map: clusters of cells, not cells.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "host/mesh/mesh.h"
#include "host/survey/cell_map.h"

namespace vkh {

/// The farthest point of a cluster, as the map has it.
struct MapPlace {
  glm::dvec3 point{};
  double distance = 0;  ///< estimated, in the files' units
  SurfaceSide side = SurfaceSide::kUnsigned;
  size_t face = 0;  ///< of the mesh
};

/// The farthest places, at most so many, the farthest first. Two places are apart where the
/// distance falls to under half of the nearer one's on every way between them, as a grid of 1/64 of
/// the mesh's extent sees it; what is under a tenth of the largest distance is no place.
std::vector<MapPlace> map_places(const Mesh& mesh, const CellMap& map, size_t most);

}  // namespace vkh
