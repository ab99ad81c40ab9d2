// The light on a face.
#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace vkh::drawing {

/// The light on a face: 1 if it looks at the viewer, so that its colour is the map's own. Light
/// comes from the upper left, and falls on both sides of a face. `normal`: as the viewer sees it,
/// of any length.
inline double light_on(glm::dvec3 normal) {
  constexpr double kDarkest = 0.6;
  const glm::dvec3 light = glm::normalize(glm::dvec3(-0.32, 0.42, 0.85));
  const double length = glm::length(normal);
  if (!(length > 0)) return 1;
  // The light wraps around the edges of the lit part, so that faces turned away keep their shape.
  const double lit = glm::dot(normal, light) * (normal.z < 0 ? -1 : 1) / length;
  const double share = std::min((1 + lit) / (1 + light.z), 1.0);
  return kDarkest + (1 - kDarkest) * share * share;
}

/// The normal of a triangle as it is seen, from its corners in pixels: a pixel's y turns around,
/// and its depth is in pixels, too. `scale`: pixels a unit.
inline glm::dvec3 normal_seen(const std::array<glm::dvec3, 3>& at, double scale) {
  const auto seen = [&](size_t i) { return glm::dvec3(at[i].x, -at[i].y, at[i].z * scale); };
  return glm::cross(seen(1) - seen(0), seen(2) - seen(0));
}

}  // namespace vkh::drawing
