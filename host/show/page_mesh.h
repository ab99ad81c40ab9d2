// The mesh that a page shows: the mesh itself, or fewer faces that stand for all of its faces. It
// takes few bytes, which the viewer reads (tools/page/src/mesh.js).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "host/mesh/mesh.h"
#include "host/show/page_figures.h"
#include "host/survey/field.h"

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

/// The bounds of each shown face: the largest upper and the least lower of the faces that it stands
/// for. Never an average, so that nothing that is proven of a shown face is false for a face behind
/// it.
Field field_of(const Shown& shown, const Field& field);

/// Returns whether packed meshes are deflated here; otherwise they are stored.
bool can_deflate();

/// Streams of bytes, one after the other, each the same byte of all its numbers:
/// three of corners, by faces: the number of known vertices less the corner's number;
/// two of positions, by vertices, each coordinate less the one before, 65535 to a unit;
/// two of the face's step `within`, less the one before; two of `within` less `beyond`.
struct PackedMesh {
  size_t vertices = 0, faces = 0;
  std::string bytes;  ///< in zlib's format if can_deflate(), otherwise as they are
};
PackedMesh packed(const Shown& shown, const Field& field, const std::vector<Step>& steps);

}  // namespace vkh
