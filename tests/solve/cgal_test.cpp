// The reference solver and whole runs against CGAL's distance of bounded error. All three enclose
// h(A, B), so that any two intervals must meet.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "tests/shapes/shapes.h"
#include "tests/support/solver_bench.h"
#include "tests/verification/oracle/reference_solver.h"

namespace {

using namespace vkh;
using namespace vkh::test;

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

/// The bounded-error distance with an absolute error that is asked for. Nothing where CGAL cannot
/// hold a mesh: one with degenerate faces. It works in double precision and certifies nothing, but
/// is written independently.
std::optional<Interval> cgal_hausdorff(const Mesh& a, const Mesh& b, double error) {
  const std::optional<Surface> surface_a = make_surface(a);
  const std::optional<Surface> surface_b = make_surface(b);
  if (!surface_a || !surface_b) return std::nullopt;
  const double estimate = processing::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(
      *surface_a, *surface_b, error);
  return Interval{std::max(0.0, estimate - error), estimate + error};
}

void check_run(const Mesh& a, const Mesh& b) {
  const double size = diagonal(joined(a, b));
  const std::optional<Interval> cgal = cgal_hausdorff(a, b, 1e-4 * size);
  REQUIRE(cgal);
  const Report r = solver().distance(a, b);
  CHECK(r.lower <= r.upper);
  if (r.status == Status::kClosed) CHECK(r.upper - r.lower <= r.tolerance);
  const Interval ours = interval(r);
  CAPTURE(ours.lower);
  CAPTURE(ours.upper);
  CAPTURE(cgal->lower);
  CAPTURE(cgal->upper);
  CHECK(ours.meets(*cgal));
}

}  // namespace

TEST_CASE("the reference solver agrees") {
  struct Pair {
    Mesh a, b;
  };
  const Mesh ball = icosphere(1.0, 2);
  const std::vector<Pair> pairs = {
      {square_patch(6, 0.0), square_patch(4, 0.25)},
      {v_lid(), v_sheet(1.5, 0.3)},
      {v_sheet(1.5, 0.3), v_lid()},
      {cube(1.0), rotated(cube(1.2), {1, 1, 0}, 0.5)},
      {ball, uv_sphere(1.0, 9, 14)},
      {ball, noisy(ball, 0.02, 3)},
      {height_field(16, 1), height_field(16, 2)},
      {height_field(16, 2), height_field(16, 1)},
      {noisy(height_field(12, 2), 1e-3, 1), height_field(12, 1)},
      {torus(1.0, 0.3, 24, 12), torus(1.0, 0.3, 12, 6)},
      {torus(1.0, 0.3, 12, 6), torus(1.0, 0.3, 24, 12)},
      {torus(1.0, 0.3, 16, 8), translated(torus(1.0, 0.3, 16, 8), {0.01, 0.02, 0.03})},
      {soup(1, 20), soup(2, 30)},
      {ball, translated(cube(0.6), {0.2, 0.1, 0.0})},
  };
  for (const Pair& pair : pairs) {
    const double error = 1e-4 * diagonal(pair.a);
    const auto cgal = cgal_hausdorff(pair.a, pair.b, error);
    CAPTURE(pair.a.name);
    CAPTURE(pair.b.name);
    REQUIRE(cgal.has_value());
    const Interval ours = reference_hausdorff(pair.a, pair.b, 1e-3 * error);
    CAPTURE(ours.lower);
    CAPTURE(ours.upper);
    CAPTURE(cgal->lower);
    CAPTURE(cgal->upper);
    CHECK(ours.meets(*cgal));
  }
}

TEST_CASE("it declines what it cannot hold") {
  CHECK_FALSE(cgal_hausdorff(degenerate_faces(1, 9), cube(1.0), 1e-3).has_value());
  CHECK_FALSE(cgal_hausdorff(cube(1.0), degenerate_faces(1, 9), 1e-3).has_value());
}

TEST_CASE("whole runs agree") {
  check_run(v_lid(), v_sheet());
  check_run(cube(0.5), icosphere(0.75, 2));
  check_run(icosphere(0.75, 2), cube(0.5));
  check_run(height_field(16, 1), height_field(16, 4));
  check_run(height_field(16, 4), height_field(16, 1));
  check_run(torus(1.0, 0.3, 24, 12), noisy(torus(1.0, 0.3, 24, 12), 0.02, 1));
  for (uint64_t seed = 0; seed < 4; ++seed) {
    CAPTURE(seed);
    check_run(soup(seed, 20), soup(100 + seed, 20));
    check_run(noisy(icosphere(1.0, 1), 0.1, seed), noisy(icosphere(1.0, 1), 0.1, seed + 50));
  }
}
