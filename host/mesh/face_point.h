// The closest point of one triangle, in double, with a certified distance.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>

namespace vkh {

/// A point of a triangle: base + v (end - base) + w (third - base), by corners' numbers. 0 <= v, w
/// and v + w <= 1 hold exactly, so that the exact point lies in the triangle, however v and w were
/// rounded.
struct FaceWeights {
  size_t base = 0, end = 1, third = 2;
  double v = 0, w = 0;
  double distance2 = std::numeric_limits<double>::infinity();  ///< steers
};
/// Finds the weights of a point next to the closest one.
FaceWeights closest_weights(const glm::dvec3& p, const std::array<glm::dvec3, 3>& corners);

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
