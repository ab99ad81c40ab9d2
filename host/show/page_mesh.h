// The mesh that a page shows: the mesh itself, or fewer faces that stand for all of its faces. It
// takes few bytes, which the viewer reads (tools/page/src/mesh.js).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "host/show/shown_cells.h"
#include "vkhausdorff/mesh.h"

namespace vkh {

/// The place of a mesh: coordinates from 0 to 1, by the longest side of its box.
struct Place {
  glm::dvec3 lo{};
  double size = 0;  ///< the longest side; 0: all vertices are one point

  glm::dvec3 unit(const glm::dvec3& point) const;
};
Place place_of(const Mesh& mesh);

struct Shown {
  Place place;
  std::vector<glm::dvec3> vertices;  ///< in units of `place`
  std::vector<glm::uvec3> faces;
  std::vector<uint32_t> face_of;  ///< the shown face that stands for each face of the mesh
  bool is_decimated = false;
};

/// Keeps at most `most_faces` (>= 1): vertices in one cell of a grid become one. Each face that
/// vanishes gets a shown face of its cell, or one of them that is shown as it is.
Shown shown_of(const Mesh& mesh, size_t most_faces);

/// The triangles that a page shows, each with the distances that are shown of it.
struct ShownMesh {
  Place place;
  std::vector<std::array<uint16_t, 3>> vertices = {};  ///< 65535 to a unit of `place`
  std::vector<glm::uvec3> faces = {};
  std::vector<ShownValue> values = {};  ///< one per face
  bool is_decimated = false;
  double spacing = 0;  ///< of the shown points, in units of `place`; 0: there are faces
};

/// The cells of a map, or if even the faces are more than `most_faces`, fewer faces that stand for
/// all: each shows the farthest of the faces that it stands for, and its width covers all of them,
/// except parts that are left out beside parts that are not. Points are faces of one place each.
ShownMesh shown_mesh(const Mesh& mesh, const CellMap& map, const drawing::MapScale& scale,
                     size_t most_faces);

/// Streams of bytes, one after the other, each the same byte of all its numbers:
/// three of corners, by faces: the number of known vertices less the corner's number;
/// two of positions, by vertices, each coordinate less the one before;
/// three of distances, by corners, as shares of `unit`: of a float its sign, and above that the
/// upper 23 bits of what follows it; less the one before at the same vertex, or else before;
/// two of the faces' widths, the upper 16 bits of such a float, rounded up, less the one before;
/// one of flags, by faces: 1 for hatched, 2 for sideless, 4 for left out.
struct PackedMesh {
  size_t vertices = 0, faces = 0;
  double unit = 1;    ///< in the files' units
  std::string bytes;  ///< in zlib's format if can_deflate(), otherwise as they are
};
PackedMesh packed(const ShownMesh& shown);

}  // namespace vkh
