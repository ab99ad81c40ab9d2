// Exact statements about points, triangles and segments in space, for all finite doubles.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace vkh {

using Corners3 = std::array<glm::dvec3, 3>;

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
