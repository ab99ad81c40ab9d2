// shaders/report/split.h: halves and middles are those of math/dyadic.h, and cells on a line at
// which the distance bends are split along it.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "shaders/report/split.h"
#include "tests/shapes/shapes.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using lib::vec3;

lib::Corners corners(const std::array<vec3, 3>& p) { return {p[0], p[1], p[2]}; }

// Distances of the corners of a triangle from four planes, affine over it.
using Planes = std::array<std::function<float(const vec3&)>, 4>;

lib::Distances distances(const Planes& from, const lib::Corners& t) {
  lib::Distances d{};
  for (size_t k = 0; k < 4; ++k) d.from[k] = vec3(from[k](t.a), from[k](t.b), from[k](t.c));
  return d;
}

uint32_t split_for(const Planes& from, const lib::Corners& t) {
  const lib::Distances at = distances(from, t), middles = distances(from, lib::middles_of(t));
  const uint32_t x = lib::edge_to_halve(t, at, middles);
  return lib::split_from(x, t, at, middles, distances(from, lib::fresh_middles(t, x)));
}

std::array<lib::Corners, 4> parts(const lib::Corners& t, uint32_t split) {
  const uint32_t code = split - 1;
  std::array<lib::Corners, 4> all;
  for (uint32_t k = 0; k < 4; ++k) {
    const lib::Corners half = lib::half_of(t, code % 3, k / 2);
    all[k] = lib::half_of(half, k < 2 ? code / 3 % 3 : code / 9, k % 2);
  }
  return all;
}

TEST_CASE("split.h: halves, their corners and their middles are those of dyadic.h") {
  const auto at = [](const glm::uvec2& p) { return vec3(p.x, p.y, 0) / float(gpu::kBaryOne); };
  const auto place = [&](const lib::Bary3& t) { return corners({at(t.a), at(t.b), at(t.c)}); };
  const lib::Corners whole = place(lib::whole_root());
  // The distances say where a point is.
  const auto x = [](const vec3& p) { return p.x; };
  const auto y = [](const vec3& p) { return p.y; };
  const Planes where{x, y, x, y};
  const auto same = [&](const lib::Distances& d, const lib::Corners& t) {
    const lib::Distances right = distances(where, t);
    for (size_t k = 0; k < 4; ++k) CHECK(d.from[k] == right.from[k]);
  };
  const lib::Distances of = distances(where, whole);
  const lib::Distances middles = distances(where, lib::middles_of(whole));
  for (uint32_t split = 1; split <= 27; ++split) {
    const lib::Bary6 points = lib::split_points(lib::whole_root(), split);
    const std::array<lib::Corners, 4> found = parts(whole, split);
    for (uint32_t k = 0; k < 4; ++k) {
      const lib::Corners right = place(lib::child_of(points, lib::child_points(split, k)));
      CHECK(found[k].a == right.a);
      CHECK(found[k].b == right.b);
      CHECK(found[k].c == right.c);
    }
  }
  for (uint32_t i = 0; i < 3; ++i) {
    const lib::Distances fresh = distances(where, lib::fresh_middles(whole, i));
    for (uint32_t side = 0; side < 2; ++side) {
      const lib::Corners half = lib::half_of(whole, i, side);
      same(lib::corners_of_half(of, middles, i, side), half);
      same(lib::middles_of_half(fresh, middles, i, side), lib::middles_of(half));
    }
  }
}

TEST_CASE("split.h: where nothing is to gain, the longest edges are halved") {
  const auto flat = [](const vec3& p) { return 1 + 0.3f * p.x + 0.2f * p.y; };
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const auto any = [&] { return vec3(random.range(-1, 1), random.range(-1, 1), 0); };
    const lib::Corners t{any(), any(), any()};
    CHECK(split_for({flat, flat, flat, flat}, t) == lib::split_as_shaped(t));
  }
}

TEST_CASE("split.h: a needle's longest edge is halved, whatever that leaves") {
  const lib::Corners needle{{0, 0, 0}, {1, 0, 0}, {0.5f, 0.05f, 0}};
  const auto bent = [](const vec3& p) { return std::abs(p.y - 0.02f); };
  CHECK((split_for({bent, bent, bent, bent}, needle) - 1) % 3 == 2);
}

// How many cells a line passes through, and their area, after that many splits of each.
struct OnLine {
  size_t cells;
  double area;
};

double area_of(const lib::Corners& t) {
  const vec3 e = t.b - t.a, f = t.c - t.a;
  return 0.5 * std::abs(static_cast<double>(e.x * f.y - e.y * f.x));
}

OnLine on_line(const std::function<float(const vec3&)>& over,
               const std::function<uint32_t(const lib::Corners&)>& split, int splits) {
  std::vector<lib::Corners> cells{{{0, 0, 0}, {1, 0.1f, 0}, {0.2f, 0.9f, 0}}};
  for (int i = 0; i < splits; ++i) {
    std::vector<lib::Corners> next;
    for (const lib::Corners& cell : cells) {
      for (const lib::Corners& part : parts(cell, split(cell))) {
        const auto [least, most] = std::minmax({over(part.a), over(part.b), over(part.c)});
        if (least < -1e-6f && most > 1e-6f) next.push_back(part);
      }
    }
    cells = next;
  }
  double area = 0;
  for (const lib::Corners& cell : cells) area += area_of(cell);
  return {cells.size(), area};
}

TEST_CASE("split.h: cells on a bend are split along it, and become few") {
  Random random(7);
  double area = 0, as_shaped = 0;
  size_t cells = 0, shaped_cells = 0;
  for (int i = 0; i < 100; ++i) {
    const auto turn = static_cast<float>(random.range(0, 6.28));
    const auto shift = static_cast<float>(random.range(-0.2, 0.2));
    const auto over = [=](const vec3& p) {
      return std::cos(turn) * (p.x - 0.4f) + std::sin(turn) * (p.y - 0.3f) + shift;
    };
    // One triangle under a ridge; two planes of which each serves its side; A through B.
    const auto bent = [=](const vec3& p) { return 0.2f + 0.3f * std::max(over(p), 0.0f); };
    const auto left = [=](const vec3& p) { return 0.2f + 0.3f * over(p); };
    const auto right = [=](const vec3& p) { return 0.2f - 0.3f * over(p); };
    const auto through = [=](const vec3& p) { return std::abs(over(p)); };
    for (const Planes& planes : {Planes{bent, bent, bent, bent}, Planes{left, right, left, right},
                                 Planes{through, through, through, through}}) {
      const OnLine found = on_line(
          over, [&](const lib::Corners& t) { return split_for(planes, t); }, 4);
      area += found.area;
      cells += found.cells;
      const OnLine shaped = on_line(over, lib::split_as_shaped, 4);
      as_shaped += shaped.area;
      shaped_cells += shaped.cells;
    }
  }
  MESSAGE(cells << " cells for " << shaped_cells << ", area " << area << " for " << as_shaped);
  CHECK(2 * cells < shaped_cells);
  CHECK(2 * area < as_shaped);
}

}  // namespace
