// Distances of A's points from all of B, measured on the host in double: a point has no halves
// whose bounds would be narrower.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "host/mesh/triangle_tree.h"
#include "host/solve/cells.h"
#include "host/survey/statistics.h"

namespace vkh {

class PointDistances {
 public:
  /// Keeps references to the pair's meshes; A's faces are points.
  explicit PointDistances(const SurveyedPair& pair);

  /// Narrows the bounds of a point of A, by its face. Its three corners are one, and so are its
  /// bounds. Leaves them as they are where the scale of the frame rounds a coordinate.
  gpu::CellBounds narrowed(uint32_t face, const gpu::CellBounds& bounds) const;

  /// The points that matter: a cut lies between their bounds, or these are wider than asked.
  struct Asked {
    std::span<const Threshold> cuts;
    double least;
  };
  struct Measured {
    size_t count = 0;
    bool are_all = true;  ///< no other one matters
  };
  /// Narrows the bounds of such points, `most` at most; an entry of each for each point.
  Measured narrow(std::span<const gpu::Cell> points, std::span<gpu::CellBounds> bounds,
                  const Asked& asked, size_t most) const;

 private:
  Corners3 corners(uint32_t face) const;
  std::optional<glm::dvec3> point(uint32_t face) const;

  const Mesh &a_, &b_;
  const Frame frame_;
  const double displacement_;
  bool is_exact_ =
      true;  // scaling B rounded nothing; it precedes the vertices, whose initialisation sets it
  std::vector<glm::dvec3> vertices_;  // B's, scaled
  TriangleTree tree_;
};

}  // namespace vkh
