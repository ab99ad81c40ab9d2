// Component-wise helpers for gpu::vec3.
#pragma once

#include <algorithm>

#include "shaders/gpu_types.h"

namespace vkh::test {

inline float component(const gpu::vec3& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
inline gpu::vec3 min(const gpu::vec3& p, const gpu::vec3& q) {
  return {std::min(p.x, q.x), std::min(p.y, q.y), std::min(p.z, q.z)};
}
inline gpu::vec3 max(const gpu::vec3& p, const gpu::vec3& q) {
  return {std::max(p.x, q.x), std::max(p.y, q.y), std::max(p.z, q.z)};
}
/// Compares values, so that 0 and -0 are equal.
inline bool same(const gpu::vec3& p, const gpu::vec3& q) {
  return p.x == q.x && p.y == q.y && p.z == q.z;
}

}  // namespace vkh::test
