// The rasterizer: what is in front, edges that two faces share, discs, and the same bytes on any
// number of threads.
#include "host/show/raster.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/shapes/shapes.h"

namespace {

using namespace vkh;
using namespace vkh::drawing;

constexpr uint32_t kWidth = 150, kHeight = 90;  // parts of tiles, too

using Face = std::array<Corner, 3>;

Corner corner(double x, double y, double z, std::array<uint8_t, 3> colour) {
  Corner c;
  c.colour[0] = colour[0];
  c.colour[1] = colour[1];
  c.colour[2] = colour[2];
  return c.placed_at({x, y, z});
}

Layer drawn(const std::vector<Face>& faces) {
  const Palette palette;
  return rasterized({.width = kWidth, .height = kHeight, .line = 1, .palette = palette},
                    faces.size(), [&](size_t first, size_t count, Corner* corners) {
                      for (size_t i = 0; i < 3 * count; ++i)
                        corners[i] = faces[first + i / 3][i % 3];
                    });
}

std::array<uint8_t, 4> at(const Layer& layer, uint32_t x, uint32_t y) {
  std::array<uint8_t, 4> pixel{};
  std::copy_n(&layer.rgba[4 * (size_t{y} * layer.width + x)], 4, pixel.begin());
  return pixel;
}

/// The pixels that faces cover, as a number.
double covered(const Layer& layer) {
  double sum = 0;
  for (size_t i = 3; i < layer.rgba.size(); i += 4) sum += layer.rgba[i] / 255.0;
  return sum;
}

constexpr std::array<uint8_t, 3> kRed{200, 0, 0}, kBlue{0, 0, 200};

Face triangle(std::array<glm::dvec2, 3> p, double z, std::array<uint8_t, 3> colour) {
  return {corner(p[0].x, p[0].y, z, colour), corner(p[1].x, p[1].y, z, colour),
          corner(p[2].x, p[2].y, z, colour)};
}

TEST_CASE("the nearer face is in front, whichever comes first") {
  const Face near = triangle({{{10, 10}, {140, 10}, {10, 80}}}, 0.25, kRed);
  const Face far = triangle({{{10, 10}, {140, 10}, {10, 80}}}, 0.75, kBlue);
  for (const std::vector<Face>& faces : {std::vector{near, far}, std::vector{far, near}}) {
    const Layer layer = drawn(faces);
    CHECK(at(layer, 30, 30) == std::array<uint8_t, 4>{200, 0, 0, 255});
    CHECK(at(layer, 140, 80) == std::array<uint8_t, 4>{255, 255, 255, 0});
  }
}

TEST_CASE("both sides of a face are drawn, and a face without area is not") {
  const Face one = triangle({{{10, 10}, {140, 10}, {10, 80}}}, 0.5, kRed);
  const Face back{one[0], one[2], one[1]}, none{one[0], one[0], one[1]};
  CHECK(drawn({one}).rgba == drawn({back}).rgba);
  CHECK(covered(drawn({none})) == 0);
  CHECK(covered(drawn({})) == 0);
}

// Faces around a point tile a box: each sample is of one of them, where edges are shared, too.
TEST_CASE("a sample on a shared edge is of one face") {
  test::Random random(7);
  for (int run = 0; run < 20; ++run) {
    const glm::dvec2 middle(random.range(20, 130), random.range(15, 75));
    const std::array<glm::dvec2, 4> box{{{8, 4}, {136, 4}, {136, 84}, {8, 84}}};
    double sum = 0;
    std::vector<Face> all;
    for (size_t i = 0; i < box.size(); ++i) {
      all.push_back(triangle({middle, box[i], box[(i + 1) % 4]}, 0.5, kRed));
      sum += covered(drawn({all.back()}));
    }
    const Layer layer = drawn(all);
    CHECK(covered(layer) == 128 * 80);
    CHECK(at(layer, 8, 4)[3] == 255);
    CHECK(at(layer, 135, 83)[3] == 255);
    CHECK(at(layer, 136, 84)[3] == 0);
    CHECK(std::abs(sum - 128 * 80) < 8);  // each pixel's share is rounded
  }
}

// All edges of two halves of a square pass through samples.
TEST_CASE("a sample on an edge is counted once") {
  const double x = 8.125, y = 4.125, side = 64;
  const Face one = triangle({{{x, y}, {x + side, y}, {x + side, y + side}}}, 0.5, kRed);
  const Face two = triangle({{{x, y}, {x + side, y + side}, {x, y + side}}}, 0.5, kRed);
  CHECK(std::abs(covered(drawn({one, two})) - side * side) < 1);
  CHECK(std::abs(covered(drawn({one})) + covered(drawn({two})) - side * side) < 1);
}

TEST_CASE("a disc is the circle in its triangle") {
  std::vector<Face> faces{triangle({{{75, 5}, {109.641016, 65}, {40.358984, 65}}}, 0.5, kRed)};
  for (Corner& c : faces[0]) c.is_disc = 1;
  const Layer layer = drawn(faces);
  constexpr double kPi = 3.14159265358979;
  CHECK(std::abs(covered(layer) - kPi * 20 * 20) < 0.01 * kPi * 20 * 20);
  CHECK(at(layer, 75, 45) == std::array<uint8_t, 4>{200, 0, 0, 255});
  CHECK(at(layer, 75, 63)[0] < 180);  // the rim is darker
}

TEST_CASE("any number of threads draws the same bytes") {
  test::Random random(3);
  std::vector<Face> faces;
  for (int i = 0; i < 40000; ++i) {
    std::array<glm::dvec2, 3> p;
    const glm::dvec2 middle(random.range(-20, 170), random.range(-20, 110));
    for (glm::dvec2& one : p) one = middle + glm::dvec2(random.range(-9, 9), random.range(-9, 9));
    const auto shade = static_cast<uint8_t>(random.below(256));
    faces.push_back(triangle(p, random.below(8) / 8.0, {shade, 0, 0}));  // many are as far
  }
  limit_threads(1);
  const Layer one = drawn(faces);
  limit_threads(5);
  CHECK(drawn(faces).rgba == one.rgba);
  limit_threads(0);
  CHECK(covered(one) > kWidth * kHeight * 0.99);
}

}  // namespace
