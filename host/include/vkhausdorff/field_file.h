// A mesh with bounds for each of its faces, as files that other programs show.
#pragma once

#include <string>

#include "vkhausdorff/colour_map.h"
#include "vkhausdorff/field.h"

namespace vkh {

/// The content of a field file besides its format. Both writers throw UsageError where the field,
/// or that of `sides`, does not have as many values as the mesh has faces.
struct FieldFile {
  const Mesh& mesh;
  const Field& field;
  Enclosure interval;   ///< the largest distance's over the mesh
  std::string unit;     ///< the lengths' unit; empty: the file's own
  std::string against;  ///< the other mesh's name for people
  ColourMap map = ColourMap::kViridis;
  const SignedFigures* sides = nullptr;  ///< of the faces, which has the fields; null: none
};

/// The signed distances of all points of a face lie in `distances`. `side`: 1, over the other mesh,
/// -1, under it, or 0, of both sides or without a proven one.
struct SidedFace {
  Enclosure distances;
  int side = 0;
};
SidedFace sided_face(const SignedFigures& sides, size_t face);

/// A binary PLY: positions as doubles; lower, upper and quality, which is upper, for each face; the
/// largest upper of its faces as quality for each vertex; colours by quality, from 0 to the
/// largest. With sides, each face has signed_lower, signed_upper and side (sided_face()), and each
/// vertex `signed`: the end of these of its faces that is farthest from 0. If the mesh's file has
/// faces other than triangles, each face has its number there too. Points have no faces: each has
/// lower, upper, distance, which is the middle of both, and with sides what a face has.
std::string to_ply(const FieldFile& file);

/// A binary glTF 2.0: positions as floats about a node's translation, each corner of each face a
/// vertex of its own, so that colours are the faces'; `_LOWER` and `_UPPER` are the faces' too, and
/// with sides `_SIGNED_LOWER`, `_SIGNED_UPPER` and `_SIDE`.
std::string to_glb(const FieldFile& file);

}  // namespace vkh
