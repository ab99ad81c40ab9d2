// The closest point of one triangle, in double: to show the witness, not to certify it.
#pragma once

#include <glm/vec3.hpp>

namespace vkh {

struct ClosestPoint {
  glm::dvec3 point{};
  glm::dvec3 barycentric{};
};

/// Takes degenerate triangles as segments or points.
ClosestPoint closest_point(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                           const glm::dvec3& c);

}  // namespace vkh
