// Samples of a surface: as many as are asked for, on it, spread by area, the same each time.
#include "host/mesh/area_samples.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "host/mesh/principal_axes.h"
#include "tests/shapes/shapes.h"

namespace {

using namespace vkh;
using namespace vkh::test;

TEST_CASE("each half of a surface has its share of the samples") {
  // Two squares, of areas 1 and 3, and none of a face without area between them.
  Mesh mesh = joined(square_patch(5, 0), single_triangle({9, 9, 9}, {9, 9, 9}, {9, 9, 9}));
  mesh = joined(mesh, square_patch(1, 2, std::sqrt(3.0)));
  const std::vector<DVec3> samples = area_samples(mesh, 4000);
  CHECK(samples.size() == 4000);
  size_t below = 0, between = 0;
  glm::dvec3 sum{};
  for (const DVec3& p : samples) {
    below += p.z == 0 ? 1 : 0;
    between += p.z != 0 && p.z != 2 ? 1 : 0;
    sum += glm::dvec3(p);
  }
  CHECK(between == 0);
  CHECK(below >= 999);  // one of each stretch
  CHECK(below <= 1001);
  const glm::dvec3 centroid = principal_axes_of(mesh).centroid;
  CHECK(glm::distance(sum / 4000.0, centroid) < 0.02);
}

TEST_CASE("samples of a triangle lie in it, and are spread over it") {
  const Mesh mesh = single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  size_t near_corner[3] = {};
  for (const DVec3& p : area_samples(mesh, 9000)) {
    CHECK((p.x >= 0 && p.y >= 0 && p.x + p.y <= 1 + 1e-15));
    near_corner[0] += p.x + p.y < 0.5 ? 1 : 0;
    near_corner[1] += p.x > 0.5 ? 1 : 0;
    near_corner[2] += p.y > 0.5 ? 1 : 0;
  }
  for (const size_t count : near_corner) {  // a quarter of the area each
    CHECK(count > 2100);
    CHECK(count < 2400);
  }
}

TEST_CASE("the same mesh has the same samples") {
  const Mesh mesh = soup(3, 50);
  CHECK(area_samples(mesh, 100) == area_samples(mesh, 100));
}

TEST_CASE("where there is no area, faces weigh alike") {
  Mesh points = joined(single_triangle({1, 0, 0}, {1, 0, 0}, {1, 0, 0}),
                       single_triangle({2, 0, 0}, {2, 0, 0}, {2, 0, 0}));
  size_t first = 0;
  for (const DVec3& p : area_samples(points, 10)) first += p.x == 1 ? 1 : 0;
  CHECK(first == 5);
  CHECK(area_samples(single_triangle({0, 0, 0}, {1e200, 0, 0}, {0, 1e200, 0}), 7).size() == 7);
}

TEST_CASE("points have the axes of what they are spread over") {
  Mesh brick = cube(0.5);
  for (DVec3& v : brick.vertices) v = glm::dvec3(v) * glm::dvec3(4, 2, 1);
  const Mesh mesh = translated(rotated(brick, {0, 1, 0}, 0.5), {1000, -2000, 3000});
  const PrincipalAxes whole = principal_axes_of(mesh);
  const PrincipalAxes sampled = principal_axes_of(area_samples(mesh, 20'000));
  CHECK(sampled.area == 0);
  CHECK(glm::distance(glm::dvec3(sampled.centroid), glm::dvec3(whole.centroid)) < 0.02);
  for (int i = 0; i < 3; ++i) {
    CHECK(std::abs(sampled.variances[i] - whole.variances[i]) < 0.01 * whole.variances[2]);
    CHECK(std::abs(glm::dot(sampled.axes[i], whole.axes[i])) > 0.999);
  }
  CHECK(principal_axes_of(std::span<const DVec3>()).variances[2] == 0);
}

}  // namespace
