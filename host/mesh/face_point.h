// The closest point of one triangle, in double, with a certified distance.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace vkh {

/// A point next to a triangle, at distance e from p.
struct FacePoint {
  glm::dvec3 point{};
  double lower = 0;  ///< <= e
  double upper = 0;  ///< >= e, and >= the distance of p from the triangle
};

/// Takes degenerate triangles as segments or points. All coordinates are finite. The point is a
/// corner, or within 2^-49 of the corners' largest coordinate along each axis (and 2^-1060) of the
/// triangle. Lengths that no double reaches are infinite in `upper`, and the largest double in
/// `lower`.
FacePoint closest_on_face(const glm::dvec3& p, const std::array<glm::dvec3, 3>& corners);

/// A lower bound of the distance of p from the triangle, and at most `near.upper`. `near`: what
/// closest_on_face gives for them.
double face_distance_down(const glm::dvec3& p, const std::array<glm::dvec3, 3>& corners,
                          const FacePoint& near);

}  // namespace vkh
