// Points of a surface, spread by its area.
#pragma once

#include <cstddef>
#include <vector>

#include "vkhausdorff/mesh.h"

namespace vkh {

/// `count` points, one of each stretch of equal area as the faces follow each other, from a fixed
/// generator: the same points for the same mesh on every machine, except for roundings. All faces
/// weigh the same if there is no area, or if a figure is too large for a double.
std::vector<DVec3> area_samples(const Mesh& mesh, size_t count);

}  // namespace vkh
