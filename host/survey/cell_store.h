// Cells that tile A, each with its bounds and its share of its face.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/solve/cells.h"

namespace vkh {

/// No point of the cell is nearer.
float lowest(const gpu::CellBounds& bounds);

/// Cells of the faces of A: at first one a face, which is the face. A split halves a cell at the
/// middle of its longest edge, so that its area is 2^-depth of its face's, exactly.
class CellStore {
 public:
  /// No distance is above `farthest`.
  CellStore(const Mesh& a, float farthest);

  size_t count() const { return cells_.size(); }
  const gpu::Cell& cell(size_t i) const { return cells_[i]; }
  const gpu::CellBounds& bounds(size_t i) const { return bounds_[i]; }
  uint32_t face(size_t i) const { return cells_[i].face; }
  /// Of its face's area.
  double share(size_t i) const { return shares_[depth_[i]]; }

  /// With what was found of some cells. None is named twice.
  void narrow(std::span<const size_t> which, std::span<const gpu::CellBounds> found);
  /// Whether its longest edge's middle is a dyadic point of the face: 20 bits may have run out.
  bool can_split(size_t i) const { return opposite_[i] != kNoSplit; }
  /// Each cell becomes one half of itself; the others are the last cells, in the same order. Both
  /// keep what of its bounds holds for them, until they are narrowed. None is named twice.
  void split(std::span<const size_t> which);

  /// Of the greatest distance on a face: some point is so far, and none farther.
  float reached(uint32_t face) const { return reached_[face]; }
  std::vector<float> highest_of_faces() const;
  /// On any face.
  float reached() const;

 private:
  static constexpr unsigned kMostDepth = 64;
  static constexpr uint8_t kNoSplit = 3;

  void split(size_t i, size_t half);
  void see_split(size_t i);

  const Mesh& a_;
  std::vector<gpu::Cell> cells_;
  std::vector<gpu::CellBounds> bounds_;
  std::vector<uint8_t> depth_;
  std::vector<uint8_t> opposite_;  // which corner its longest edge is opposite of, or kNoSplit
  std::vector<float> reached_;     // of each face
  std::vector<double> shares_;
};

}  // namespace vkh
