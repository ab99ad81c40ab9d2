// Exact statements about points, triangles and segments in space, for all finite doubles.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace vkh {

using Corners3 = std::array<glm::dvec3, 3>;

/// A sum of determinants of three vectors in plain doubles, and the size of its terms.
struct DeterminantSum {
  double sum = 0, size = 0, largest = 0;

  void add(const Corners3& vectors);
  /// The sum's sign, or 0 where `roundings` of 2^-53 of the terms' sizes leave it open. What
  /// underflows is under 2^-1070 times the largest coordinate, which is far below the size that is
  /// asked for.
  int sign(double roundings) const;
};

/// The side of triangle abc on which d lies: 1 in front, where a, b, c turn left as seen from d; -1
/// behind; 0 in the plane, or if abc is degenerate.
int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// Says which way the triangle turns as it is seen against the axis: the sign of its normal's
/// component along the axis.
int turn_along(int axis, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Whether the closed segment pq and the closed triangle have a point in common. The triangle is
/// not degenerate.
bool segment_meets(const glm::dvec3& p, const glm::dvec3& q, const Corners3& triangle);

}  // namespace vkh
