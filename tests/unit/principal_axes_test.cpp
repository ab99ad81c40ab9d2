// A surface's principal axes against closed forms, for different triangles of it.
#include "host/mesh/principal_axes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/shapes/shapes.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using doctest::Approx;

TEST_CASE("a square has the axes of its points, in however many triangles") {
  for (const uint32_t cells : {1U, 7U, 300U}) {  // of the last, several blocks
    const PrincipalAxes m = principal_axes_of(square_patch(cells, 5, 2));
    CHECK(m.area == Approx(4));
    CHECK(glm::distance(glm::dvec3(m.centroid), {1, 1, 5}) < 1e-12);
    CHECK(std::abs(m.variances[0]) < 1e-12);
    CHECK(m.variances[1] == Approx(1.0 / 3));  // of an edge e: e^2 / 12
    CHECK(m.variances[2] == Approx(1.0 / 3));
    CHECK(std::abs(m.axes[0].z) == Approx(1));
  }
}

TEST_CASE("a brick's axes are its edges, wherever it lies") {
  // A face of area w at +-h/2 adds h^2/4 there, and the faces beside it h^2/12.
  Mesh brick = cube(0.5);
  for (DVec3& v : brick.vertices) v = glm::dvec3(v) * glm::dvec3(4, 2, 1);
  const double x = 2 * 2 * 1, y = 2 * 4 * 1, z = 2 * 4 * 2;  // areas of the faces across each axis
  const double area = x + y + z;
  const PrincipalAxes m =
      principal_axes_of(translated(rotated(brick, {0, 1, 0}, 0.5), {1000, -2000, 3000}));
  CHECK(m.area == Approx(area));
  CHECK(m.variances[0] == Approx((z / 4 + (x + y) / 12) / area));
  CHECK(m.variances[1] == Approx(4 * (y / 4 + (x + z) / 12) / area));
  CHECK(m.variances[2] == Approx(16 * (x / 4 + (y + z) / 12) / area));
  CHECK(glm::distance(glm::dvec3(m.centroid), {1000, -2000, 3000}) < 1e-9);
  CHECK(std::abs(m.axes[1].y) == Approx(1));
  CHECK(std::abs(m.axes[2].x) == Approx(std::cos(0.5)));
}

TEST_CASE("a surface of no area, or of figures too large, has no axes") {
  for (const Mesh& mesh : {single_triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2}),
                           single_triangle({0, 0, 0}, {1e200, 0, 0}, {0, 1e200, 0})}) {
    const PrincipalAxes m = principal_axes_of(mesh);
    CHECK(m.variances == DVec3{0, 0, 0});
    CHECK(!turn_between(m, m));
    const PrincipalAxes other = principal_axes_of(square_patch(1, 0));
    CHECK(!turn_between(m, other));
    CHECK(!turn_between(other, m));
  }
}

}  // namespace
