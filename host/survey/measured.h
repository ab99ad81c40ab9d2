// Distances from points of cells to faces of B, in double, with error bounds.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "host/mesh/closest.h"
#include "host/mesh/triangle_tree.h"
#include "host/solve/cell_corners.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/mesh.h"

namespace vkh {

inline constexpr double kRound = 0x1p-53;  // a double operation's rounding, of its result
// Scaling may underflow by 2^-1074 a coordinate, and products of two such coordinates may by as
// much: beside coordinates of under 2^60 all of that is under this.
inline constexpr double kUnderflow = 0x1p-900;

inline double sum_of_sizes(const glm::dvec3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

inline std::vector<glm::dvec3> scaled(const Mesh& mesh, const Frame& frame, bool& is_exact) {
  std::vector<glm::dvec3> vertices;
  vertices.reserve(mesh.vertices.size());
  Frame back;
  back.exponent = -frame.exponent;
  for (const DVec3& v : mesh.vertices) {
    const glm::dvec3 s(frame.to_frame(v.x), frame.to_frame(v.y), frame.to_frame(v.z));
    is_exact = is_exact && back.to_frame(s.x) == v.x && back.to_frame(s.y) == v.y &&
               back.to_frame(s.z) == v.z;
    vertices.push_back(s);
  }
  return vertices;
}

// Barycentrics of a cell's corner as integers with the sum 2^20.
inline glm::dvec3 weights_of(const glm::uvec2& corner) {
  return {static_cast<double>(gpu::kBaryOne - corner.x - corner.y), static_cast<double>(corner.x),
          static_cast<double>(corner.y)};
}

inline double farthest(const Corners3& t) {
  double most = 0;
  for (const glm::dvec3& p : t)
    most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return most;
}

// Each product and each sum of the three terms rounds by kRound of the largest coordinate at most,
// since the weights add up to 2^20; the division rounds nothing. That is 3; 4 are taken.
inline glm::dvec3 point_at(const Corners3& face, const glm::dvec3& weights) {
  return (face[0] * weights.x + face[1] * weights.y + face[2] * weights.z) * 0x1p-20;
}
inline double off_at(const Corners3& face) { return 4 * kRound * farthest(face) + kUnderflow; }

// Above the length of v, whose components may be off by kRound of themselves, each: squares, sums
// and the root round by three more.
inline double length_up(const glm::dvec3& v) {
  return std::sqrt(glm::dot(v, v)) * (1 + 8 * kRound) + kUnderflow;
}

/// A triangle's corners from a point.
struct FromPoint {
  Corners3 corners;
  double reach = 0;  // at least the largest distance of a corner, less a few kRound of itself
};
inline FromPoint seen_from(const glm::dvec3& p, const Corners3& triangle) {
  FromPoint seen;
  for (size_t i = 0; i < 3; ++i) {
    seen.corners[i] = triangle[i] - p;
    seen.reach = std::max(seen.reach, sum_of_sizes(seen.corners[i]));
  }
  return seen;
}

inline glm::dvec3 nearest_to_origin(const FromPoint& seen) {
  const auto& [a, b, c] = seen.corners;
  return closest_point(glm::dvec3(0), a, b, c).point;
}

// Above the distance of a triangle: the point that was found is off the triangle only by the
// rounding of its corners, its weights and its sum, under 32 * 2^-52 of the reach as in leaf.cpp.
inline double distance_above(const FromPoint& seen) {
  return length_up(nearest_to_origin(seen)) + 64 * kRound * seen.reach;
}

// Below the distance of a triangle: with g = q / |q| for any q, no point of it is nearer than its
// least corner along g. Components of g are off by 4 kRound of themselves, of corners by one, and a
// product of three components by 3: under 8 kRound of the reach, by Cauchy; |g| is at most
// 1 + 4 kRound. 16 are taken.
inline double distance_below(const FromPoint& seen) {
  const glm::dvec3 q = nearest_to_origin(seen);
  const double size = std::sqrt(glm::dot(q, q));
  if (!(size > 1e-140)) return 0;
  const glm::dvec3 g = q / size;
  const double least = std::min(
      {glm::dot(g, seen.corners[0]), glm::dot(g, seen.corners[1]), glm::dot(g, seen.corners[2])});
  return least - 16 * kRound * seen.reach;
}

/// Above the distance of p from the triangles in the tree, of which there is one at least.
/// `hint`: a triangle to look at first, or any other number.
template <class CornersOf>
double distance_above(const glm::dvec3& p, const TriangleTree& tree, uint32_t count,
                      const CornersOf& corners, uint32_t hint) {
  double best = std::numeric_limits<double>::infinity(), best2 = best;
  const auto see = [&](uint32_t face) {
    best = std::min(best, distance_above(seen_from(p, corners(face))));
    best2 = best * best;
  };
  if (hint < count) see(hint);
  tree.nearest_first(p, best2, see);
  return best;
}

/// Below it. No point of a box is nearer than its distance, which is off by 8 kRound of itself at
/// most; below it no face in it is.
template <class CornersOf>
double distance_below(const glm::dvec3& p, const TriangleTree& tree, uint32_t count,
                      const CornersOf& corners, uint32_t hint) {
  double best = std::numeric_limits<double>::infinity(), best2 = best;
  const auto see = [&](uint32_t face) {
    best = std::min(best, std::max(distance_below(seen_from(p, corners(face))), 0.0));
    best2 = best * best;
  };
  if (hint < count) see(hint);
  tree.nearest_first(p, best2, see);
  return std::max(best * (1 - 16 * kRound) - kUnderflow, 0.0);
}

/// A cell's corners to within `off` in each coordinate.
struct PlacedCell {
  Corners3 corners;
  double off;
};
inline PlacedCell placed_cell(const Corners3& face, const gpu::Cell& cell) {
  const lib::Bary3 t = corners_of(cell);
  return {{point_at(face, weights_of(t.a)), point_at(face, weights_of(t.b)),
           point_at(face, weights_of(t.c))},
          off_at(face)};
}

/// A ball that holds a cell, and how far from its centre a face of B may be that is closest to some
/// point of the cell.
struct CellBall {
  glm::dvec3 centre;
  double reach;
  bool may_hold(const TriangleBox& box) const {
    return distance2(centre, box) <= reach * reach * (1 + 16 * kRound) + kUnderflow;
  }
  bool may_hold(const Corners3& face) const {
    return distance_below(seen_from(centre, face)) <= reach;
  }
};

/// Any point c serves as the centre, with the largest distance r of the cell's corners from it: a
/// face that is closest to some point of the cell is no farther from c than d(c, B) + 2 r.
/// `distance_up`: of a point, at least its distance from B.
template <class DistanceUp>
CellBall ball_of(const PlacedCell& at, const DistanceUp& distance_up) {
  const glm::dvec3 centre = (at.corners[0] + at.corners[1] + at.corners[2]) * (1.0 / 3);
  double radius = 0;
  for (const glm::dvec3& p : at.corners)
    radius = std::max(radius, length_up(p - centre) + 2 * at.off);
  return {centre, (distance_up(centre) + 2 * radius) * (1 + 8 * kRound)};
}

}  // namespace vkh
