// Boxes of floats, four a node, over B's triangles of doubles. Boxes and points are rounded
// outward, so that no box is farther than its triangles. A search for the nearest triangle steers:
// any triangle that it finds gives a true upper bound. Bounds of cells from below rest on the boxes
// (Walk).
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "host/native/math.h"

namespace vkh::native {

/// A triangle of B by its place in the tree's order, and the squared distance from it.
struct Nearest {
  double distance2 = 1e30;  ///< larger than any distance
  uint32_t place = kNone;
};

/// Floats below and above x. The float nearest to x is off by half a unit in its last place, or by
/// 2^-150; what is taken off is one unit and 2^-126 at least, and rounding leaves a unit of it. So
/// they are below and above any sum x + y, too, where |y| is 2^-53 of |x| at most.
inline float float_below(double x) {
  const auto f = static_cast<float>(x);
  return f - (std::fabs(f) * 0x1p-23f + std::numeric_limits<float>::min());
}
inline float float_above(double x) {
  const auto f = static_cast<float>(x);
  return f + (std::fabs(f) * 0x1p-23f + std::numeric_limits<float>::min());
}

/// A point between floats.
struct FloatPoint {
  std::array<float, 3> below, above;
  explicit FloatPoint(const vec3& p)
      : below{float_below(p.x), float_below(p.y), float_below(p.z)},
        above{float_above(p.x), float_above(p.y), float_above(p.z)} {}
};

/// Places of triangles in the tree's order.
struct Leaf {
  uint32_t begin = 0, end = 0;
  bool is_none() const { return begin == end; }
};

class FaceTree {
 public:
  FaceTree(std::span<const vec3> vertices, std::span<const glm::uvec3> faces);

  size_t count() const { return triangles_.size(); }
  const Corners& triangle(uint32_t place) const { return triangles_[place]; }
  uint32_t face(uint32_t place) const { return order_[place]; }

  /// The better of `best` and the triangle at a place; of equally near ones the first in order.
  void try_triangle(const vec3& p, uint32_t place, Nearest& best) const {
    const double d2 = plain_distance2(p, triangles_[place]);
    if (d2 < best.distance2 || (d2 == best.distance2 && place < best.place)) best = {d2, place};
  }

  /// The nearest triangle, which may be that of `best`, where the search starts.
  Nearest nearest(const vec3& p, Nearest best) const;

  struct Box {
    std::array<float, 3> lo, hi;
  };
  /// Calls look(place) for the triangles in all boxes for which `may_hold` is true, until a call
  /// returns false; returns whether none did.
  template <class MayHold, class Look>
  bool each_in(const MayHold& may_hold, const Look& look) const;

 private:
  friend class Walk;
  static constexpr uint32_t kWide = 4;
  static constexpr uint32_t kLeafFlag = 1u << 31;
  static constexpr uint32_t kCountShift = 28;  ///< of a leaf's triangles, less one
  static constexpr uint32_t kLeaf = 2;
  struct alignas(16) Node {
    std::array<std::array<float, kWide>, 3> lo, hi;
    std::array<uint32_t, kWide> child;
  };
  struct Item {
    Box box;
    std::array<float, 3> middle;
    uint32_t face;
  };
  struct Range {
    uint32_t begin, end;
  };

  /// Boxes of 2^28 triangles, halved twice a level, leave three of four behind.
  static constexpr size_t kStack = 64;
  static Box box_of(const Node& node, size_t lane) {
    return {{node.lo[0][lane], node.lo[1][lane], node.lo[2][lane]},
            {node.hi[0][lane], node.hi[1][lane], node.hi[2][lane]}};
  }
  static Leaf leaf_of(uint32_t child) {
    const uint32_t begin = child & ((1u << kCountShift) - 1);
    return {begin, begin + ((child & ~kLeafFlag) >> kCountShift) + 1};
  }
  uint32_t build(std::vector<Item>& items, Range range);
  void set_child(std::vector<Item>& items, uint32_t node, uint32_t lane, Range range);

  std::vector<uint32_t> order_;
  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
};

/// Visits the leaves of a tree around a point, the nearest box of each node first.
class Walk {
 public:
  /// The tree outlives it.
  Walk(const FaceTree& tree, const vec3& p);

  /// Returns the next leaf whose box has a squared distance, rounded down, of at most `reach2`; an
  /// empty leaf if none is left. The reach may fall from call to call, and is under 2^127.
  Leaf next(float reach2);
  /// <= the squared distance of all triangles that are left, or reach2 if that is less.
  float least_left(float reach2) const;

 private:
  struct Waiting {
    float distance2;
    uint32_t child;
  };
  void open(uint32_t node, float reach2);

  const FaceTree& tree_;
  const FloatPoint point_;
  std::array<Waiting, FaceTree::kStack> waiting_;
  size_t count_ = 0;
};

template <class MayHold, class Look>
bool FaceTree::each_in(const MayHold& may_hold, const Look& look) const {
  std::array<uint32_t, kStack> waiting;
  size_t left = 0;
  waiting[left++] = 0;
  while (left > 0) {
    const uint32_t at = waiting[--left];
    if ((at & kLeafFlag) != 0) {
      const Leaf leaf = leaf_of(at);
      for (uint32_t i = leaf.begin; i < leaf.end; ++i) {
        if (!look(i)) return false;
      }
      continue;
    }
    for (size_t lane = 0; lane < kWide; ++lane) {
      if (may_hold(box_of(nodes_[at], lane))) waiting[left++] = nodes_[at].child[lane];
    }
  }
  return true;
}

}  // namespace vkh::native
