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

bool has_equal_corners(const UVec3& face) {
  return face.x == face.y || face.y == face.z || face.z == face.x;
}

#ifdef VKH_HAS_MESHOPTIMIZER

/// Faces as meshoptimizer takes them. A face whose corners are one vertex locks it: it has edges
/// that no face shares, more than a border has (meshoptimizer's classifyVertices).
std::vector<unsigned> indices_of(const Faces& faces, std::span<const uint32_t> locked) {
  std::vector<unsigned> indices;
  indices.reserve(3 * (faces.size() + locked.size()));
  for (const UVec3& face : faces) indices.insert(indices.end(), {face.x, face.y, face.z});
  for (const uint32_t v : locked) indices.insert(indices.end(), {v, v, v});
  return indices;
}

Faces faces_of(std::span<const unsigned> indices) {
  Faces faces;
  faces.reserve(indices.size() / 3);
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const UVec3 face(indices[i], indices[i + 1], indices[i + 2]);
    if (!has_equal_corners(face)) faces.push_back(face);
  }
  return faces;
}

#endif

struct Axis {
  double middle = 0, half = 0;
};

Axis axis_of(const std::vector<DVec3>& vertices, int axis) {
  double lo = vertices[0][axis], hi = lo;
  for (const DVec3& v : vertices) {
    lo = std::min(lo, v[axis]);
    hi = std::max(hi, v[axis]);
  }
  return {.middle = 0.5 * lo + 0.5 * hi, .half = 0.5 * hi - 0.5 * lo};
}

}  // namespace

Collapser::Collapser(const Mesh& mesh, bool lock_borders, bool rounds)
    : name_(mesh.name), unit_(mesh.unit), lock_borders_(lock_borders) {
  weld(mesh, rounds);
  place();
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

void Collapser::place() {
  const Axis axes[] = {axis_of(vertices_, 0), axis_of(vertices_, 1), axis_of(vertices_, 2)};
  extent_ = std::max({axes[0].half, axes[1].half, axes[2].half});
  places_.reserve(3 * vertices_.size());
  for (const DVec3& v : vertices_) {
    for (int axis = 0; axis < 3; ++axis)
      places_.push_back(extent_ > 0 ? static_cast<float>((v[axis] - axes[axis].middle) / extent_)
                                    : 0.0F);
  }
}

Faces Collapser::collapse(const Faces& from, const CollapseTarget& target,
                          std::span<const uint32_t> locked) const {
#ifdef VKH_HAS_MESHOPTIMIZER
  const std::vector<unsigned> indices = indices_of(from, locked);
  std::vector<unsigned> out(indices.size());
  const size_t stride = 3 * sizeof(float);
  const double scale =
      static_cast<double>(meshopt_simplifyScale(places_.data(), vertices_.size(), stride));
  const double error = extent_ > 0 && scale > 0 ? target.error / extent_ / scale : 0;
  out.resize(meshopt_simplify(out.data(), indices.data(), indices.size(), places_.data(),
                              vertices_.size(), stride, 3 * std::min(target.faces, from.size()),
                              static_cast<float>(std::min(error, 1e6)),
                              lock_borders_ ? meshopt_SimplifyLockBorder : 0, nullptr));
  return faces_of(out);
#else
  (void)from, (void)target, (void)locked;
  throw UsageError("simplify: this build lacks meshoptimizer (Debian: libmeshoptimizer-dev)");
#endif
}

Mesh Collapser::mesh_of(const Faces& faces) const {
  Mesh mesh = make_mesh(name_, {vertices_.begin(), vertices_.end()}, {faces.begin(), faces.end()},
                        ThreadPool(), Positions::kDiffer);
  mesh.unit = unit_;
  return mesh;
}

}  // namespace vkh
