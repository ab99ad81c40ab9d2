// The side of a mesh on which a point lies, in exact integers: by the number of times that the mesh
// winds round it, and by the planes of all faces that are closest to it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tests/verification/oracle/closest.h"
#include "tests/verification/oracle/exact.h"
#include "vkhausdorff/mesh.h"

namespace vkh::test {

/// Points of A's faces, and all of B, as integers over one power of two.
class ExactSides {
 public:
  /// Barycentrics of points add up to 2^kBits.
  static constexpr unsigned kBits = 24;

  ExactSides(const Mesh& a, const Mesh& b);

  exact::Vector point(uint32_t face, const glm::uvec3& weights) const;
  /// Nothing if the point lies on B, or if rays along all axes meet edges.
  std::optional<int> winding(const exact::Vector& p) const;

  struct Closest {
    int above = 0, below = 0, in_plane = 0;  ///< planes of closest faces, as seen from the point
    int degenerate = 0;                      ///< closest faces without a plane
  };
  /// `near`: the point to within `off`.
  Closest closest(const exact::Vector& p, const glm::dvec3& near, double off) const;

  const ClosestTree& tree() const { return tree_; }

 private:
  struct Face {
    std::array<exact::Vector, 3> corners;
    std::array<Integer, 3> lo, hi;
    std::array<double, 3> below, above;  // of these, by more than they are rounded
  };
  std::optional<int> winding_along(size_t axis, const exact::Vector& p) const;

  std::vector<exact::Vector> a_;
  std::vector<glm::uvec3> faces_a_;
  std::vector<Face> b_;
  std::vector<std::array<glm::dvec3, 3>> near_b_;
  ClosestTree tree_;
};

}  // namespace vkh::test
