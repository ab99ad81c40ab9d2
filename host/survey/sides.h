// The side of B on which each cell lies, where that is proven; docs/certificate.md has the
// argument.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/survey/cell_store.h"
#include "host/survey/shells.h"

namespace vkh {

/// Finds sides of cells of a pair. All statements are of the corners as the meshes hold them;
/// Mesh::delta is no part of them.
class Sides {
 public:
  /// Keeps references to the pair's meshes.
  explicit Sides(const SurveyedPair& pair);

  const Shells& shells() const { return shells_; }
  /// Whether sides are shared: shells().inside() is proven, of the corners as given.
  bool is_shared() const { return is_exact_ && shells_.inside() == Inside::kProven; }

  /// The side of one cell, with these bounds.
  CellSide of(const gpu::Cell& cell, const gpu::CellBounds& bounds) const;
  /// The sides of all cells, in their order.
  std::vector<CellSide> of(const CellStore& cells) const;

  /// The side by the faces alone that may be closest somewhere on the cell. `hint`: a face of B, or
  /// any other number.
  CellSide by_faces(const gpu::Cell& cell, uint32_t hint) const;

 private:
  /// A cell's corners to within `off` in each coordinate.
  struct Placed {
    Corners3 corners;
    double off;
  };

  Placed placed(const gpu::Cell& cell) const;
  template <class Real>
  int side_of_plane(const gpu::Cell& cell, const Corners3& plane) const;
  double distance_up(const glm::dvec3& p, uint32_t hint) const;
  bool is_off(const gpu::Cell& cell, const gpu::CellBounds& bounds) const;
  CellSide by_winding(const gpu::Cell& cell) const;
  std::vector<CellSide> shared(const CellStore& cells) const;
  std::vector<CellSide> each_alone(const CellStore& cells) const;

  const Mesh &a_, &b_;
  const double displacement_;
  bool is_exact_ = true;  // scaling rounded nothing; before the members whose scaling tells it
  std::vector<glm::dvec3> vertices_;  // A's, scaled
  Shells shells_;
};

}  // namespace vkh
