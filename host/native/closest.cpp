#include "host/native/closest.h"

#include <limits>

#include "host/mesh/round_to_float.h"
#include "host/native/cell.h"
#include "host/native/problem.h"
#include "host/native/separate.h"

namespace vkh::native {
namespace {

/// Coordinates of points are under 2^15 (closest_search.cpp).
constexpr double kPointReach = 0x1p16;

/// Exact: a float and its low part are two doubles.
Two3 position_of(const gpu::Vertex& v) {
  const auto vec = [](const auto& p) { return vec3(p.x, p.y, p.z); };
  return two_sum(vec(v.hi), vec(v.lo));
}

View view_of_point(const Two3& p) {
  View v = view_around(p);
  v.reach = kPointReach;
  return v;
}

/// <= the distance of the point from all triangles: the triangles that the walk visits, each
/// separated by a plane, and the boxes that it leaves out.
double distance_down(const FaceTree& tree, const Two3& p, float reach2) {
  const View view = view_of_point(p);
  Walk walk(tree, p.hi);
  double least = kFarthest;
  for (Leaf leaf = walk.next(reach2); !leaf.is_none(); leaf = walk.next(reach2)) {
    for (uint32_t i = leaf.begin; i < leaf.end; ++i) {
      const Corners& t = tree.triangle(i);
      const Surface s = make_surface(two(t.a), two(t.b), two(t.c), view);
      least = min(least, distance_from_origin_down(s, least));
    }
  }
  return min(least, box_distance_down(0, walk.least_left(reach2)));
}

}  // namespace

PlacedMesh::PlacedMesh(const Mesh& b, const Frame& frame) {
  const PlacedVertices placed = placed_vertices(frame, b);
  displacement_ = placed.displacement;
  tree_ = std::make_unique<const FaceTree>(placed.at, b.faces);
}
PlacedMesh::~PlacedMesh() = default;

gpu::ClosestFace PlacedMesh::closest(const gpu::Vertex& point) const {
  const Two3 p = position_of(point);
  const Nearest nearest = tree_->nearest(p.hi, {});
  // A little more than the nearest triangle's distance, so that the boxes that are left out do not
  // decide.
  const float reach2 = float_above(nearest.distance2 * (1 + 0x1p-16));
  const double lower = distance_down(*tree_, p, reach2);
  const float base = nearest_float(lower);
  return {.base = base,
          .lower_above = float_down(lower - static_cast<double>(base)),
          .upper_above = std::numeric_limits<float>::max(),
          .face = tree_->face(nearest.place)};
}

}  // namespace vkh::native
