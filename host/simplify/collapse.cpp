#include "host/simplify/collapse.h"

#include <algorithm>
#include <cmath>

#include "host/mesh/make_mesh.h"
#include "host/mesh/position_index.h"
#include "host/mesh/round_to_float.h"
#include "vkhausdorff/error.h"
#ifdef VKH_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace vkh {
namespace {

struct Axis {
  double least = 0, middle = 0, half = 0;
};

/// Bounds `count` points, one at least, on an axis.
template <class At>
Axis axis_of(size_t count, const At& at, int axis) {
  double lo = at(0)[axis], hi = lo;
  for (size_t i = 1; i < count; ++i) {
    lo = std::min(lo, at(i)[axis]);
    hi = std::max(hi, at(i)[axis]);
  }
  return {.least = lo, .middle = 0.5 * lo + 0.5 * hi, .half = 0.5 * hi - 0.5 * lo};
}

// meshoptimizer's errors are squares in float32: below about 2e-4 of a block they are noise, and
// collapses of a fine mesh are in no order. A torus of 160,000 faces, as one block, was never
// nearer than 4e-4 of its length, for any error.
constexpr double kFinest = 4e-4;
// Faces of a block, at least, on a surface that goes once through the grid.
constexpr double kFacesOfBlock = 250;

/// Cubes along the longest side of a mesh.
double cubes_along(double error, double half, size_t faces) {
  const double most = std::floor(std::sqrt(static_cast<double>(faces) / kFacesOfBlock));
  return std::min(std::ceil(2 * kFinest * half / error), most);
}

#ifdef VKH_HAS_MESHOPTIMIZER

/// A block's own vertices, by number and place: within [-1, 1] of their middle, so that float32 is
/// as fine as the block is small.
struct Patch {
  std::vector<uint32_t> vertices;  ///< ascending
  std::vector<float> places;       ///< three for each
  std::vector<unsigned> corners;
  double extent = 0;  ///< length of a step of 1 in `places`
};

std::vector<uint32_t> vertices_of(std::span<const UVec3> faces) {
  std::vector<uint32_t> vertices;
  vertices.reserve(3 * faces.size());
  for (const UVec3& face : faces) vertices.insert(vertices.end(), {face.x, face.y, face.z});
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

void place(Patch& patch, std::span<const DVec3> all) {
  const auto at = [&](size_t i) -> const DVec3& { return all[patch.vertices[i]]; };
  const size_t count = patch.vertices.size();
  const Axis axes[] = {axis_of(count, at, 0), axis_of(count, at, 1), axis_of(count, at, 2)};
  patch.extent = std::max({axes[0].half, axes[1].half, axes[2].half});
  patch.places.reserve(3 * count);
  for (size_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      patch.places.push_back(
          patch.extent > 0 ? static_cast<float>((at(i)[axis] - axes[axis].middle) / patch.extent)
                           : 0.0F);
  }
}

/// A face whose corners are one vertex locks it: it has edges that no face shares, more than a
/// border has (meshoptimizer's classifyVertices).
Patch patch_of(std::span<const UVec3> faces, std::span<const DVec3> all,
               const std::vector<char>& is_locked) {
  Patch patch;
  patch.vertices = vertices_of(faces);
  place(patch, all);
  const auto number = [&patch](uint32_t v) {
    const auto found = std::lower_bound(patch.vertices.begin(), patch.vertices.end(), v);
    return static_cast<unsigned>(found - patch.vertices.begin());
  };
  patch.corners.reserve(3 * faces.size());
  for (const UVec3& face : faces)
    patch.corners.insert(patch.corners.end(), {number(face.x), number(face.y), number(face.z)});
  for (unsigned i = 0; i < patch.vertices.size(); ++i)
    if (is_locked[patch.vertices[i]]) patch.corners.insert(patch.corners.end(), {i, i, i});
  return patch;
}

bool has_equal_corners(const UVec3& face) {
  return face.x == face.y || face.y == face.z || face.z == face.x;
}

Faces faces_of(std::span<const unsigned> corners, const std::vector<uint32_t>& vertices) {
  Faces faces;
  faces.reserve(corners.size() / 3);
  for (size_t i = 0; i + 2 < corners.size(); i += 3) {
    const UVec3 face(vertices[corners[i]], vertices[corners[i + 1]], vertices[corners[i + 2]]);
    if (!has_equal_corners(face)) faces.push_back(face);
  }
  return faces;
}

#endif

}  // namespace

Collapser::Collapser(const Mesh& mesh, bool lock_borders, bool rounds)
    : name_(mesh.name), unit_(mesh.unit), lock_borders_(lock_borders) {
  weld(mesh, rounds);
  measure();
}

void Collapser::weld(const Mesh& mesh, bool rounds) {
  std::vector<DVec3> at = mesh.vertices;
  if (rounds)
    for (DVec3& v : at) v = round_to_float(glm::dvec3(v));
  const ThreadPool pool;
  const auto position = [&at](uint32_t v) { return glm::dvec3(at[v]); };
  PositionIndex index(pool, at.size(), position);
  std::vector<uint32_t> first(at.size()), number(at.size());
  index.insert(0, static_cast<uint32_t>(at.size()), first.data());
  for (size_t v = 0; v < at.size(); ++v) {
    if (first[v] == v) {
      number[v] = static_cast<uint32_t>(vertices_.size());
      vertices_.push_back(at[v]);
    } else {
      number[v] = number[first[v]];
    }
  }
  for (const UVec3& face : mesh.faces)
    faces_.emplace_back(number[face.x], number[face.y], number[face.z]);
}

void Collapser::measure() {
  const auto at = [this](size_t i) -> const DVec3& { return vertices_[i]; };
  for (int axis = 0; axis < 3; ++axis) {
    const Axis bounds = axis_of(vertices_.size(), at, axis);
    corner_[axis] = bounds.least;
    half_ = std::max(half_, bounds.half);
  }
}

Faces Collapser::collapse(const Faces& from, const CollapseTarget& target,
                          std::span<const uint32_t> locked, const ThreadPool& pool) const {
  if (from.empty()) return {};
  std::vector<char> is_locked(vertices_.size());
  for (const uint32_t v : locked) is_locked[v] = 1;
  const double cubes = cubes_along(target.error, half_, from.size());
  if (target.faces > 0 || !target.by_blocks || !(cubes > 1))
    return collapse_block(from, target, is_locked);
  // The second grid has the first one's seams in the middle of its cubes.
  const double half = half_ / cubes;
  const Faces once = collapse_blocks(from, {corner_, 2 * half}, target.error, is_locked, pool);
  return collapse_blocks(once, {corner_ - DVec3(half, half, half), 2 * half}, target.error,
                         std::move(is_locked), pool);
}

Faces Collapser::collapse_blocks(const Faces& from, const Grid& grid, double error,
                                 std::vector<char> is_locked, const ThreadPool& pool) const {
  const Blocks blocks = split(from, vertices_, grid);
  for (size_t v = 0; v < is_locked.size(); ++v) is_locked[v] |= blocks.is_shared[v];
  std::vector<Faces> parts(blocks.size());
  pool.for_each(blocks.size(), [&](size_t i) {
    parts[i] = collapse_block(blocks[i], {.error = error}, is_locked);
  });
  Faces faces;
  for (const Faces& part : parts) faces.insert(faces.end(), part.begin(), part.end());
  return faces;
}

Faces Collapser::collapse_block(std::span<const UVec3> from, const CollapseTarget& target,
                                const std::vector<char>& is_locked) const {
#ifdef VKH_HAS_MESHOPTIMIZER
  const Patch patch = patch_of(from, vertices_, is_locked);
  std::vector<unsigned> out(patch.corners.size());
  const size_t stride = 3 * sizeof(float), count = patch.vertices.size();
  const double scale =
      static_cast<double>(meshopt_simplifyScale(patch.places.data(), count, stride));
  const double error = patch.extent > 0 && scale > 0 ? target.error / patch.extent / scale : 0;
  out.resize(meshopt_simplify(
      out.data(), patch.corners.data(), patch.corners.size(), patch.places.data(), count, stride,
      3 * std::min(target.faces, from.size()), static_cast<float>(std::min(error, 1e6)),
      lock_borders_ ? meshopt_SimplifyLockBorder : 0, nullptr));
  return faces_of(out, patch.vertices);
#else
  (void)from, (void)target, (void)is_locked;
  throw UsageError("simplify: this build lacks meshoptimizer (Debian: libmeshoptimizer-dev)");
#endif
}

Mesh Collapser::mesh_of(const Faces& faces) const {
  std::vector<uint32_t> number(vertices_.size());
  for (const UVec3& face : faces)
    for (const uint32_t v : {face.x, face.y, face.z}) number[v] = 1;
  std::vector<glm::dvec3> vertices;
  for (size_t v = 0; v < number.size(); ++v) {
    if (number[v] == 0) continue;
    number[v] = static_cast<uint32_t>(vertices.size());
    vertices.emplace_back(vertices_[v]);
  }
  std::vector<glm::uvec3> own;
  own.reserve(faces.size());
  for (const UVec3& face : faces) own.emplace_back(number[face.x], number[face.y], number[face.z]);
  Mesh mesh =
      make_mesh(name_, std::move(vertices), std::move(own), ThreadPool(), Positions::kDiffer);
  mesh.unit = unit_;
  return mesh;
}

}  // namespace vkh
