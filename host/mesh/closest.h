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
/// The same for coordinates of any size: closest_point() has products of four lengths, which
/// overflow above 1e77 and underflow below 1e-81.
ClosestPoint closest_point_of_any_size(const glm::dvec3& p, const glm::dvec3& a,
                                       const glm::dvec3& b, const glm::dvec3& c);

}  // namespace vkh
