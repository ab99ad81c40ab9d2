// Splits faces by the cells of a grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vkhausdorff/mesh.h"

namespace vkh {

using Faces = std::vector<UVec3>;

/// Cubes side by side, as many as hold a box.
struct Grid {
  DVec3 corner;     ///< the lowest of the first cube
  double side = 0;  ///< of a cube, positive
};

/// Faces in the order of their cubes; a face is in that of its first corner.
struct Blocks {
  Faces faces;
  std::vector<size_t> ends;     ///< one for each cube that has faces, ascending
  std::vector<char> is_shared;  ///< for each vertex: whether faces of several cubes have it

  size_t size() const { return ends.size(); }
  std::span<const UVec3> operator[](size_t block) const;
};

Blocks split(std::span<const UVec3> faces, std::span<const DVec3> vertices, const Grid& grid);

}  // namespace vkh
