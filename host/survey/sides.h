// The side of B on which each cell lies, where that is proven; docs/certificate.md has the
// argument.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/survey/cell_store.h"
#include "host/survey/measured.h"
#include "host/survey/shells.h"
#include "host/survey/stoppable.h"
#include "vkhausdorff/field.h"

namespace vkh {

/// The sides of a survey's cells that are known so far. A cell that is split keeps its side.
class KnownSides {
 public:
  /// Whether the cell was looked at as it is, or has a side from before it was split.
  bool has(const gpu::Cell& cell, size_t i) const;
  /// The side of cell i; kEnded unless has().
  CellSide of(const gpu::Cell& cell, size_t i) const;
  /// The sides of all cells, in their order.
  std::vector<CellSide> of(const CellStore& cells) const;

 private:
  friend class Sides;
  struct Known {
    CellSide side;
    gpu::uvec4 corners{};  ///< of the cell that was looked at
    bool is_known = false;
  };
  std::vector<Known> cells_;
  std::vector<CellSide> faces_;    ///< of whole faces, where they were looked at
  std::vector<uint8_t> is_tried_;  ///< whether the face was looked at as a whole
};

/// Finds sides of cells of a pair. All statements are of the corners as the meshes hold them;
/// Mesh::delta is no part of them.
class Sides {
 public:
  /// Keeps references to the pair's meshes. `goes_on` ends the search of an inside, and find().
  explicit Sides(const SurveyedPair& pair, GoesOn goes_on = {});

  const Shells& shells() const { return shells_; }
  /// Whether sides are shared: shells().inside() is proven, of the corners as given.
  bool is_shared() const { return is_exact_ && shells_.inside() == Inside::kProven; }

  /// The side of one cell, with these bounds.
  CellSide of(const gpu::Cell& cell, const gpu::CellBounds& bounds) const;
  /// The sides of all cells, in their order.
  std::vector<CellSide> of(const CellStore& cells) const;
  /// Finds those sides of cells that are not known yet: of all that reach above `above`, in the
  /// frame. Returns whether it was not ended. The other arguments are the same ones each time.
  bool find(const CellStore& cells, double above, KnownSides& known) const;

  /// The corner of the cell that is farthest from B, and a distance that is proven of it as it lies
  /// on the face. `hint`: as for by_faces().
  SidedPoint farthest_corner(const gpu::Cell& cell, uint32_t hint) const;

  /// The side by the faces alone that may be closest somewhere on the cell. `hint`: a face of B, or
  /// any other number.
  CellSide by_faces(const gpu::Cell& cell, uint32_t hint) const;

 private:
  PlacedCell placed(const gpu::Cell& cell) const;
  template <class Real>
  int side_of_plane(const gpu::Cell& cell, const Corners3& plane) const;
  double distance_up(const glm::dvec3& p, uint32_t hint) const;
  bool is_off(const gpu::Cell& cell, const gpu::CellBounds& bounds) const;
  CellSide by_winding(const gpu::Cell& cell) const;
  double distance_down(const glm::dvec3& p, uint32_t hint) const;
  bool find_shared(const CellStore& cells, const std::vector<size_t>& open,
                   KnownSides& known) const;
  bool find_alone(const CellStore& cells, const std::vector<size_t>& open, KnownSides& known) const;
  bool look_at_faces(const CellStore& cells, const std::vector<size_t>& open,
                     KnownSides& known) const;
  void look_at(const CellStore& cells, size_t i, KnownSides& known) const;

  const Mesh &a_, &b_;
  const Frame frame_;
  const double displacement_;
  const GoesOn goes_on_;
  bool is_exact_ = true;  // scaling rounded nothing; before the members whose scaling tells it
  std::vector<glm::dvec3> vertices_;  // A's, scaled
  Shells shells_;
};

}  // namespace vkh
