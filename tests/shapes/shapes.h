// Meshes whose distances are known, and meshes that are hard to get right. Everything is seeded:
// the same call gives the same mesh wherever libm rounds sin, cos and pow alike.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <utility>

#include "vkhausdorff/mesh.h"

namespace vkh::test {

/// Uniform numbers from a seed, without the standard distributions (they differ between libraries).
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  uint64_t bits();                         ///< 64 random bits (splitmix64)
  double unit();                           ///< in [0, 1)
  double range(double lo, double hi);      ///< in [lo, hi)
  uint32_t below(uint32_t count);          ///< in 0..count-1
  glm::dvec3 in_cube(double half_extent);  ///< each coordinate in [-half_extent, half_extent)
  glm::dvec3 direction();                  ///< a unit vector

 private:
  uint64_t state_;
};

// --- Shapes with closed forms ---

/// [0, size]^2 at height z, cells x cells squares of two triangles each.
Mesh square_patch(uint32_t cells, double z, double size = 1.0);
/// [-half_extent, half_extent]^2 at height z, two triangles.
Mesh big_plane(double half_extent, double z = 0.0);
Mesh single_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
/// [-half_extent, half_extent]^3, twelve triangles, outward.
Mesh cube(double half_extent);
/// Subdivided icosahedron, vertices on the sphere; 20 * 4^subdivisions faces.
Mesh icosphere(double radius, uint32_t subdivisions);
/// stacks x slices sphere with triangle fans at the poles.
Mesh uv_sphere(double radius, uint32_t stacks, uint32_t slices);
Mesh torus(double major_radius, double minor_radius, uint32_t major_cells, uint32_t minor_cells);

/// 'V' against its hull over the footprint [-1, 1]^2. All vertices of the lid lie on the sheet, so
/// sampling A's vertices gives 0 while h(lid, sheet) = v_lid_distance(depth, valley_x).
Mesh v_lid();
/// The two sides that fall from the rim x = -1 and x = 1 to the valley line x = valley_x, z =
/// -depth.
Mesh v_sheet(double depth = 1.5, double valley_x = 0.0);
/// h(lid, sheet); 1.5 / sqrt(3.25) = 0.832 as the parameters stand. h(sheet, lid) is the depth.
double v_lid_distance(double depth = 1.5, double valley_x = 0.0);

// --- Twins: near-zero distances as remeshing makes them ---

/// A smooth height field on cells x cells squares of [0, 1]^2, sampled at every stride-th vertex.
/// height_field(n, 2) is the decimated twin of height_field(n, 1): all its vertices lie on it.
Mesh height_field(uint32_t cells, uint32_t stride, double amplitude = 0.1);

// --- Hard shapes ---

/// count random triangles of every size in [-1, 1]^3, not connected.
Mesh soup(uint64_t seed, uint32_t count);
/// One short edge, aspect 1e2 .. 1e12.
Mesh needles(uint64_t seed, uint32_t count);
/// A vertex close to the opposite edge, near one of its ends or anywhere: heights 1e-2 .. 1e-12.
Mesh slivers(uint64_t seed, uint32_t count);
/// A vertex close to the middle of the opposite edge (an angle near 180 degrees).
Mesh caps(uint64_t seed, uint32_t count);
/// Points, segments with a repeated corner and three distinct collinear corners, one after the
/// other.
Mesh degenerate_faces(uint64_t seed, uint32_t count);
/// The mesh with a tenth of its faces (at least one) repeated, with corners rotated or flipped.
Mesh with_duplicates(const Mesh& mesh, uint64_t seed);
/// The faces of both, in one mesh.
Mesh joined(const Mesh& a, const Mesh& b);

// --- Metamorphic changes ---

Mesh translated(const Mesh& mesh, const glm::dvec3& by);
Mesh rotated(const Mesh& mesh, const glm::dvec3& axis, double angle);
/// Scaled by 2^exponent: exact, so distances scale exactly.
Mesh scaled(const Mesh& mesh, int exponent);
/// The same geometry: vertices and faces shuffled, corners rotated (orientation is kept).
Mesh permuted(const Mesh& mesh, uint64_t seed);
/// Each vertex moved by less than amplitude (in length).
Mesh noisy(const Mesh& mesh, double amplitude, uint64_t seed);
/// Coordinates rounded to float32.
Mesh in_float32(const Mesh& mesh);

// --- Measures of a mesh ---

std::pair<glm::dvec3, glm::dvec3> bounding_box(const Mesh& mesh);  ///< lo, hi
double diagonal(const Mesh& mesh);
std::array<glm::dvec3, 3> corners(const Mesh& mesh, uint32_t face);

struct NamedPair {
  std::string name;
  Mesh a, b;
};

}  // namespace vkh::test
