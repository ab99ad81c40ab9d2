// The map of a mesh in as few cells as a page can hold. The shown distance is affine over each
// cell, and remains true: a cell that stands for others has a width that covers theirs.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/show/map_scale.h"
#include "vkhausdorff/mesh.h"

namespace vkh {

/// The distances that are shown of a part of a mesh, in the files' units.
struct ShownValue {
  /// At its corners, affine in between. Signed if the map has sides, and 0 if the part is near and
  /// its side is not known.
  std::array<double, 3> at{};
  double width = 0;          ///< no distance of the part differs more from the shown one
  bool is_hatched = false;   ///< more than half of its area is not resolved
  bool is_sideless = false;  ///< a map has sides, and none for it: `at` is without a sign
  bool is_left_out = false;  ///< CellMap::is_left_out
};

/// The shown values of a cell of a map.
ShownValue shown_value(const CellMap& map, const drawing::MapScale& scale, const MapCell& cell);

struct ShownCell {
  std::array<uint32_t, 4> corners{};  ///< as MapCell has them
  uint32_t face = 0;
  ShownValue value;
};

/// Cells of a map, which tile the same faces and are no more than `most`, or one for each face if
/// that is more. Halves are joined to one cell: first where no colour of the bar changes visibly,
/// and then where that changes the colours of the least area.
std::vector<ShownCell> shown_cells(const Mesh& mesh, const CellMap& map,
                                   const drawing::MapScale& scale, size_t most);

/// A map of whole faces, for bounds of faces alone: the middle of each face's bounds, as wide as
/// they are. `bar`: CellMap::bar.
CellMap map_of_bounds(const Mesh& mesh, const Field& field, double bar);
/// The same for the lower bounds: a face is only farther than another if that is proven.
CellMap map_of_lower_bounds(const Mesh& mesh, const Field& field);

}  // namespace vkh
