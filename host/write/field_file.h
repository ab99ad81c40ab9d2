// A mesh with bounds for each of its faces, as files that other programs show.
#pragma once

#include <string>

#include "host/survey/field.h"
#include "host/write/colour_map.h"

namespace vkh {

/// What a field file says of its numbers.
struct FieldFile {
  const Mesh& mesh;
  const Field& field;
  Enclosure interval;   ///< of the largest distance over the mesh
  std::string unit;     ///< of lengths; empty: the file's own
  std::string against;  ///< the other mesh, as people know it
  ColourMap map = ColourMap::kViridis;
};

/// A binary PLY: positions as doubles; for each face lower, upper and quality, which is upper; for
/// each vertex as quality the largest upper of its faces; colours by quality, from 0 to the
/// largest. Where the mesh's file has other faces than triangles, each has its number there, too.
std::string to_ply(const FieldFile& file);

/// A binary glTF 2.0: positions as floats about a node's translation, each corner of each face a
/// vertex of its own, so that colours are the faces'; `_LOWER` and `_UPPER` likewise.
std::string to_glb(const FieldFile& file);

}  // namespace vkh
