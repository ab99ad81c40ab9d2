// shaders/report/cell.h against exact arithmetic: over a cell, the bounds from a few hard triangles
// enclose the distance, in any arithmetic that Vulkan allows.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "tests/verification/model/exact_lib.h"
#include "tests/verification/model/lib_device.h"

#ifdef VKH_TEST_VULKAN_MODEL
#define float ::vkh::model::Real
#endif
#include "shaders/report/cell.h"
#undef float

#include "tests/support/tally.h"
#include "tests/verification/math/cell_cases.h"
#include "tests/verification/oracle/closest.h"

using namespace vkh;
using namespace vkh::test;

namespace {

struct CellAnswer {
  glm::vec3 lower, upper;
  double highest, mean, square, reached;
};

CellAnswer gathered(const CellCase& c, const Device& device) {
  return device.run([&]() -> CellAnswer {
    const math::CellFrame t = cell_frame(c);
    std::vector<math::Surface> surfaces;
    for (const StoredTriangle& s : c.b)
      surfaces.push_back(math::make_surface(math::given(s.corner[0]), math::given(s.corner[1]),
                                            math::given(s.corner[2]), math::cell_view(t)));
    math::Gathered g = math::begin_gathering(t, surfaces[0], 0);
    for (uint32_t i = 0; i < surfaces.size(); ++i) g = math::gathered(g, t, surfaces[i], i);
    for (size_t i = 1; i < surfaces.size(); ++i) {
      g = math::cut_between(g, t, surfaces[i - 1], math::cell_distances(t, surfaces[i - 1]),
                            surfaces[i], math::cell_distances(t, surfaces[i]));
    }
    return {math::answer(math::lower_of(g, t)),
            math::answer(g.upper),
            math::wide(g.highest),
            math::wide(g.mean),
            math::wide(g.square),
            math::wide(math::reached_of(g))};
  });
}

/// Weights of T's corners, in quarters.
constexpr std::array<std::array<int, 3>, 10> kPoints = {{{4, 0, 0},
                                                         {0, 4, 0},
                                                         {0, 0, 4},
                                                         {2, 2, 0},
                                                         {0, 2, 2},
                                                         {2, 0, 2},
                                                         {2, 1, 1},
                                                         {1, 2, 1},
                                                         {1, 1, 2},
                                                         {3, 0, 1}}};
Weights quarters(const std::array<int, 3>& weights) {
  return {Rational(weights[0]) / 4, Rational(weights[1]) / 4, Rational(weights[2]) / 4};
}

Rational affine(const glm::vec3& at, const std::array<int, 3>& weights) {
  Rational sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += Rational(static_cast<double>(at[i])) * weights[static_cast<size_t>(i)];
  return sum / 4;
}

void check_points(const CellCase& c, const CellAnswer& got, Tally& tally, const auto& describe) {
  Rational largest = 0, farthest = 0;
  for (const std::array<int, 3>& weights : kPoints) {
    const Rational d2 = squared_distance(c, quarters(weights));
    const Rational lower = affine(got.lower, weights), upper = affine(got.upper, weights);
    tally.require(lower <= 0 || lower * lower <= d2, "lower(x) <= d(x, B)", describe);
    tally.require(upper >= 0 && upper * upper >= d2, "d(x, B) <= upper(x)", describe);
    tally.require(Rational(got.highest) * Rational(got.highest) >= d2, "d(x, B) <= highest",
                  describe);
    largest = std::max(largest, d2);
    tally.measure("looseness of highest / its size",
                  (got.highest - sqrt_near(largest)) / std::max(got.highest, 1e-30), describe);
  }
  for (size_t i = 0; i < 3; ++i)
    farthest = std::max(farthest, squared_distance(c, quarters(kPoints[i])));
  tally.require(Rational(got.reached) * Rational(got.reached) <= farthest,
                "some point is as far as reached", describe);
}

/// The error of the average over 256 equal parts' middles is less than their size.
void check_means(const CellCase& c, const CellAnswer& got, Tally& tally, const auto& describe) {
  constexpr int kParts = 16;
  const auto place = [&](const glm::uvec2& p) {
    const double v = static_cast<double>(p.x) / gpu::kBaryOne;
    const double w = static_cast<double>(p.y) / gpu::kBaryOne;
    return on_triangle(c.root, {1 - v - w, v, w});
  };
  const glm::dvec3 a = place(c.cell.a), ab = place(c.cell.b) - a, ac = place(c.cell.c) - a;
  double sum = 0, squares = 0, most = 0;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; j < 2 * (kParts - i) - 1; ++j) {
      const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
      const glm::dvec3 p = a + (i + third) / kParts * ab + (j / 2 + third) / kParts * ac;
      double d = std::numeric_limits<double>::infinity();
      for (const StoredTriangle& s : c.b)
        d = std::min(d, point_triangle_distance(p, s.at(0), s.at(1), s.at(2)));
      sum += d;
      squares += d * d;
      most = std::max(most, d);
    }
  }
  const double off = (glm::length(ab) + glm::length(ac)) / kParts + 1e-12 * (1 + most);
  const double mean = sum / (kParts * kParts), square = squares / (kParts * kParts);
  tally.require(got.mean >= mean - off, "the mean is at most mean", describe);
  tally.require(got.square >= square - 2 * (most + off) * off, "the mean square is at most square",
                describe);
}

}  // namespace

TEST_CASE("cell.h: what is gathered over a cell encloses the distance at every point of it") {
  const uint64_t count = case_count() / 20;
  Random random(20261123);
  Tally tally("cells");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const CellCase c = hard_case(random);
    const Device device(i);
    const CellAnswer got = gathered(c, device);
    const auto describe = [&] { return std::string(device.name()) + ": " + hex(c); };
    check_points(c, got, tally, describe);
    if (i % 8 == 0) check_means(c, got, tally, describe);
  }
  tally.conclude(count);
}

TEST_CASE("cell.h: means of affine functions, from both sides") {
  const uint64_t count = case_count();
  Random random(4);
  Tally tally("means");
  for (uint64_t i = 0; i < count && !tally.hopeless(); ++i) {
    const glm::vec3 v(random.in_cube(1.0)), size(std::abs(v.x), std::abs(v.y), std::abs(v.z));
    const Device device(i);
    const auto [down, up, square] = device.run([&]() -> std::array<double, 3> {
      return {math::wide(math::mean_down(math::given(v))),
              math::wide(math::mean_up(math::given(size))),
              math::wide(math::mean_square_up(math::given(size)))};
    });
    const auto exact_of = [](float x) { return Rational(static_cast<double>(x)); };
    const Rational x = exact_of(size.x), y = exact_of(size.y), z = exact_of(size.z);
    tally.require(3 * Rational(down) <= exact_of(v.x) + exact_of(v.y) + exact_of(v.z), "mean_down",
                  [] { return std::string(); });
    tally.require(3 * Rational(up) >= x + y + z, "mean_up", [] { return std::string(); });
    tally.require(6 * Rational(square) >= x * x + y * y + z * z + x * y + y * z + z * x,
                  "mean_square_up", [] { return std::string(); });
  }
  tally.conclude(count);
}
