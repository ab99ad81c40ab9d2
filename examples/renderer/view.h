// The camera, and what mesh.vert and mesh.frag are told of it.
#pragma once

#include <vulkan/vulkan.h>

#include <cmath>
#define GLM_FORCE_DEPTH_ZERO_TO_ONE
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

namespace example {

constexpr float kFieldOfView = 0.8f;  // radians, vertical

// The same values as in frame.glsl.
enum Mode : uint32_t { kPlain = 0, kEdges = 1, kErrors = 2 };

struct MeshPush {
  glm::mat4 view_projection;
  glm::vec3 eye;
  uint32_t mode, report_words;
};

/// The size of a pixel at `distance` from the camera, in a view of `rows` rows.
inline float pixel_at(float distance, uint32_t rows) {
  return 2 * std::tan(kFieldOfView / 2) * distance / static_cast<float>(rows);
}

/// From the origin to the eye, of length 1.
inline glm::vec3 to_eye(float angle) {
  return {0.8f * std::cos(angle), 0.8f * std::sin(angle), 0.6f};
}

/// Looks at the origin from `camera` away; no part of the scene is farther than `extent` from it.
inline MeshPush look(VkExtent2D part, float camera, float extent, float angle, uint32_t mode) {
  const glm::vec3 eye = camera * to_eye(angle);
  const float aspect = static_cast<float>(part.width) / static_cast<float>(part.height);
  glm::mat4 projection = glm::perspective(kFieldOfView, aspect, 0.2f, camera + 2 * extent);
  projection[1][1] = -projection[1][1];  // Vulkan's y points down
  const glm::mat4 view = glm::lookAt(eye, glm::vec3(0), glm::vec3(0, 0, 1));
  return {.view_projection = projection * view, .eye = eye, .mode = mode, .report_words = 0};
}

}  // namespace example
