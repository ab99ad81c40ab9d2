// Boxes of floats, four a node, over B's triangles of doubles. It steers: an upper bound holds for
// whichever triangle it finds, and no lower bound rests on it. Boxes are rounded outward and points
// too, so that it finds the nearest triangle to within rounding of doubles.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/native/math.h"

namespace vkh::native {

/// A triangle of B by its place in the tree's order, and the squared distance from it.
struct Nearest {
  double distance2 = 1e30;  ///< no two points are so far apart
  uint32_t place = kNone;
};

class FaceTree {
 public:
  FaceTree(std::span<const vec3> vertices, std::span<const glm::uvec3> faces);

  const Corners& triangle(uint32_t place) const { return triangles_[place]; }
  uint32_t face(uint32_t place) const { return order_[place]; }

  /// The better of `best` and the triangle at a place; of equally near ones the first in order.
  void try_triangle(const vec3& p, uint32_t place, Nearest& best) const {
    const double d2 = plain_distance2(p, triangles_[place]);
    if (d2 < best.distance2 || (d2 == best.distance2 && place < best.place)) best = {d2, place};
  }

  /// The nearest triangle, which may be that of `best`, where the search starts.
  Nearest nearest(const vec3& p, Nearest best) const;

 private:
  static constexpr uint32_t kWide = 4;
  static constexpr uint32_t kLeafFlag = 1u << 31;
  static constexpr uint32_t kCountShift = 28;  ///< of a leaf's triangles, less one
  static constexpr uint32_t kLeaf = 2;
  /// Boxes of 2^28 triangles, halved twice a level, leave three of four behind.
  static constexpr size_t kStack = 64;

  struct alignas(16) Node {
    std::array<std::array<float, kWide>, 3> lo, hi;
    std::array<uint32_t, kWide> child;
  };
  struct Box {
    std::array<float, 3> lo, hi;
  };
  struct Item {
    Box box;
    std::array<float, 3> middle;
    uint32_t face;
  };
  struct Range {
    uint32_t begin, end;
  };

  uint32_t build(std::vector<Item>& items, Range range);
  void set_child(std::vector<Item>& items, uint32_t node, uint32_t lane, Range range);

  std::vector<uint32_t> order_;
  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace vkh::native
