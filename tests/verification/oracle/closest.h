// Closest points in double precision: on a triangle, on a mesh by brute force, and on a mesh by a
// tree of boxes. The kernel tests and the reference solver measure against them.
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "vkhausdorff/mesh.h"

namespace vkh::test {

/// The closest point of triangle abc, which may be a segment or a point. Stable on needles, slivers
/// and caps: the distance from p to the result is within a few 2^-53 * (|p - a| + the longest
/// edge) of the true distance.
glm::dvec3 closest_point_on_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                     const glm::dvec3& c);
double point_triangle_distance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                               const glm::dvec3& c);

struct MeshPoint {
  glm::dvec3 point;  ///< closest point on the mesh
  double distance;   ///< from the query to it
  uint32_t face;     ///< the first face at that distance
};

/// Brute force over all faces.
MeshPoint closest_point_on_mesh(const glm::dvec3& p, const Mesh& mesh);
double point_mesh_distance(const glm::dvec3& p, const Mesh& mesh);

/// A triangle prepared for many closest points: its corner `a` is the one of the largest angle, so
/// that the two edges at it are nearly dependent in caps only.
struct PreparedTriangle {
  glm::dvec3 a, ab, ac, bc;
  glm::dvec3 to_v, to_w;  ///< (p-a).to_v, (p-a).to_w are the foot's barycentrics; 0 if collinear
  double inverse_ab, inverse_ac, inverse_bc;  ///< of squared lengths; 0 if the edge is a point
  double noise;  ///< rounding of a barycentric of an offset r is below noise * |r|
  bool flat;     ///< so nearly collinear that no barycentric shows the foot to be inside

  PreparedTriangle(const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& p2);
  /// p minus the closest point.
  glm::dvec3 offset(const glm::dvec3& p) const;
  double distance(const glm::dvec3& p) const { return glm::length(offset(p)); }
};

struct Nearest {
  double squared = std::numeric_limits<double>::infinity();
  uint32_t face = 0xffffffffu;
};

/// Axis-aligned boxes over triangles, split at the median of the longest axis of the centroids.
class ClosestTree {
 public:
  ClosestTree(const std::vector<glm::dvec3>& points, const std::vector<glm::uvec3>& faces);

  const PreparedTriangle& triangle(uint32_t face) const { return triangles_[face]; }
  /// Improves `best` to one face.
  void try_face(const glm::dvec3& p, uint32_t face, Nearest& best) const;
  /// Improves `best`, which may come from hints, to the closest face.
  void query(const glm::dvec3& p, Nearest& best) const { visit(0, p, best); }

 private:
  struct Box {
    glm::dvec3 lo, hi;
  };
  struct Node {
    Box box;
    uint32_t first;  ///< a leaf's first place in order_, or the right child (the left is next)
    uint32_t count;  ///< faces of a leaf, 0 inside
  };

  uint32_t build(const std::vector<Box>& boxes, uint32_t first, uint32_t end);
  void visit(uint32_t at, const glm::dvec3& p, Nearest& best) const;

  std::vector<PreparedTriangle> triangles_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace vkh::test
