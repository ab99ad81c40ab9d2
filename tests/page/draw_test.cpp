// Pictures of small meshes: their visible contents, for any driver.
#include "host/show/draw.h"

#include <doctest/doctest.h>

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

#include <array>
#include <cmath>

#include "host/show/mapped_picture.h"
#include "vkhausdorff/error.h"

namespace {

using namespace vkh;

constexpr Rgb kStripe{74, 64, 51};

/// Two faces, each on its side of x = 0, seen whole from above.
Mesh two_faces() {
  return make_mesh("two",
                   {{-1, 0, 0}, {-0.1, -1, 0}, {-0.1, 1, 0}, {1, 0, 0}, {0.1, -1, 0}, {0.1, 1, 0}},
                   {{0, 1, 2}, {3, 5, 4}});
}

PictureOptions from_above() {
  PictureOptions options;
  options.width = 800;
  options.height = 500;
  options.view = parse_view("--view", "0,0,1");
  return options;
}

Rgb at(const Image& image, uint32_t x, uint32_t y) {
  const uint8_t* p = &image.rgba[4 * (size_t{y} * image.width + x)];
  return {p[0], p[1], p[2]};
}

/// Whether two colours differ by no more than a palette's steps and a device round them.
bool is_near(Rgb one, Rgb two) {
  const auto is_near = [](uint8_t x, uint8_t y) { return std::abs(x - y) <= 2; };
  return is_near(one.red, two.red) && is_near(one.green, two.green) && is_near(one.blue, two.blue);
}

/// The colour that a picture without a map has for a distance.
Rgb colour_of(const Picture& picture, const PictureOptions& options, double distance) {
  return drawing::MappedPicture(picture, options).scale->colour(distance);
}

/// Statistics of the pixels among the views, left of the legend, that have the colour.
struct Found {
  size_t count = 0;
  double x = 0, y = 0;  ///< their mean
};
Found find(const Image& image, Rgb colour) {
  Found found;
  for (uint32_t y = image.height / 8; y < image.height * 3 / 4; ++y) {
    for (uint32_t x = 0; x < image.width * 2 / 3; ++x) {
      if (!is_near(at(image, x, y), colour)) continue;
      ++found.count;
      found.x += x;
      found.y += y;
    }
  }
  found.x /= static_cast<double>(found.count);
  found.y /= static_cast<double>(found.count);
  return found;
}

TEST_CASE("without a map a face has the colour of the middle of its bounds") {
  const Mesh mesh = two_faces();
  const Field field{{0.24, 1}, {0.26, 1}};
  const Picture picture{.mesh = mesh, .field = field, .interval = {0.9, 1}};
  for (const ColourMap map : {ColourMap::kViridis, ColourMap::kBatlow, ColourMap::kCividis}) {
    PictureOptions options = from_above();
    options.map = map;
    const Image image = draw(picture, options);
    CHECK(image.width == options.width);
    CHECK(image.rgba.size() == size_t{4} * options.width * options.height);
    const Found left = find(image, colour_of(picture, options, 0.25));
    const Found right = find(image, colour_of(picture, options, 1));
    CHECK(left.count > 8000);
    CHECK(right.count > 8000);
    CHECK(left.x + 50 < right.x);
    CHECK(std::abs(left.y - right.y) < 5);
    CHECK(find(image, kStripe).count == 0);
  }
}

TEST_CASE("a range is the same for each picture of a batch") {
  const Mesh mesh = two_faces();
  const Field field{{0.25, 4}, {0.25, 4}};
  const Picture picture{.mesh = mesh, .field = field, .interval = {3, 4}};
  PictureOptions options = from_above();
  options.range = Enclosure{0, 0.5};
  const Image image = draw(picture, options);
  CHECK(find(image, map_colour(ColourMap::kViridis, 0.5)).count > 8000);
  CHECK(find(image, drawing::kOver).count > 8000);
}

TEST_CASE("a face without a bound is hatched") {
  const Mesh mesh = two_faces();
  const Field field{{1, 0}, {1, std::numeric_limits<double>::infinity()}};
  const Picture picture{
      .mesh = mesh, .field = field, .interval = {0, std::numeric_limits<double>::infinity()}};
  const Image image = draw(picture, from_above());
  CHECK(find(image, kStripe).count > 1500);
  CHECK(find(image, colour_of(picture, from_above(), 1)).count > 8000);
}

TEST_CASE("the same picture has the same bytes") {
  const Mesh mesh = two_faces();
  const Field field{{0, 0}, {0.25, 1}};
  const Picture picture{.mesh = mesh,
                        .field = field,
                        .interval = {0.9, 1},
                        .witness = Witness{{1, {1, 0, 0}, {1, 0, 0}}, {0, {}, {1, 0, 1}}},
                        .unit = "mm",
                        .name = "a.stl",
                        .against = "b.stl"};
  for (const View::Kind kind : {View::Kind::kIso, View::Kind::kSix}) {
    PictureOptions options = from_above();
    options.view.kind = kind;
    CHECK(draw(picture, options).rgba == draw(picture, options).rgba);
  }
}

TEST_CASE("meshes and bounds without extent are drawn") {
  const std::array<Mesh, 3> meshes = {
      make_mesh("triangle", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}),
      make_mesh("segment", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}),
      make_mesh("point", {{5, 5, 5}}, {{0, 0, 0}})};
  for (const Mesh& mesh : meshes) {
    for (const double h : {0.0, 1e-9, 1e6, 5e-324}) {
      const Field field{{h}, {h}};
      Picture picture{.mesh = mesh, .field = field, .interval = {h, h}};
      const SurfacePoint p{0, {1, 0, 0}, mesh.vertices[0]};
      picture.witness = Witness{p, p};
      const Image image = draw(picture, from_above());
      const Rgb colour = colour_of(picture, from_above(), h);
      if (mesh.name == "triangle") CHECK(find(image, colour).count > 10000);
    }
  }
}

TEST_CASE("a coordinate far from the origin keeps its place") {
  Mesh mesh = two_faces();
  for (glm::dvec3& v : mesh.vertices) v = v * 0x1p-10 + glm::dvec3(0x1p20, -0x1p20, 0x1p19);
  const Field field{{0.25, 1}, {0.25, 1}};
  const Picture picture{.mesh = mesh, .field = field, .interval = {0.9, 1}};
  const Image image = draw(picture, from_above());
  const Found left = find(image, colour_of(picture, from_above(), 0.25));
  CHECK(left.count > 8000);
  CHECK(left.x + 50 < find(image, colour_of(picture, from_above(), 1)).x);
}

// The mesh has more faces than are uploaded at once: 2^19.
TEST_CASE("of many faces the first and the last are drawn") {
  const auto side = uint32_t{520};
  std::vector<glm::dvec3> vertices;
  std::vector<glm::uvec3> faces;
  for (uint32_t i = 0; i <= side; ++i) {
    for (uint32_t j = 0; j <= side; ++j) vertices.emplace_back(i, j, 0);
  }
  for (uint32_t i = 0; i < side; ++i) {
    for (uint32_t j = 0; j < side; ++j) {
      const uint32_t v = i * (side + 1) + j, w = v + side + 1;
      faces.insert(faces.end(), {{v, w, w + 1}, {v, w + 1, v + 1}});
    }
  }
  const Mesh mesh = make_mesh("grid", vertices, faces);
  Field field{std::vector<double>(faces.size(), 0), std::vector<double>(faces.size(), 0)};
  for (size_t face = 0; face < faces.size(); ++face) {
    if (face >= size_t{1} << 19) field.lower[face] = field.upper[face] = 1;
  }
  const Picture picture{.mesh = mesh, .field = field, .interval = {1, 1}};
  const Image image = draw(picture, from_above());
  const Found first = find(image, colour_of(picture, from_above(), 0));
  CHECK(first.count > 20000);
  const Found last = find(image, colour_of(picture, from_above(), 1));
  CHECK(last.count > 500);
  CHECK(last.x > first.x);
}

TEST_CASE("steps of colour are as many as was asked for") {
  const Mesh mesh = two_faces();
  const Field field{{0.26, 0.49}, {0.26, 0.49}};  // of one band
  const Picture picture{.mesh = mesh, .field = field, .interval = {0.4, 1}};
  PictureOptions options = from_above();
  options.bands = 4;
  const Image image = draw(picture, options);
  CHECK(find(image, colour_of(picture, options, 0.3)).count > 16000);
}

TEST_CASE("a picture of any size has room for all of it") {
  const Mesh mesh = two_faces();
  const Field field{{0, 0}, {1, std::numeric_limits<double>::infinity()}};
  Picture picture{.mesh = mesh, .field = field, .interval = {0, 1}};
  picture.caption.assign(40, std::string(300, 'x') + " " + std::string(300, 'y'));
  for (const char* size : {"640x400", "640x2000", "2000x400"}) {
    PictureOptions options = from_above();
    options.range = Enclosure{0, 0.5};
    parse_picture_size("--size", size, options);
    CHECK(find(draw(picture, options), kStripe).count > 300);
  }
}

TEST_CASE("another program reads the PNG") {
  const Mesh mesh = two_faces();
  const Field field{{0, 0}, {0.25, 1}};
  const Image image = draw({.mesh = mesh, .field = field, .interval = {0.9, 1}}, from_above());
  const std::string file = encode_png(image);
  int width = 0, height = 0, channels = 0;
  uint8_t* pixels =
      stbi_load_from_memory(reinterpret_cast<const uint8_t*>(file.data()),
                            static_cast<int>(file.size()), &width, &height, &channels, 4);
  REQUIRE(pixels != nullptr);
  CHECK(width == 800);
  CHECK(height == 500);
  CHECK(channels == 3);
  CHECK(std::equal(image.rgba.begin(), image.rgba.end(), pixels));
  stbi_image_free(pixels);
}

TEST_CASE("what makes no sense is refused") {
  const Mesh mesh = two_faces();
  const Field field{{0, 0}, {0.25, 1}}, short_one{{0}, {1}};
  const Picture picture{.mesh = mesh, .field = field, .interval = {0.9, 1}};
  CHECK_THROWS_AS(draw({.mesh = mesh, .field = short_one, .interval = {}}), std::invalid_argument);
  PictureOptions options = from_above();
  options.width = 100;
  CHECK_THROWS_AS(draw(picture, options), UsageError);
  options = from_above();
  options.range = Enclosure{2, 1};
  CHECK_THROWS_AS(draw(picture, options), UsageError);
  options.range = Enclosure{0, std::numeric_limits<double>::infinity()};
  CHECK_THROWS_AS(draw(picture, options), UsageError);
  Mesh vast = mesh;
  for (glm::dvec3& v : vast.vertices) v *= 1e200;
  CHECK_THROWS_AS(draw({.mesh = vast, .field = field, .interval = {}}), UsageError);
}

}  // namespace
