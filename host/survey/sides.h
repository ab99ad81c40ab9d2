// Prepares the search for the sides of cells, and proves far points of one side;
// docs/certificate.md has the argument.
#pragma once

#include <cstdint>
#include <vector>

#include "host/solve/cells.h"
#include "host/survey/shells.h"
#include "host/survey/stoppable.h"
#include "vkhausdorff/field.h"

namespace vkh {

/// All statements are of the corners as the meshes hold them; Mesh::delta is no part of them.
class Sides {
 public:
  /// Keeps references to the pair's meshes. `goes_on` ends the search of an inside.
  explicit Sides(const SurveyedPair& pair, const GoesOn& goes_on = {});

  const Shells& shells() const { return shells_; }
  /// Whether B bounds a solid: shells().inside() is proven, of the corners as given.
  bool is_solid() const { return is_exact_ && shells_.inside() == Inside::kProven; }
  /// Returns the input of the search; valid as long as this lives.
  SideSearch search() const;

  /// The corner of the cell that is farthest from B, and a distance that is proven of it as it lies
  /// on the face. `hint`: a face of B that is near, or any other number.
  SidedPoint farthest_corner(const gpu::Cell& cell, uint32_t hint) const;

 private:
  double distance_down(const glm::dvec3& p, uint32_t hint) const;

  const Mesh &a_, &b_;
  const Frame frame_;
  const double displacement_;
  bool is_exact_ =
      true;  // scaling rounded nothing; it precedes the members whose initialisation sets it
  Shells shells_;
  std::vector<uint32_t> face_kinds_;
};

/// The side of a cell by its class.
CellSide side_of_class(uint32_t of_class);

}  // namespace vkh
