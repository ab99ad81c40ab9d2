// A triangle mesh as given, ready for the solver: finite coordinates, indices in range, at least
// one face, and no vertex that no face uses.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vkhausdorff/error.h"
#include "vkhausdorff/file_faces.h"
#include "vkhausdorff/mesh_transform.h"

namespace vkh {

/// glm::dvec3 and glm::uvec3, unless the program that includes this has its own alignment of those
/// (GLM_FORCE_DEFAULT_ALIGNED_GENTYPES, GLM_FORCE_INTRINSICS): these are packed there, too, as the
/// library has them, and GLM converts between both.
using DVec3 = glm::vec<3, double, glm::packed_highp>;
using UVec3 = glm::vec<3, uint32_t, glm::packed_highp>;

/// The counts taken while a mesh was accepted; all of them are reported, none changes the geometry
/// but the unreferenced vertices, which are not part of a mesh and are dropped.
struct MeshCounts {
  uint64_t vertices = 0;      ///< referenced vertices, kept
  uint64_t faces = 0;         ///< triangles, after polygons were triangulated
  uint64_t unreferenced = 0;  ///< vertices that no face uses, dropped
  uint64_t degenerate =
      0;  ///< faces whose corners are collinear or coincide; kept as segments or points
  uint64_t duplicate = 0;  ///< faces whose three positions are those of an earlier face; kept
  uint64_t polygons = 0;   ///< faces of more than three corners, triangulated
};

/// Says how a polygon became triangles.
enum class PolygonKind {
  kFan,        ///< convex, or all its corners lie on a line: the fan covers it
  kClipped,    ///< simple or weakly simple, not convex: ears were clipped
  kCrossing,   ///< its outline crosses itself: there is only the fan
  kNoArea,     ///< its corners lie on no line, and the outline encloses nothing: only the fan
  kIntricate,  ///< undecided after 4,096 tests a corner: only the fan
};

/// Whether the triangles are the fan because nothing else is known.
constexpr bool has_only_fan(PolygonKind kind) {
  return kind != PolygonKind::kFan && kind != PolygonKind::kClipped;
}

/// Triangles of a face of more than three corners that are not the fan of a convex one.
struct Triangulation {
  /// Says that the triangles are a fan because no others are known.
  static constexpr int kOnlyFan = 3;

  uint64_t face = 0;     ///< as the file counts from 0
  uint32_t corners = 0;  ///< the face's corner count
  int axis = kOnlyFan;   ///< the triangles tile the outline as it is seen along this: 0, 1, 2
  std::vector<UVec3> triangles = {};  ///< corners by their place in the face; none for an only fan
};

/// How the faces of more than three corners became triangles.
struct Polygons {
  uint64_t clipped = 0;       ///< faces that are not convex: triangulated by their outline
  uint64_t fanned = 0;        ///< faces measured as the fan of their corners
  uint64_t first_fanned = 0;  ///< the first fanned face, as the file counts from 0
  /// Whether the outline of that face crosses itself, encloses no area or is too intricate.
  PolygonKind first_kind = PolygonKind::kFan;
  /// Any triangulation of the same outlines is as near to this mesh, both ways: corners that lie in
  /// no plane leave it open. Faces that have only a fan are among them if they are slivers.
  double ambiguity = 0;
  uint64_t ambiguous_face = 0;     ///< the first with this ambiguity, as the file counts from 0
  bool any_triangulation = false;  ///< Mesh::delta has the ambiguity: ReadLimits has the same
  /// Holds one for each face that was clipped or fanned, in their order: a certificate has them.
  std::vector<Triangulation> triangulations = {};
};

/// Coordinates are float64, so that float32 and float64 input are both held exactly. Face i is the
/// i-th triangle of the input (polygons triangulated in place); degenerate and duplicate faces
/// stay. Points alone are faces whose three corners are one vertex: the set is the same.
struct Mesh {
  std::string name;  ///< the file's path, or what a caller named it; starts every error line
  std::vector<DVec3> vertices;
  std::vector<UVec3> faces;
  FileFaces file_faces = {};  ///< the file's face of each of them, for people
  MeshCounts counts;
  Polygons polygons = {};
  /// The surface is at most this far from the exact one, both ways: rounding by a reader beyond "as
  /// given", such as a scene's transforms, moves each vertex by at most this, and polygons of any
  /// triangulation add their ambiguity. h is 1-Lipschitz in it, and the certified interval is wider
  /// by it.
  double delta = 0;
  std::optional<PlacedFrom> placed = {};  ///< a user put it elsewhere than its file has it: place()
  bool has_all_bodies = false;            ///< every shape of a scene was read, printed or not
  bool are_points = false;                ///< no surface: face i is the point vertices[i]
  std::string unit = {};  ///< the coordinates', if the file has it: "m", "mm", "in"; else empty
};

/// The memory of a mesh: 24 bytes a vertex, 12 a face.
inline uint64_t mesh_bytes(uint64_t vertex_count, uint64_t face_count) {
  return sizeof(DVec3) * vertex_count + sizeof(UVec3) * face_count;
}
inline uint64_t mesh_bytes(const Mesh& mesh) {
  return mesh_bytes(mesh.vertices.size(), mesh.faces.size());
}

/// Throws InputError that names the element if a coordinate is not finite, an index is out of
/// range, there is no face, `delta` is not a finite number of 0 or more, `file_faces` do not fit
/// the number of triangles, or face i of points is not the point i. Solver checks every mesh this
/// way, since a caller may write anything into one.
void check_mesh(const Mesh& mesh);

/// Throws UsageError if the interval covers every triangulation of A's or B's polygons, and `what`,
/// such as an area, would be of the one that was made.
void refuse_any_triangulation(const Mesh& a, const Mesh& b, const std::string& what);

/// Checks and cleans a mesh: drops unreferenced vertices, counts degenerate and duplicate faces.
/// Throws InputError that names the element if a referenced coordinate is not finite, an index is
/// out of range or there is no face. `faces` index into `vertices`.
Mesh make_mesh(std::string name, std::vector<DVec3> vertices, std::vector<UVec3> faces);

/// Makes a mesh of points alone: every point is a face of its own, in their order. Points at one
/// position are not counted: a scan has many, and a table of 100 million takes longer than reading
/// them. Throws InputError that names the point if a coordinate is not finite, or if there is no
/// point.
Mesh make_points(std::string name, std::vector<DVec3> points);

/// Throws UsageError that names `option` if the mesh is points, which have no `lacks`.
void refuse_points(const Mesh& mesh, const std::string& option, const std::string& lacks);

}  // namespace vkh
