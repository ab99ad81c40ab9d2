// Worst places are regions about peaks that are proven, the worst first.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "host/show/page_places.h"
#include "tests/page/invented.h"
#include "tests/shapes/shapes.h"

namespace {

using vkh::Field;
using vkh::Mesh;
using vkh::WorstPlace;

glm::dvec3 middle_of(const Mesh& mesh, size_t face) {
  const glm::uvec3& f = mesh.faces[face];
  return mesh.vertices[f.x] / 3.0 + mesh.vertices[f.y] / 3.0 + mesh.vertices[f.z] / 3.0;
}

struct Bump {
  glm::dvec3 at;
  double height, radius;
};

// The sum of bumps that fall off like a bell; each bound is its value to within a hundredth.
Field bumpy(const Mesh& mesh, const std::vector<Bump>& bumps) {
  Field field;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    double value = 0;
    for (const Bump& bump : bumps) {
      const double away = glm::distance(middle_of(mesh, f), bump.at) / bump.radius;
      value += bump.height * std::exp(-away * away);
    }
    field.lower.push_back(value);
    field.upper.push_back(1.01 * value);
  }
  return field;
}

// A square of 20 x 20, in faces a quarter long.
Mesh patch() { return vkh::test::square_patch(80, 0, 20); }

size_t face_at(const Mesh& mesh, double x, double y) {
  size_t best = 0;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto away = [&](size_t face) {
      return glm::distance(middle_of(mesh, face), glm::dvec3(x, y, 0));
    };
    if (away(f) < away(best)) best = f;
  }
  return best;
}

TEST_CASE("one dent of many faces is one place, and each of two dents is") {
  const Mesh mesh = patch();
  const glm::dvec3 a(5, 6, 0), b(15, 12, 0);
  const Field one = bumpy(mesh, {{a, 0.3, 1.5}});
  const std::vector<WorstPlace> single = vkh::worst_places(mesh, one, {});
  REQUIRE(single.size() == 1);
  CHECK(glm::distance(single[0].point, a) < 0.5);
  CHECK(single[0].faces == mesh.faces.size());
  const std::vector<WorstPlace> two =
      vkh::worst_places(mesh, bumpy(mesh, {{a, 0.2, 1.5}, {b, 0.3, 1.5}}), {});
  REQUIRE(two.size() == 2);
  CHECK(glm::distance(two[0].point, b) < 0.5);
  CHECK(glm::distance(two[1].point, a) < 0.5);
  CHECK(two[0].faces + two[1].faces == mesh.faces.size());
}

TEST_CASE("two peaks of one region are one place while the ground between them is high") {
  const Mesh mesh = patch();
  const glm::dvec3 a(9, 10, 0), b(11, 10, 0);
  CHECK(vkh::worst_places(mesh, bumpy(mesh, {{a, 0.3, 1.3}, {b, 0.25, 1.3}}), {}).size() == 1);
  CHECK(vkh::worst_places(mesh, bumpy(mesh, {{a, 0.3, 0.7}, {b, 0.25, 0.7}}), {}).size() == 2);
  CHECK(
      vkh::worst_places(mesh, bumpy(mesh, {{a, 0.3, 0.7}, {b, 0.25, 0.7}}), {.apart = 3}).size() ==
      1);
}

TEST_CASE("a bound that is not proven is no place, however large its upper end is") {
  const Mesh mesh = patch();
  const size_t peak = face_at(mesh, 7, 8);
  Field field = bumpy(mesh, {{middle_of(mesh, peak), 0.3, 1.5}});
  field.upper.assign(field.upper.size(), 1e9);
  const std::vector<WorstPlace> places = vkh::worst_places(mesh, field, {});
  REQUIRE(places.size() == 1);
  CHECK(places[0].face == peak);
  field.lower.assign(field.lower.size(), 0);
  CHECK(vkh::worst_places(mesh, field, {}).empty());
}

TEST_CASE("the farthest point that was found is the place itself") {
  const Mesh mesh = patch();
  const size_t peak = face_at(mesh, 7, 8), beside = peak + 1;
  const Field field = bumpy(mesh, {{middle_of(mesh, peak), 0.3, 1.5}});
  vkh::PlaceOptions options;
  options.found = vkh::FoundPoint{beside, {1, 2, 3}, {0.4, 0.41}};
  const std::vector<WorstPlace> places = vkh::worst_places(mesh, field, options);
  REQUIRE(places.size() == 1);
  CHECK(places[0].face == beside);
  CHECK(places[0].point == glm::dvec3(1, 2, 3));
  CHECK(places[0].distance.lower == 0.4);
}

TEST_CASE("places fall, are apart, few, and cover the face of the largest lower bound") {
  const Mesh mesh = vkh::test::torus(20, 6, 120, 60);
  const Field field = vkh::test::invented_field(mesh, 1);
  const std::vector<WorstPlace> places = vkh::worst_places(mesh, field, {.most = 4, .apart = 3});
  REQUIRE(!places.empty());
  CHECK(places.size() <= 4);
  CHECK(places[0].distance.lower == *std::max_element(field.lower.begin(), field.lower.end()));
  for (size_t i = 0; i < places.size(); ++i) {
    CHECK(places[i].distance.upper == field.upper[places[i].face]);
    CHECK(length(places[i].normal) == doctest::Approx(1));
    for (size_t j = 0; j < i; ++j) {
      CHECK(distance(places[i].point, places[j].point) >= 3);
      CHECK(places[i].distance.lower <= places[j].distance.lower);
    }
  }
}

}  // namespace
