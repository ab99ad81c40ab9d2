#include "tests/verification/oracle/cgal_oracle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <vector>

namespace vkh::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

std::optional<Surface> make_surface(const Mesh& mesh) {
  std::vector<Kernel::Point_3> points;
  for (const glm::dvec3& v : mesh.vertices) points.emplace_back(v.x, v.y, v.z);
  std::vector<std::array<size_t, 3>> faces;
  for (const glm::uvec3& f : mesh.faces) {
    if (CGAL::collinear(points[f.x], points[f.y], points[f.z])) return std::nullopt;
    faces.push_back({f.x, f.y, f.z});
  }
  if (!processing::is_polygon_soup_a_polygon_mesh(faces)) {
    // Duplicates the vertices of non-manifold edges: the geometry stays as it is.
    processing::orient_polygon_soup(points, faces);
    if (!processing::is_polygon_soup_a_polygon_mesh(faces)) return std::nullopt;
  }
  Surface surface;
  processing::polygon_soup_to_polygon_mesh(points, faces, surface);
  return surface;
}

}  // namespace

std::optional<Interval> cgal_hausdorff(const Mesh& a, const Mesh& b, double error) {
  const std::optional<Surface> surface_a = make_surface(a);
  const std::optional<Surface> surface_b = make_surface(b);
  if (!surface_a || !surface_b) return std::nullopt;
  const double estimate = processing::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(
      *surface_a, *surface_b, error);
  return Interval{std::max(0.0, estimate - error), estimate + error};
}

}  // namespace vkh::test
