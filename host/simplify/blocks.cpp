#include "host/simplify/blocks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace vkh {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

using Place = std::array<uint32_t, 3>;

/// Quotients first: the difference of two finite coordinates may be infinite.
Place place_of(const DVec3& v, const Grid& grid) {
  const auto along = [&](int axis) {
    return static_cast<uint32_t>(v[axis] / grid.side - grid.corner[axis] / grid.side);
  };
  return {along(0), along(1), along(2)};
}

/// The cube of each face, numbered from 0 in the order of their places.
struct Cubes {
  std::vector<uint32_t> of_face;
  uint32_t count = 0;
};

Cubes cubes_of(std::span<const UVec3> faces, std::span<const DVec3> vertices, const Grid& grid) {
  std::vector<Place> places;
  places.reserve(faces.size());
  for (const UVec3& face : faces) places.push_back(place_of(vertices[face.x], grid));
  std::vector<Place> sorted = places;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  Cubes cubes{.of_face = {}, .count = static_cast<uint32_t>(sorted.size())};
  cubes.of_face.reserve(faces.size());
  for (const Place& place : places)
    cubes.of_face.push_back(static_cast<uint32_t>(
        std::lower_bound(sorted.begin(), sorted.end(), place) - sorted.begin()));
  return cubes;
}

std::vector<char> shared_by(const Cubes& cubes, std::span<const UVec3> faces, size_t vertices) {
  std::vector<char> is_shared(vertices);
  std::vector<uint32_t> first(vertices, kNone);
  for (size_t f = 0; f < faces.size(); ++f) {
    const uint32_t cube = cubes.of_face[f];
    for (const uint32_t v : {faces[f].x, faces[f].y, faces[f].z}) {
      if (first[v] == kNone) first[v] = cube;
      if (first[v] != cube) is_shared[v] = 1;
    }
  }
  return is_shared;
}

}  // namespace

std::span<const UVec3> Blocks::operator[](size_t block) const {
  const size_t begin = block == 0 ? 0 : ends[block - 1];
  return std::span(faces).subspan(begin, ends[block] - begin);
}

Blocks split(std::span<const UVec3> faces, std::span<const DVec3> vertices, const Grid& grid) {
  const Cubes cubes = cubes_of(faces, vertices, grid);
  Blocks blocks;
  std::vector<size_t> next(cubes.count + size_t{1});
  for (const uint32_t cube : cubes.of_face) ++next[cube + size_t{1}];
  std::partial_sum(next.begin(), next.end(), next.begin());
  blocks.ends.assign(next.begin() + 1, next.end());
  blocks.faces.resize(faces.size());
  for (size_t f = 0; f < faces.size(); ++f) blocks.faces[next[cubes.of_face[f]]++] = faces[f];
  blocks.is_shared = shared_by(cubes, faces, vertices.size());
  return blocks;
}

}  // namespace vkh
