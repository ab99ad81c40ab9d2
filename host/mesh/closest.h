// The closest point of one triangle, in double: for showing the witness, not for certifying it.
#pragma once

#include <glm/vec3.hpp>

namespace vkh {

struct ClosestPoint {
  glm::dvec3 point{};
  glm::dvec3 barycentric{};
};

/// Degenerate triangles are segments or points.
ClosestPoint closest_point(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                           const glm::dvec3& c);

}  // namespace vkh
