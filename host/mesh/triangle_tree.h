// A BVH over triangles on the host, for exact searches: its boxes are the corners' own, unrounded.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "host/mesh/orientation.h"

namespace vkh {

struct TriangleBox {
  glm::dvec3 lo, hi;
};
TriangleBox box_of(const Corners3& triangle);
inline bool overlap(const TriangleBox& x, const TriangleBox& y) {
  return x.lo.x <= y.hi.x && y.lo.x <= x.hi.x && x.lo.y <= y.hi.y && y.lo.y <= x.hi.y &&
         x.lo.z <= y.hi.z && y.lo.z <= x.hi.z;
}
/// The squared distance of p from the box, rounded: each operation by 2^-53 of itself.
inline double distance2(const glm::dvec3& p, const TriangleBox& box) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double d = std::max({box.lo[i] - p[i], p[i] - box.hi[i], 0.0});
    sum += d * d;
  }
  return sum;
}

class TriangleTree {
 public:
  /// `which`: the triangles that are in it.
  TriangleTree(std::span<const Corners3> triangles, std::vector<uint32_t> which);
  explicit TriangleTree(std::span<const Corners3> triangles);  ///< of all of them

  /// Calls see(triangle) for the triangles in boxes for which enter(box) is true, until a call
  /// returns false. Returns whether none did.
  template <class Enter, class See>
  bool walk(const Enter& enter, const See& see) const {
    if (nodes_.empty()) return true;
    std::array<uint32_t, kMostDepth> stack;
    size_t depth = 0;
    for (uint32_t at = 0;;) {
      const Node& node = nodes_[at];
      if (enter(node.box)) {
        if (node.count == 0) {
          stack[depth++] = node.first;
          ++at;
          continue;
        }
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
          if (!see(order_[i])) return false;
        }
      }
      if (depth == 0) return true;
      at = stack[--depth];
    }
  }

  /// Calls see(triangle), which may lower `reach2`, for the triangles in boxes whose squared
  /// distance from p is at most `reach2`; nearer boxes come first.
  template <class See>
  void nearest_first(const glm::dvec3& p, const double& reach2, const See& see) const {
    if (!nodes_.empty()) nearest_first(p, reach2, see, 0);
  }

 private:
  /// Halves of halves of 2^32 triangles.
  static constexpr size_t kMostDepth = 40;
  static constexpr uint32_t kLeaf = 4;
  struct Node {
    TriangleBox box;
    uint32_t
        first;  ///< place in order_ of a leaf's first one; or the second child, after the first
    uint32_t count;  ///< triangles of a leaf; 0: it has children
  };

  void build(std::span<const Corners3> triangles, uint32_t begin, uint32_t end);

  template <class See>
  void nearest_first(const glm::dvec3& p, const double& reach2, const See& see, uint32_t at) const {
    const Node& node = nodes_[at];
    if (node.count > 0) {
      for (uint32_t i = node.first; i < node.first + node.count; ++i) see(order_[i]);
      return;
    }
    const double left = distance2(p, nodes_[at + 1].box);
    const double right = distance2(p, nodes_[node.first].box);
    const bool is_left = left <= right;
    if (std::min(left, right) <= reach2)
      nearest_first(p, reach2, see, is_left ? at + 1 : node.first);
    if (std::max(left, right) <= reach2)
      nearest_first(p, reach2, see, is_left ? node.first : at + 1);
  }

  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace vkh
