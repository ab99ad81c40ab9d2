// The renderer in frames: its intervals against the CPU reference, its faces' errors against the
// host's survey, its choice of level, its pictures, their colours, and its caption as read from
// them; and a chain of simplify's.
#include "examples/renderer/renderer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_THREAD_LOCALS
#include <stb/stb_image.h>

#include "examples/renderer/chain.h"
#include "examples/renderer/font.h"
#include "examples/renderer/view.h"
#include "tests/shapes/shapes.h"
#include "tests/support/api_bench.h"
#include "tests/support/program.h"
#include "tests/support/solver_bench.h"

namespace {

using namespace vkh;
using namespace vkh::test;
using example::RenderedFrame;
using example::Renderer;

constexpr uint32_t kWidth = 320, kHeight = 240;

bool validation() {
  const char* value = std::getenv("VKH_VALIDATION");
  return value != nullptr && *value != '\0';
}

Renderer& renderer() {
  static Renderer one({.width = kWidth,
                       .height = kHeight,
                       .cells_u = 48,
                       .cells_v = 24,
                       .validation = validation()});
  return one;
}

Mesh mesh_of(Renderer& r, uint32_t level) {
  Mesh mesh;
  for (const example::SceneVertex& v : r.vertices(level))
    mesh.vertices.emplace_back(v.position[0], v.position[1], v.position[2]);
  const std::vector<uint32_t> corners = r.scene().indices(level);
  for (size_t i = 0; i < corners.size(); i += 3)
    mesh.faces.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
  return mesh;
}

struct Pixel {
  int r, g, b;
  bool operator==(const Pixel&) const = default;
};
Pixel pixel(const RenderedFrame& f, uint32_t x, uint32_t y) {
  const uint8_t* p = f.rgba + 4 * (y * kWidth + x);
  return {p[0], p[1], p[2]};
}

/// The character in a cell of the caption: the one whose dots are white and whose others are not.
char read_character(const RenderedFrame& f, uint32_t left, uint32_t top) {
  for (char c = ' '; c <= '_'; ++c) {
    const example::Glyph rows = example::glyph(c);
    bool matches = c == ' ' || rows != example::glyph(' ');
    for (uint32_t y = 0; y < example::kGlyphRows && matches; ++y) {
      for (uint32_t x = 0; x < example::kGlyphColumns && matches; ++x) {
        const bool white = pixel(f, left + x, top + y) == Pixel{255, 255, 255};
        matches = white == ((rows[y] >> (4 - x) & 1) != 0);
      }
    }
    if (matches) return c;
  }
  return '?';
}

std::string read_row(Renderer& r, const RenderedFrame& f, uint32_t row) {
  REQUIRE(r.text_scale() == 1);
  const uint32_t left = (kWidth - 6 * example::kColumns) / 2;
  const auto top = static_cast<uint32_t>(r.caption_part().offset.y) + 2 + 10 * row + 1;
  std::string text;
  for (uint32_t column = 0; column < example::kColumns; ++column)
    text += read_character(f, left + 6 * column, top);
  return text;
}

/// The picture's text for level k: "... H IN lower..upper ..." holds the report's interval.
void check_row(const std::string& text, const VkhReport& report) {
  CAPTURE(text);
  const size_t at = text.find("H IN ");
  REQUIRE(at != std::string::npos);
  const double lower = std::strtod(text.substr(at + 5, 7).c_str(), nullptr);
  const double upper = std::strtod(text.substr(at + 14, 7).c_str(), nullptr);
  CHECK(lower <= static_cast<double>(report.lower));
  CHECK(upper >= static_cast<double>(report.upper));
  CHECK(upper - lower <= static_cast<double>(report.upper - report.lower) + 3e-5);
  CHECK(lower > 0);
}

/// By how many pixels a level is off where it is off by most, at `time`.
float pixels_off(Renderer& r, uint32_t level, float time, float camera) {
  const auto rows = static_cast<uint32_t>(r.caption_part().offset.y);
  const glm::vec3 towards = example::to_eye(0.6f + 0.1f * time);
  const Mesh finest = mesh_of(r, 0);
  const std::vector<float> errors = r.errors(level);
  float most = 0;
  for (size_t i = 0; i < finest.faces.size(); ++i) {
    float depth = camera;
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 corner = finest.vertices[finest.faces[i][k]];
      depth = std::min(depth, camera - glm::dot(corner, towards));
    }
    most = std::max(most, errors[finest.faces.size() + i] / example::pixel_at(depth, rows));
  }
  return most;
}

/// The colour of x in mesh.frag's map, in linear light.
glm::vec3 colour_of(float x) {
  const glm::vec3 low(0.24f, 0.27f, 0.62f), middle(0.10f, 0.62f, 0.58f), high(0.99f, 0.88f, 0.18f);
  const glm::vec3 base =
      x < 0.5f ? glm::mix(low, middle, 2 * x) : glm::mix(middle, high, 2 * x - 1);
  return glm::pow(base, glm::vec3(2.2f));
}

/// The sine of the angle between two colours without their grey: light and gloss do not change it.
float hue_apart(glm::vec3 a, glm::vec3 b) {
  a -= (a.x + a.y + a.z) / 3;
  b -= (b.x + b.y + b.z) / 3;
  return glm::length(glm::cross(a, b)) / std::max(glm::length(a) * glm::length(b), 1e-9f);
}

/// The places of corners in a square picture, and their depths.
std::vector<glm::vec3> projected(const Mesh& mesh, const glm::mat4& matrix, uint32_t side) {
  std::vector<glm::vec3> places;
  for (const DVec3& v : mesh.vertices) {
    const glm::vec4 p = matrix * glm::vec4(glm::vec3(v), 1);
    places.push_back({(p.x / p.w + 1) / 2 * static_cast<float>(side),
                      (p.y / p.w + 1) / 2 * static_cast<float>(side), p.z / p.w});
  }
  return places;
}

/// Whether triangle a b c has p, and there a depth that is less than p's.
bool hides(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 p) {
  const auto turn = [](glm::vec3 u, glm::vec3 v) { return u.x * v.y - u.y * v.x; };
  const float whole = turn(b - a, c - a);
  const float u = turn(p - a, c - a) / whole, v = turn(b - a, p - a) / whole;
  return u >= 0 && v >= 0 && u + v <= 1 && a.z + u * (b.z - a.z) + v * (c.z - a.z) < p.z - 1e-5f;
}

/// Pixels of the large view that are not background, and different colours in the whole picture.
struct Seen {
  size_t covered = 0;
  std::set<int> colours;
};
Seen look(Renderer& r, const RenderedFrame& f) {
  Seen seen;
  const auto bottom = static_cast<uint32_t>(r.caption_part().offset.y);
  const uint32_t right = kWidth - bottom / 2;
  const Pixel background = pixel(f, 0, 0);
  for (uint32_t y = 0; y < bottom; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const Pixel p = pixel(f, x, y);
      seen.covered += x < right && p != background;
      seen.colours.insert(p.r << 16 | p.g << 8 | p.b);
    }
  }
  return seen;
}

struct Picture {
  int width = 0, height = 0, channels = 0;
  size_t colours = 0;
};

Picture load(const std::string& path) {
  Picture p;
  uint8_t* pixels = stbi_load(path.c_str(), &p.width, &p.height, &p.channels, 4);
  REQUIRE_MESSAGE(pixels != nullptr, path);
  std::set<uint32_t> colours;
  for (int i = 0; i < p.width * p.height; ++i)
    colours.insert(uint32_t{pixels[4 * i]} << 16 | uint32_t{pixels[4 * i + 1]} << 8 |
                   pixels[4 * i + 2]);
  p.colours = colours.size();
  stbi_image_free(pixels);
  return p;
}

void write_obj(const std::string& path, const Mesh& mesh) {
  std::ofstream out(path);
  out.precision(17);
  for (const DVec3& v : mesh.vertices) out << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const UVec3& f : mesh.faces)
    out << "f " << f.x + 1 << ' ' << f.y + 1 << ' ' << f.z + 1 << '\n';
}

constexpr double kTorusRadius = 2.5;  // of torus(2, 0.5, ..), from its axis

/// Writes a torus, two coarser ones and their distances as simplify's JSON has them.
std::string write_chain(std::vector<double>& errors) {
  const Mesh meshes[] = {torus(2, 0.5, 96, 32), torus(2, 0.5, 48, 16), torus(2, 0.5, 24, 8)};
  std::ostringstream files;
  files.precision(17);
  for (int k = 0; k < 3; ++k) {
    const std::string name = "level" + std::to_string(k) + ".obj";
    write_obj(folder() / name, meshes[k]);
    if (k == 0) continue;
    errors.push_back(std::max(reference_hausdorff(meshes[0], meshes[k], 1e-4).upper,
                              reference_hausdorff(meshes[k], meshes[0], 1e-4).upper));
    files << (k == 1 ? "" : ",") << R"({"path":")" << name << R"(","upper":)" << errors.back()
          << '}';
  }
  const std::string path = folder() / "chain.json";
  std::ofstream(path) << R"({"input":{"path":"level0.obj"},"files":[)" << files.str() << "]}";
  return path;
}

}  // namespace

TEST_CASE("a chain's frames draw the coarsest level whose proven error is under a pixel") {
  std::vector<double> errors;
  example::ChainRenderer r({.width = kWidth, .height = kHeight, .validation = validation()},
                           example::read_chain(write_chain(errors)));
  std::set<uint32_t> drawn;
  size_t covered = kWidth * kHeight;
  for (const float camera : {1.6f, 3.0f, 12.0f, 30.0f}) {
    CAPTURE(camera);
    const example::ChainFrame f = r.frame(0.5f, camera);
    // A pixel in the files' units: the torus has half of a diagonal of so much.
    const double radius = std::hypot(kTorusRadius, kTorusRadius, 0.5);
    const double pixel = static_cast<double>(f.pixel) * radius;
    uint32_t coarsest = 0;
    for (uint32_t k = 1; k <= errors.size(); ++k)
      if (errors[k - 1] < pixel) coarsest = k;
    CHECK(f.drawn == coarsest);
    CHECK(f.faces == 2 * (96u >> coarsest) * (32u >> coarsest));
    drawn.insert(f.drawn);
    size_t seen = 0;
    for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i)
      seen += std::memcmp(f.rgba + 4 * i, f.rgba, 4) != 0;
    CHECK(seen > 20);
    CHECK(seen < covered);  // the camera moves away
    covered = seen;
  }
  CHECK(drawn.size() == 3);
  CHECK(r.gpu().validation_messages() == 0);
}

TEST_CASE("a chain that is none is refused by name") {
  const std::string path = folder() / "none.json";
  std::ofstream(path) << "{}";
  const Outcome outcome = run({"--chain", path});
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.err.find("simplify --levels") != std::string::npos);
}

TEST_CASE("frames: intervals against the reference, the level, the picture and its caption") {
  Renderer& r = renderer();
  std::set<uint32_t> drawn;
  size_t covered = kWidth * kHeight;
  const float cameras[] = {2.6f, 8.0f, 16.0f, 45.0f};
  for (uint32_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    const RenderedFrame f = r.frame(i, 0.3f * static_cast<float>(i), cameras[i]);
    const Seen seen = look(r, f);
    for (uint32_t row = 0; row < example::kRows; ++row)
      CHECK(read_row(r, f, row) == f.caption[row]);
    CHECK(f.caption[0].substr(0, 10) == "FRAME 00" + std::to_string(i) + " ");
    for (uint32_t k = 1; k < example::kLevels; ++k) check_row(f.caption[k], f.reports[k - 1]);
    drawn.insert(f.drawn);
    CHECK(seen.covered > 60);
    CHECK(seen.covered < covered);  // the camera moves away
    CHECK(seen.colours.size() > 300);
    covered = seen.covered;
    uint32_t coarsest = 0;
    const Mesh finest = mesh_of(r, 0);  // last: it submits
    for (uint32_t k = 1; k < example::kLevels; ++k) {
      CAPTURE(k);
      check_true(f.reports[k - 1], reference_hausdorff(finest, mesh_of(r, k), 1e-5));
      const float off = pixels_off(r, k, 0.3f * static_cast<float>(i), cameras[i]);
      if (off < 1) coarsest = k;
      const size_t at = f.caption[k].find(" PX");
      REQUIRE(at != std::string::npos);
      CHECK(std::stof(f.caption[k].substr(at - 5, 5)) ==
            doctest::Approx(std::min(off, 99.99f)).epsilon(0.012));
    }
    CHECK(f.drawn == coarsest);
  }
  CHECK(drawn.size() >= 3);
  CHECK(r.gpu().validation_messages() == 0);
}

TEST_CASE("faces have the errors that the host's survey finds, and narrow ones") {
  Renderer& r = renderer();
  const RenderedFrame f = r.frame(0, 0.7f, 8);
  const Mesh finest = mesh_of(r, 0);
  for (uint32_t k = 1; k < example::kLevels; ++k) {
    CAPTURE(k);
    const std::vector<float> errors = r.errors(k);
    const Field field = surveyed(finest, mesh_of(r, k), {.faces = true}).field;
    const size_t faces = finest.faces.size();
    REQUIRE(errors.size() == 2 * faces);
    size_t apart = 0;
    double least = 0, most = 0, known = 0;
    for (size_t i = 0; i < faces; ++i) {
      const double reached = static_cast<double>(errors[i]);
      const double highest = static_cast<double>(errors[faces + i]);
      apart += !(reached <= field.upper[i] && field.lower[i] <= highest);
      least += reached;
      most += highest;
      known += field.upper[i];
    }
    CHECK(apart == 0);
    CHECK(most < 1.25 * known);
    CHECK(least > 0.75 * known);
    CHECK(known > 0.1 * static_cast<double>(f.reports[k - 1].lower) * static_cast<double>(faces));
  }
  CHECK(r.gpu().validation_messages() == 0);
}

TEST_CASE("a face's colour is that of its error") {
  constexpr uint32_t width = 640, height = 480;
  Renderer r({.width = width, .height = height, .cells_u = 24, .cells_v = 24});
  const RenderedFrame f = r.frame(0, 0, 200);
  REQUIRE(f.drawn > 0);
  const auto side = static_cast<uint32_t>(r.caption_part().offset.y) / 2;
  const Mesh finest = mesh_of(r, 0);
  const std::vector<float> errors = r.errors(f.drawn);
  const size_t faces = finest.faces.size();
  const glm::mat4 matrix =
      example::look({side, side}, 3.9f, 1.75f, 0.6f, example::kErrors).view_projection;
  const std::vector<glm::vec3> places = projected(finest, matrix, side);
  const auto expected = [&](size_t face) {
    return colour_of(std::min(errors[faces + face] / f.reports[f.drawn - 1].upper, 1.0f));
  };
  size_t seen = 0, own = 0, of_another = 0;
  for (size_t i = 0; i < faces; ++i) {
    const UVec3 c = finest.faces[i];
    const glm::vec3 middle = (places[c.x] + places[c.y] + places[c.z]) / 3.0f;
    if (std::any_of(finest.faces.begin(), finest.faces.end(), [&](const UVec3& o) {
          return hides(places[o.x], places[o.y], places[o.z], middle);
        }))
      continue;
    const auto x = static_cast<uint32_t>(middle.x) + width - side,
               y = static_cast<uint32_t>(middle.y);
    const uint8_t* p = f.rgba + 4 * (y * width + x);
    const glm::vec3 light = glm::pow(glm::vec3(p[0], p[1], p[2]) / 255.0f, glm::vec3(2.2f));
    ++seen;
    own += hue_apart(light, expected(i)) < 0.1f;
    of_another += hue_apart(light, expected((i + faces / 2) % faces)) < 0.1f;
  }
  INFO(seen, " faces seen, colours of their own ", own, ", of another's ", of_another);
  CHECK(seen > faces / 4);
  CHECK(own > 9 * seen / 10);
  CHECK(of_another < seen / 2);
}

TEST_CASE("the program writes its frames as pictures, and a line of CSV each") {
  const std::string out = folder() / "frames";
  Words words = {"--frames", "2", "--size", "400", "300", "--cells", "48", "24", "--out", out};
  if (validation()) words.push_back("--validation");
  const Outcome outcome = run(words);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);  // not 0 if the validation layer reported anything
  CHECK(std::count(outcome.out.begin(), outcome.out.end(), '\n') == 3);
  for (const char* name : {"/frame_000.png", "/frame_001.png"}) {
    const Picture picture = load(out + name);
    CHECK(picture.width == 400);
    CHECK(picture.height == 300);
    CHECK(picture.colours > 500);
  }
}
