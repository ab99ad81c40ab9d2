// Areas of faces against exact arithmetic, where products of doubles underflow, too.
#include <doctest/doctest.h>
#include <gmpxx.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "host/mesh/make_mesh.h"
#include "host/survey/statistics.h"

namespace vkh {
namespace {

using Corners = std::array<glm::dvec3, 3>;

Mesh mesh_of(const std::vector<Corners>& triangles) {
  std::vector<glm::dvec3> vertices;
  std::vector<glm::uvec3> faces;
  for (const Corners& t : triangles) {
    const auto first = static_cast<uint32_t>(vertices.size());
    vertices.insert(vertices.end(), t.begin(), t.end());
    faces.emplace_back(first, first + 1, first + 2);
  }
  return make_mesh("triangles", std::move(vertices), std::move(faces));
}

mpq_class power_of_two(int exponent) {
  mpq_class one = 1;
  if (exponent >= 0)
    mpq_mul_2exp(one.get_mpq_t(), one.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  if (exponent < 0)
    mpq_div_2exp(one.get_mpq_t(), one.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  return one;
}

// The square of twice the area, in the unit that is 2^exponent of the coordinates'.
mpq_class square_of(const Corners& t, int exponent) {
  mpq_class e[3], f[3], sum = 0;
  for (int k = 0; k < 3; ++k) {
    e[k] = (mpq_class(t[1][k]) - mpq_class(t[0][k])) * power_of_two(exponent);
    f[k] = (mpq_class(t[2][k]) - mpq_class(t[0][k])) * power_of_two(exponent);
  }
  for (int k = 0; k < 3; ++k) {
    const mpq_class c = e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3];
    sum += c * c;
  }
  return sum;
}

void check_areas(const std::vector<Corners>& triangles) {
  const Mesh mesh = mesh_of(triangles);
  const Areas areas = areas_of(mesh);
  for (size_t i = 0; i < triangles.size(); ++i) {
    CAPTURE(i);
    const mpq_class exact = square_of(triangles[i], areas.unit.exponent);
    const mpq_class least = 2 * (mpq_class(areas.of_face[i]) - mpq_class(areas.error));
    const mpq_class most = 2 * (mpq_class(areas.of_face[i]) + mpq_class(areas.error));
    if (least > 0) CHECK(least * least <= exact);
    CHECK(most * most >= exact);
  }
}

Corners random_triangle(std::mt19937& random, double size, double width) {
  std::uniform_real_distribution<double> part(-1, 1);
  const auto point = [&] { return glm::dvec3(part(random), part(random), part(random)); };
  const glm::dvec3 at = point() * size, along = point() * size, aside = point() * (size * width);
  return {at, at + along, at + along * 0.5 + aside};
}

}  // namespace

TEST_CASE("areas enclose the exact ones, of any size and any width") {
  std::mt19937 random(52);
  for (int i = 0; i < 400; ++i) {
    CAPTURE(i);
    const double size = std::ldexp(1.0, static_cast<int>(random() % 2000) - 1000);
    std::vector<Corners> triangles;
    for (int k = 0; k < 5; ++k)
      triangles.push_back(
          random_triangle(random, size, std::ldexp(1.0, -static_cast<int>(random() % 600))));
    check_areas(triangles);
  }
}

TEST_CASE("small faces have an area, whatever their size; needles too thin for doubles have none") {
  for (const double size : {1.0, 1e-78, 1e-200, 1e150}) {
    const Areas areas = areas_of(mesh_of({{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}}}));
    CHECK(areas.is_positive());
    const double half = areas.unit.to_frame(size) * areas.unit.to_frame(size) / 2;
    CHECK(areas.whole == doctest::Approx(half).epsilon(1e-14));
  }
  const Areas needle = areas_of(mesh_of({{{{0, 0, 0}, {1, 0, 0}, {0, 1e-155, 0}}}}));
  CHECK(needle.is_positive());
  CHECK(needle.whole ==
        doctest::Approx(needle.unit.to_frame(1) * needle.unit.to_frame(1) * 5e-156).epsilon(1e-14));
  CHECK(!areas_of(mesh_of({{{{0, 0, 0}, {1, 0, 0}, {0, 1e-250, 0}}}})).is_positive());
  CHECK(!areas_of(mesh_of({{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}}})).is_positive());
}

}  // namespace vkh
