// Decimation loses no bound, and steps lie on neither side.
#include "host/show/page_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "host/show/page_figures.h"
#include "tests/page/invented.h"
#include "tests/shapes/shapes.h"

namespace {

using vkh::Mesh;

// Tiny triangles that share nothing: each vanishes in its cell, and another face has to stand for
// it.
Mesh scattered(size_t count) {
  vkh::test::Random random(7);
  std::vector<glm::dvec3> vertices;
  std::vector<glm::uvec3> faces;
  for (size_t i = 0; i < count; ++i) {
    const glm::dvec3 at = random.in_cube(10);
    const auto first = static_cast<uint32_t>(vertices.size());
    for (int corner = 0; corner < 3; ++corner) vertices.push_back(at + random.in_cube(1e-3));
    faces.emplace_back(first, first + 1, first + 2);
  }
  return vkh::make_mesh("scattered", vertices, faces);
}

Mesh one_point(size_t count) {
  const std::vector<glm::dvec3> vertices(3, glm::dvec3(4));
  return vkh::make_mesh("point", vertices, std::vector<glm::uvec3>(count, glm::uvec3(0, 1, 2)));
}

void check_encloses(const Mesh& mesh, size_t most) {
  const vkh::Field field = vkh::test::invented_field(mesh, 1);
  const vkh::Shown shown = vkh::shown_of(mesh, most);
  const vkh::Field of_shown = field_of(shown, field);
  CHECK(shown.faces.size() <= most);
  CHECK(shown.is_decimated == (mesh.faces.size() > most));
  REQUIRE(shown.face_of.size() == mesh.faces.size());
  std::vector<double> upper(shown.faces.size(), -1), lower(shown.faces.size(), 2);
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const size_t by = shown.face_of[f];
    REQUIRE(by < shown.faces.size());
    CHECK(of_shown.upper[by] >= field.upper[f]);
    CHECK(of_shown.lower[by] <= field.lower[f]);
    upper[by] = std::max(upper[by], field.upper[f]);
    lower[by] = std::min(lower[by], field.lower[f]);
  }
  CHECK(of_shown.upper == upper);  // no wider than that, and every shown face stands for one
  CHECK(of_shown.lower == lower);
  for (const glm::uvec3& face : shown.faces) {
    CHECK(std::max({face.x, face.y, face.z}) < shown.vertices.size());
  }
  for (const glm::dvec3& v : shown.vertices) {
    for (int i = 0; i < 3; ++i) CHECK((v[i] >= 0 && v[i] <= 1));
  }
}

TEST_CASE("every face is enclosed by the one shown face that stands for it") {
  const Mesh torus = vkh::test::torus(20, 6, 120, 60);
  for (const size_t most : {1u, 2u, 10u, 500u, 5000u, 14400u}) check_encloses(torus, most);
  for (const size_t most : {1u, 100u, 3000u}) check_encloses(scattered(4000), most);
  check_encloses(one_point(50), 7);
  check_encloses(vkh::test::square_patch(80, 1), 900);
}

TEST_CASE("a decimated mesh uses most of the faces that it may have") {
  const Mesh torus = vkh::test::torus(20, 6, 400, 200);
  for (const size_t most : {2000u, 20000u}) {
    const size_t faces = vkh::shown_of(torus, most).faces.size();
    CHECK(faces > most / 2);
  }
}

TEST_CASE("coordinates whose differences overflow have a place, too") {
  const double far = std::numeric_limits<double>::max();
  const Mesh mesh = vkh::test::single_triangle({-far, 0, 0}, {far, 0, 0}, {0, far, 0});
  const vkh::Place place = vkh::place_of(mesh);
  for (const glm::dvec3& v : mesh.vertices) {
    for (int i = 0; i < 3; ++i) CHECK((place.unit(v)[i] >= 0 && place.unit(v)[i] <= 2));
  }
}

TEST_CASE("steps ascend from 0 to the largest distance, few and short") {
  for (const double top : {1e-300, 3e-7, 0.0441, 1.0, 9.99, 12345.0, 1e300}) {
    const std::vector<vkh::Step> steps = vkh::tolerance_steps(top, top, std::nullopt);
    CHECK(steps.front().value == 0);
    CHECK(steps.back().limit.within >= top);
    CHECK(steps.size() < 2000);
    for (size_t k = 1; k < steps.size(); ++k) {
      CHECK(steps[k].value > steps[k - 1].value);
      CHECK(steps[k].limit.within < steps[k].limit.beyond);
      CHECK(steps[k].label.size() <= 12);
      CHECK(std::stod(steps[k].label) == steps[k].value);
    }
  }
  CHECK(vkh::tolerance_steps(0, 0, std::nullopt).size() == 1);
}

TEST_CASE("steps are even up to a finer end, and reach the largest distance all the same") {
  const std::vector<vkh::Step> steps = vkh::tolerance_steps(100, 0.15, std::nullopt);
  CHECK(steps.back().limit.within >= 100);
  CHECK(std::count_if(steps.begin(), steps.end(), [](const vkh::Step& step) {
          return step.is_linear && step.value <= 0.15;
        }) > 500);
  CHECK(std::none_of(steps.begin(), steps.end(),
                     [](const vkh::Step& step) { return step.is_linear && step.value > 0.16; }));
}

TEST_CASE("the limit that was asked about is a step, as it was asked") {
  const vkh::Limit odd = {0.123456, 0.123457},
                   round = {std::nextafter(0.1, 0), std::nextafter(0.1, 1)};
  for (const vkh::Limit& limit : {odd, round, vkh::Limit{7, 7.1}}) {
    const std::vector<vkh::Step> steps = vkh::tolerance_steps(1, 1, limit);
    CHECK(std::count_if(steps.begin(), steps.end(), [&](const vkh::Step& step) {
            return step.limit.within == limit.within && step.limit.beyond == limit.beyond;
          }) == 1);
  }
}

TEST_CASE("a limit in the place of the last step leaves none out") {
  const double top = 0.5;
  const std::vector<vkh::Step> steps =
      vkh::tolerance_steps(top, top, vkh::Limit{0.4999999, 0.50001});
  CHECK(steps.back().limit.within >= top);
  for (size_t k = 1; k < steps.size(); ++k) {
    CHECK(steps[k].limit.within > steps[k - 1].limit.within);
    CHECK(steps[k].limit.beyond > steps[k - 1].limit.beyond);
  }
}

TEST_CASE("a face's steps are the verdicts of all steps") {
  const std::vector<vkh::Step> steps = vkh::tolerance_steps(1, 1, vkh::Limit{0.5, 0.6});
  vkh::test::Random random(3);
  for (int i = 0; i < 500; ++i) {
    const double lower = i % 7 == 0 ? 0 : random.unit(), upper = std::max(lower, random.unit());
    const vkh::FaceSteps at = steps_of({lower, upper}, steps);
    for (size_t k = 0; k < steps.size(); ++k) {
      CHECK((k >= at.within) == (upper <= steps[k].limit.within));
      CHECK((k < at.beyond) == (lower > steps[k].limit.beyond));
    }
  }
}

}  // namespace
