// A triangle mesh as given, ready for the solver: finite coordinates, indices in range, at least
// one face, and no vertex that no face uses.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "host/mesh/file_faces.h"

namespace vkh {

/// What was counted while a mesh was accepted; all of it is reported, none of it changes the
/// geometry but the unreferenced vertices, which are not part of a mesh and are dropped.
struct MeshCounts {
  uint64_t vertices = 0;      ///< referenced vertices, kept
  uint64_t faces = 0;         ///< triangles, after polygons were fanned
  uint64_t unreferenced = 0;  ///< vertices that no face uses, dropped
  uint64_t degenerate =
      0;  ///< faces whose corners are collinear or coincide; kept as segments or points
  uint64_t duplicate = 0;  ///< faces whose three positions are those of an earlier face; kept
  uint64_t polygons = 0;   ///< faces of more than three corners that were fanned into triangles
};

/// Coordinates are float64, so that float32 and float64 input are both held exactly. Face i is the
/// i-th triangle of the input (polygons fanned in place); degenerate and duplicate faces stay.
struct Mesh {
  std::string name;  ///< the file's path, or what a caller named it; starts every error line
  std::vector<glm::dvec3> vertices;
  std::vector<glm::uvec3> faces;
  FileFaces file_faces = {};  ///< which face of the file each of them is of, for people
  MeshCounts counts;
  /// No vertex is farther than this from its exact place: what a reader rounded beyond "as given",
  /// such as a scene's transforms. h is 1-Lipschitz in it, and the certified interval is wider by
  /// it.
  double delta = 0;
  std::string unit = {};  ///< of the coordinates, where the file says: "m", "mm", "in"; else empty
  std::vector<std::string>
      notes;  ///< one line each, for people: "3 polygons were fanned into triangles"
};

/// Of a mesh of so many vertices and faces: 24 bytes a vertex, 12 a face.
inline uint64_t mesh_bytes(uint64_t vertex_count, uint64_t face_count) {
  return sizeof(glm::dvec3) * vertex_count + sizeof(glm::uvec3) * face_count;
}
inline uint64_t mesh_bytes(const Mesh& mesh) {
  return mesh_bytes(mesh.vertices.size(), mesh.faces.size());
}

/// Checks and cleans a mesh: drops unreferenced vertices, counts degenerate and duplicate faces.
/// Throws InputError that names the element if a referenced coordinate is not finite, an index is
/// out of range or there is no face. `faces` index into `vertices`.
Mesh make_mesh(std::string name, std::vector<glm::dvec3> vertices, std::vector<glm::uvec3> faces);

}  // namespace vkh
