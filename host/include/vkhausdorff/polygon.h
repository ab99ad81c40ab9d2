// Triangulates a polygon that a file gives by its corners.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "vkhausdorff/mesh.h"

namespace vkh {

struct Note;

struct PolygonResult {
  PolygonKind kind = PolygonKind::kFan;
  /// Any triangulation with this outline is as near to this one, both ways; 0 for a flat one whose
  /// plane an axis is normal to, and for corners on a line. Of an outline that has only a fan, any
  /// connected surface of these corners within their hull is as near to the fan.
  double ambiguity = 0;
  /// Triangles of a clipped polygon, corners by their place, and the axis along which they tile it.
  std::vector<UVec3> triangles = {};
  int axis = 0;
};

/// Replaces a polygon's fan by its triangles. `fan` has the triangles (c0, c1, c2), (c0, c2, c3)
/// and so on of finite corners, two at least. A convex polygon keeps its fan bit for bit.
PolygonResult triangulate_fan(std::span<const DVec3> vertices, std::span<UVec3> fan);

/// The note on corners off a plane: `polygons` has an ambiguity.
Note note_on_ambiguity(const Polygons& polygons);

/// Replaces a fan by triangles of its corners that are named by their place, as many as it has.
void place_triangles(std::span<const UVec3> triangles, std::span<UVec3> fan);

}  // namespace vkh
