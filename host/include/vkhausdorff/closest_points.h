// The points of a mesh that are closest to given points, and the bounds of their distances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "vkhausdorff/mesh.h"

namespace vkh {

/// The answer of Solver::closest: one entry for each point asked, in their order. Lengths are in
/// the coordinates' unit. With d the distance of the point asked from the mesh, and e its distance
/// from the entry of `points`, both in exact arithmetic: lower <= d <= upper, lower <= e <= upper.
struct ClosestPoints {
  std::vector<double> lower, upper;
  /// A corner of the face, exactly; or a point whose coordinates are each within 2^-49 of the
  /// largest that the face has along that axis (and 2^-1060) of one of its points.
  std::vector<DVec3> points;
  std::vector<uint32_t> faces;  ///< of Mesh::faces; Mesh::file_faces has the file's
};

/// Called between two submissions with the number of points that are done; false ends the search.
using ClosestGoesOn = std::function<bool(size_t)>;

}  // namespace vkh
