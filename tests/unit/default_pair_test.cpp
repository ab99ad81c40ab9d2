// The generated pair of `vkhausdorff demo`: a closed part with CAD's thin triangles and its
// coarser twin, the same to the last bit everywhere.
#include "host/mesh/default_pair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>
#include <vector>

#include "host/mesh/mesh_pair.h"

namespace {

using glm::dvec3;
using vkh::Mesh;

const vkh::MeshPair& pair() {
  static const vkh::MeshPair kPair = vkh::default_pair();
  return kPair;
}

/// Twice the area over the squared longest edge: altitude / longest edge.
double flatness(const Mesh& mesh, const glm::uvec3& face) {
  const dvec3 &a = mesh.vertices[face.x], &b = mesh.vertices[face.y], &c = mesh.vertices[face.z];
  const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  return glm::length(glm::cross(b - a, c - a)) / (longest * longest);
}

size_t thin_faces(const Mesh& mesh) {
  return static_cast<size_t>(
      std::count_if(mesh.faces.begin(), mesh.faces.end(),
                    [&](const glm::uvec3& face) { return flatness(mesh, face) < 0.06; }));
}

/// Directed edges without exactly one opposite: none in a closed, oriented manifold.
size_t open_edges(const Mesh& mesh) {
  std::vector<std::pair<uint32_t, uint32_t>> edges, opposites;
  for (const glm::uvec3& face : mesh.faces) {
    for (int k = 0; k < 3; ++k) {
      edges.emplace_back(face[k], face[(k + 1) % 3]);
      opposites.emplace_back(face[(k + 1) % 3], face[k]);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(opposites.begin(), opposites.end());
  const bool repeated = std::adjacent_find(edges.begin(), edges.end()) != edges.end();
  std::vector<std::pair<uint32_t, uint32_t>> unmatched;
  std::set_symmetric_difference(edges.begin(), edges.end(), opposites.begin(), opposites.end(),
                                std::back_inserter(unmatched));
  return unmatched.size() + (repeated ? 1 : 0);
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& face : mesh.faces) {
    sum +=
        glm::dot(mesh.vertices[face.x], glm::cross(mesh.vertices[face.y], mesh.vertices[face.z]));
  }
  return sum / 6;
}

/// FNV-1a over the bits of all coordinates and indices.
uint64_t fingerprint(const Mesh& mesh) {
  uint64_t hash = 0xcbf29ce484222325u;
  const auto mix = [&](uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (word >> 8 * byte & 0xff)) * 0x100000001b3u;
  };
  for (const dvec3& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) mix(std::bit_cast<uint64_t>(p[k]));
  }
  for (const glm::uvec3& face : mesh.faces) {
    for (int k = 0; k < 3; ++k) mix(face[k]);
  }
  return hash;
}

bool all_float32(const Mesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const dvec3& p) {
    const auto is_float = [](double x) { return (std::bit_cast<uint64_t>(x) & 0x1fffffff) == 0; };
    return is_float(p.x) && is_float(p.y) && is_float(p.z);
  });
}

}  // namespace

TEST_CASE("A has the size and the thin triangles of a CAD part") {
  const Mesh& a = pair().a;
  CHECK(a.faces.size() >= 20000);
  CHECK(a.faces.size() <= 40000);
  CHECK(thin_faces(a) * 10 > a.faces.size());
  CHECK(a.counts.degenerate == 0);
  CHECK(a.counts.duplicate == 0);
  CHECK(a.counts.unreferenced == 0);
}

TEST_CASE("B is the same part with fewer faces") {
  const Mesh &a = pair().a, &b = pair().b;
  CHECK(b.faces.size() * 10 >= a.faces.size() * 3);
  CHECK(b.faces.size() * 10 <= a.faces.size() * 7);
  CHECK(b.counts.degenerate == 0);
  CHECK(b.counts.unreferenced == 0);
  CHECK(volume(b) != volume(a));
  CHECK(volume(b) == doctest::Approx(volume(a)).epsilon(1e-3));
}

TEST_CASE("both are closed, outward, and float32") {
  for (const Mesh* mesh : {&pair().a, &pair().b}) {
    CAPTURE(mesh->name);
    CHECK(open_edges(*mesh) == 0);
    CHECK(volume(*mesh) > 0);
    CHECK(all_float32(*mesh));
  }
}

TEST_CASE("the flange's faces are flat and face one way") {
  const Mesh& a = pair().a;
  double top = 0, bottom = 0;
  for (const glm::uvec3& face : a.faces) {
    const dvec3 &p = a.vertices[face.x], &q = a.vertices[face.y], &r = a.vertices[face.z];
    const bool flat = p.z == q.z && q.z == r.z;
    if (!flat || (p.z != 0 && p.z != 12)) continue;
    const double twice_area = glm::cross(q - p, r - p).z;
    CHECK((p.z == 12 ? twice_area > 0 : twice_area < 0));
    (p.z == 12 ? top : bottom) += twice_area / 2;
  }
  // pi (outer^2 - inner^2 - 6 hole^2), polygons for circles; at the bottom the keyway is open too.
  CHECK(top == doctest::Approx(3.14159 * (53 * 53 - 30 * 30 - 6 * 7.5 * 7.5)).epsilon(2e-3));
  CHECK(bottom == doctest::Approx(-3.14159 * (53 * 53 - 13 * 13 - 6 * 5 * 5)).epsilon(2e-3));
}

// The numbers are those of g++ 12 at -O1 and -O3 on x86-64; other platforms run this test, too.
TEST_CASE("the pair is the same to the last bit on every machine") {
  const vkh::MeshPair again = vkh::default_pair();
  CHECK(fingerprint(again.a) == fingerprint(pair().a));
  CHECK(fingerprint(again.b) == fingerprint(pair().b));
  CHECK(fingerprint(pair().a) == 0xbb2eb9de8b407476u);
  CHECK(fingerprint(pair().b) == 0xfbbfb14ab3fe0073u);
}
