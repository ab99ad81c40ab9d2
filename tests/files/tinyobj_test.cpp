// The OBJ reader against tinyobjloader, face by face: the same corners of each face of random
// files, in the same order of faces.
#include <doctest/doctest.h>

#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "host/read/readers.h"

namespace {

using namespace vkh;
using Corners = std::vector<glm::dvec3>;

/// Writes OBJ files with what exporters write: normals and texture coordinates in all four forms,
/// indices from the end, groups, objects, materials, comments, either line end.
class RandomObj {
 public:
  explicit RandomObj(uint32_t seed) : random_(seed), crlf_(below(3) == 0) {}

  std::string text() {
    line("# made for a test");
    line("mtllib none.mtl");
    const size_t blocks = 1 + below(4);
    for (size_t i = 0; i < blocks; ++i) block();
    return out_.str();
  }

 private:
  size_t below(size_t count) {
    return std::uniform_int_distribution<size_t>(0, count - 1)(random_);
  }
  std::string number() {
    std::ostringstream text;
    text.precision(3 + static_cast<int>(below(14)));
    if (below(5) == 0) text << std::scientific;
    text << std::uniform_real_distribution<double>(-100, 100)(random_);
    return text.str();
  }
  void line(const std::string& words) { out_ << words << (crlf_ ? "\r\n" : "\n"); }

  /// Vertices around a circle, so that every polygon of consecutive ones is convex.
  void block() {
    const size_t first = vertices_, count = 5 + below(8);
    const std::string height = number();
    for (size_t i = 0; i < count; ++i) {
      const double turn =
          2 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(count);
      std::ostringstream text;
      text.precision(17);
      text << "v " << 7 * std::cos(turn) << (below(2) == 0 ? " " : "  ") << 7 * std::sin(turn)
           << " " << height;
      line(text.str());
      line("vn " + number() + " " + number() + " " + number());
      line("vt " + number() + " " + number());
    }
    vertices_ += count;
    if (below(2) == 0) line((below(2) == 0 ? "o part" : "g part") + std::to_string(first));
    if (below(3) == 0) line("usemtl steel");
    if (below(3) == 0) line("s off");
    const size_t faces = 1 + below(6);
    for (size_t i = 0; i < faces; ++i) face(first, count);
    if (below(3) == 0) line("");
  }

  void face(size_t first, size_t count) {
    const size_t corners = 3 + below(std::min<size_t>(count - 2, 4)), begin = below(count);
    const size_t form = below(4);
    const bool from_the_end = below(4) == 0;
    std::string words = "f";
    for (size_t k = 0; k < corners; ++k) {
      const size_t at = first + (begin + k) % count;
      const std::string index =
          from_the_end ? std::to_string(static_cast<long>(at) - static_cast<long>(vertices_))
                       : std::to_string(at + 1);
      words += " " + index;
      if (form == 1) words += "/" + index;
      if (form == 2) words += "//" + index;
      if (form == 3) words += "/" + index + "/" + index;
    }
    line(words);
  }

  std::mt19937 random_;
  std::ostringstream out_;
  bool crlf_;
  size_t vertices_ = 0;
};

bool is_less(const glm::dvec3& a, const glm::dvec3& b) {
  return std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3);
}

/// The different corners of a face, sorted.
Corners sorted(Corners corners) {
  std::sort(corners.begin(), corners.end(), is_less);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::vector<Corners> by_tinyobj(const std::string& text) {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  std::istringstream in(text);
  const bool is_read = tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &in,
                                        nullptr, /*triangulate=*/false);
  REQUIRE_MESSAGE(is_read, error);
  std::vector<Corners> faces;
  for (const tinyobj::shape_t& shape : shapes) {
    size_t at = 0;
    for (const auto count : shape.mesh.num_face_vertices) {
      Corners corners;
      for (size_t k = 0; k < count; ++k) {
        const auto v = static_cast<size_t>(shape.mesh.indices[at++].vertex_index);
        corners.emplace_back(attributes.vertices[3 * v], attributes.vertices[3 * v + 1],
                             attributes.vertices[3 * v + 2]);
      }
      faces.push_back(sorted(std::move(corners)));
    }
  }
  return faces;
}

std::vector<Corners> by_ours(const std::string& text) {
  const ReadMesh mesh = parse_mesh({.name = "x.obj", .bytes = text});
  std::vector<Corners> faces;
  for (size_t i = 0; i < mesh.faces.size(); ++i) {
    const size_t face = mesh.file_faces.of(i);
    if (faces.size() <= face) faces.resize(face + 1);
    for (int k = 0; k < 3; ++k) faces[face].push_back(mesh.vertices[mesh.faces[i][k]]);
  }
  for (Corners& corners : faces) corners = sorted(std::move(corners));
  return faces;
}

/// tinyobjloader's decimals are off by a few units of the last place; ours are the nearest.
bool are_near(const Corners& a, const Corners& b) {
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (!(std::abs(a[i][k] - b[i][k]) <= 1e-12 * (1 + std::abs(a[i][k])))) return false;
    }
  }
  return true;
}

TEST_CASE("tinyobjloader reads the same faces from 2,000 random files") {
  size_t faces = 0, wrong = 0;
  for (uint32_t seed = 0; seed < 2000; ++seed) {
    CAPTURE(seed);
    const std::string text = RandomObj(seed).text();
    const std::vector<Corners> ours = by_ours(text), theirs = by_tinyobj(text);
    REQUIRE(ours.size() == theirs.size());
    for (size_t i = 0; i < ours.size(); ++i) wrong += !are_near(ours[i], theirs[i]);
    faces += ours.size();
  }
  CHECK(wrong == 0);
  CHECK(faces > 10000);
}

}  // namespace
