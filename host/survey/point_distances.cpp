#include "host/survey/point_distances.h"

#include <algorithm>

#include "host/base/parallel.h"
#include "host/base/rounding.h"
#include "host/mesh/round_to_float.h"
#include "host/survey/measured.h"
#include "shaders/survey/score.h"

namespace vkh {
namespace {

TriangleTree tree_of(const Mesh& mesh, const std::vector<glm::dvec3>& vertices) {
  std::vector<Corners3> triangles;
  triangles.reserve(mesh.faces.size());
  for (const UVec3& f : mesh.faces)
    triangles.push_back({vertices[f.x], vertices[f.y], vertices[f.z]});
  return TriangleTree(triangles);
}

}  // namespace

PointDistances::PointDistances(const SurveyedPair& pair)
    : a_(pair.a),
      b_(pair.b),
      frame_(pair.frame),
      displacement_(pair.displacement),
      vertices_(scaled(pair.b, pair.frame, is_exact_)),
      tree_(tree_of(pair.b, vertices_)) {}

Corners3 PointDistances::corners(uint32_t face) const {
  const UVec3& f = b_.faces[face];
  return {vertices_[f.x], vertices_[f.y], vertices_[f.z]};
}

// Returns nothing where scaling rounded: the double would not be the point.
std::optional<glm::dvec3> PointDistances::point(uint32_t face) const {
  const DVec3& v = a_.vertices[a_.faces[face].x];
  Frame back;
  back.exponent = -frame_.exponent;
  const glm::dvec3 p(frame_.to_frame(v.x), frame_.to_frame(v.y), frame_.to_frame(v.z));
  const bool is_exact =
      back.to_frame(p.x) == v.x && back.to_frame(p.y) == v.y && back.to_frame(p.z) == v.z;
  return is_exact_ && is_exact ? std::optional(p) : std::nullopt;
}

// The distance of the meshes as they are held is in [down, up] (measured.h); bounds are of the
// stored ones, whose vertices are off those by no more than the displacement of both together. The
// sums round outward, and so do the floats.
gpu::CellBounds PointDistances::narrowed(uint32_t face, const gpu::CellBounds& bounds) const {
  const std::optional<glm::dvec3> p = point(face);
  if (!p) return bounds;
  const auto count = static_cast<uint32_t>(b_.faces.size());
  const auto at = [this](uint32_t f) { return corners(f); };
  const double down = distance_below(*p, tree_, count, at, bounds.face);
  const double up = distance_above(*p, tree_, count, at, bounds.face);
  const float least =
      std::max(lib::lowest_of(bounds), float_down(std::max(add_down(down, -displacement_), 0.0)));
  const float most = std::min(bounds.highest, float_up(add_up(up, displacement_)));
  gpu::CellBounds narrow = bounds;
  narrow.lower_a = narrow.lower_b = narrow.lower_c = narrow.reached = least;
  narrow.upper_a = narrow.upper_b = narrow.upper_c = narrow.highest = narrow.mean_upper = most;
  // The square of a float is exact in double.
  narrow.square_upper = float_up(static_cast<double>(most) * static_cast<double>(most));
  return narrow;
}

namespace {

// Whether a point is known less well than asked, or a cut lies between its bounds.
bool matters(const gpu::CellBounds& b, const PointDistances::Asked& asked) {
  const auto least = static_cast<double>(lib::lowest_of(b)), most = static_cast<double>(b.highest);
  if (!(most > least)) return false;
  return most - least > asked.least ||
         std::any_of(asked.cuts.begin(), asked.cuts.end(),
                     [&](const Threshold& at) { return at.down < most && at.up >= least; });
}

}  // namespace

PointDistances::Measured PointDistances::narrow(std::span<const gpu::Cell> points,
                                                std::span<gpu::CellBounds> bounds,
                                                const Asked& asked, size_t most) const {
  constexpr size_t kPointsOfThread = 256;
  std::vector<size_t> which;
  bool are_all = true;
  for (size_t i = 0; i < bounds.size() && are_all; ++i) {
    if (!matters(bounds[i], asked)) continue;
    are_all = which.size() < most;
    if (are_all) which.push_back(i);
  }
  for_each_range_of(kPointsOfThread, which.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      const size_t i = which[k];
      bounds[i] = narrowed(points[i].face, bounds[i]);
    }
  });
  return {which.size(), are_all};
}

}  // namespace vkh
