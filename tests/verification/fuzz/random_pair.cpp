#include "tests/verification/fuzz/random_pair.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace vkh::test {
namespace {

constexpr float kLargest = 0x1p15f;  // the limit of vkhausdorff.h

/// The kinds of a mesh's coordinates.
enum class Kind : uint8_t { kGrid, kUnit, kClusters, kFlat, kBits, kHuge, kCount };

/// Any finite float within `largest`.
float any_float(FuzzBytes& bytes, float largest) {
  uint32_t bits = 0;
  for (int i = 0; i < 4; ++i) bits = bits << 8 | bytes.byte();
  const auto value = std::bit_cast<float>(bits);
  return std::isfinite(value) ? std::clamp(value, -largest, largest) : 0.0f;
}

float coordinate(FuzzBytes& bytes, Kind kind, uint32_t axis) {
  switch (kind) {
    case Kind::kGrid:  // shared corners, equal distances, many degenerate faces
      return static_cast<float>(static_cast<int>(bytes.below(9)) - 4) / 4.0f;
    case Kind::kClusters:  // needles and slivers
      return static_cast<float>(bytes.below(3)) +
             std::ldexp(static_cast<float>(bytes.byte()), -8 - 4 * static_cast<int>(axis));
    case Kind::kFlat:
      return axis == 2 ? 0.0f : static_cast<float>(bytes.byte()) / 128.0f - 1.0f;
    case Kind::kBits:
      return any_float(bytes, kLargest);
    case Kind::kHuge:
      return any_float(bytes, std::numeric_limits<float>::max());
    default:
      return static_cast<float>(bytes.byte() << 8 | bytes.byte()) / 32768.0f - 1.0f;
  }
}

/// A low part of at most half an ulp of its high part.
float low_part(FuzzBytes& bytes, float high) {
  if (high == 0) return 0;
  const float ulp = std::nextafter(std::abs(high), 2 * kLargest) - std::abs(high);
  return static_cast<float>(static_cast<int>(bytes.byte()) - 128) / 256.0f * ulp;
}

void add_layout(FuzzBytes& bytes, FuzzMesh& mesh) {
  const uint8_t layout = bytes.byte(), offsets = bytes.byte();
  mesh.is_16bit = layout % 2 == 1;
  mesh.stride = 12 + 4 * (layout / 2 % 4);
  mesh.has_low = layout / 8 % 4 == 3;
  mesh.vertex_offset = 4 * (offsets % 8);
  mesh.low_offset = 4 * (offsets / 8 % 4);
  mesh.index_offset = (mesh.is_16bit ? 2u : 4u) * (offsets / 32);
}

FuzzMesh make_mesh_of(FuzzBytes& bytes, Kind kind) {
  FuzzMesh mesh;
  add_layout(bytes, mesh);
  const uint32_t vertices = 1 + bytes.below(kind == Kind::kGrid ? 40 : 20);
  const uint32_t faces = 1 + bytes.below(12);  // more take seconds on a CPU
  const int exponent = bytes.flip() ? 0 : static_cast<int>(bytes.below(128)) - 112;
  for (uint32_t i = 0; i < 3 * vertices; ++i) {
    float high = coordinate(bytes, kind, i % 3);
    if (kind < Kind::kBits) high = std::clamp(std::ldexp(high, exponent), -kLargest, kLargest);
    mesh.high.push_back(high);
    mesh.low.push_back(mesh.has_low && kind < Kind::kHuge ? low_part(bytes, high) : 0.0f);
  }
  for (uint32_t i = 0; i < 3 * faces; ++i) mesh.corners.push_back(bytes.below(vertices));
  return mesh;
}

/// Changes a mesh like a remesher or an animation: most stays, some of it moves a little.
FuzzMesh moved(FuzzBytes& bytes, const FuzzMesh& mesh) {
  FuzzMesh out = mesh;
  const int shift = -static_cast<int>(bytes.below(24));
  for (size_t i = 0; i < out.high.size(); i += 1 + bytes.below(4)) {
    const float by = std::ldexp(static_cast<float>(bytes.byte()) / 128.0f - 1.0f, shift);
    out.high[i] = std::clamp(out.high[i] * (1 + by), -kLargest, kLargest);
    out.low[i] = 0;
  }
  return out;
}

double largest_of(const FuzzPair& pair) {
  double largest = 0;
  for (const FuzzMesh* mesh : {&pair.a, &pair.b, &pair.later_a, &pair.later_b}) {
    for (const float x : mesh->high) largest = std::max(largest, std::abs(double{x}));
  }
  return largest;
}

double diagonal_of(const Mesh& a, const Mesh& b) {
  glm::dvec3 lo = a.vertices[0], hi = lo;
  for (const Mesh* mesh : {&a, &b}) {
    for (const glm::dvec3& v : mesh->vertices) {
      lo = glm::min(lo, v);
      hi = glm::max(hi, v);
    }
  }
  return glm::distance(lo, hi);
}

}  // namespace

Mesh FuzzMesh::measured(bool with_low) const {
  std::vector<glm::dvec3> vertices(vertex_count());
  for (size_t i = 0; i < high.size(); ++i) {
    vertices[i / 3][static_cast<int>(i % 3)] =
        double{high[i]} + (with_low && has_low ? double{low[i]} : 0.0);
  }
  std::vector<glm::uvec3> faces(face_count());
  for (size_t i = 0; i < corners.size(); ++i) faces[i / 3][static_cast<int>(i % 3)] = corners[i];
  return make_mesh("fuzz", std::move(vertices), std::move(faces));
}

FuzzPair make_pair(FuzzBytes& bytes) {
  FuzzPair pair;
  const auto kind = static_cast<Kind>(bytes.below(static_cast<uint32_t>(Kind::kCount)));
  const uint8_t ways = bytes.byte(), waves = bytes.byte(), limits = bytes.byte();
  pair.a = make_mesh_of(bytes, kind);
  pair.b = ways % 4 == 0 ? moved(bytes, pair.a) : make_mesh_of(bytes, kind);
  pair.later = ways / 4 % 4 == 0 && kind != Kind::kHuge;
  if (pair.later) {
    pair.later_a = moved(bytes, pair.a);
    pair.later_b = moved(bytes, pair.b);
  }
  pair.warm = ways / 16 % 2 == 1;
  pair.two_float = ways / 32 % 2 == 1;
  pair.sort_from = ways / 64 % 2 == 1 ? 1 : 0;
  pair.first_waves = waves % 4;
  pair.more_waves = waves / 4 % 8;
  pair.largest = largest_of(pair);
  pair.is_promised = pair.largest <= kLargest;
  pair.diagonal = diagonal_of(pair.a.measured(true), pair.b.measured(true));
  const int bits = 2 + limits % 10;
  pair.tolerance = static_cast<float>(std::ldexp(std::min(pair.diagonal, 1e30), -bits));
  // Features under 2^-48 are points to the engine, and single floats have 24 bits.
  pair.has_end = pair.tolerance >= 0x1p-44f && pair.tolerance >= 0x1p-22 * pair.largest;
  pair.workspace_percent = limits / 10 % 4 == 0 ? 0 : 100u / (limits / 10 % 4);
  if (limits > 220) pair.known_lower = static_cast<float>(std::ldexp(pair.tolerance, bits / 2));
  return pair;
}

}  // namespace vkh::test
