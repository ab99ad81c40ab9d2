// Cells that tile A, each with its bounds and its share of its face.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/solve/cells.h"

namespace vkh {

/// The least distance from below: no point of the cell is nearer.
float lowest(const gpu::CellBounds& bounds);

/// The number of the corner opposite the longest edge of a cell of A, at which it is halved. It
/// only steers.
uint32_t opposite_longest(const Mesh& a, const gpu::Cell& cell);

/// Cells of the faces of A: at first one a face, which is the face. A split halves a cell at the
/// middle of its longest edge, so that its area is 2^-depth of its face's, exactly.
class CellStore {
 public:
  /// No distance is above `farthest`.
  CellStore(const Mesh& a, float farthest);
  /// Takes over cells that a device has refined, with the distances that each face reaches.
  CellStore(const Mesh& a, std::vector<gpu::Cell> cells, std::vector<gpu::CellBounds> bounds,
            std::vector<float> reached);

  size_t count() const { return cells_.size(); }
  const gpu::Cell& cell(size_t i) const { return cells_[i]; }
  const gpu::CellBounds& bounds(size_t i) const { return bounds_[i]; }
  uint32_t face(size_t i) const { return cells_[i].face; }
  /// The cell's share of its face's area.
  double share(size_t i) const { return shares_[depth_[i]]; }

  /// Narrows the bounds of some cells to what was found. No cell is named twice.
  void narrow(std::span<const size_t> which, std::span<const gpu::CellBounds> found);
  /// Returns whether its longest edge's middle is a dyadic point of the face: 20 bits may have run
  /// out. A point is measured, once, in place of being split.
  bool can_split(size_t i) const { return opposite_[i] != kNoSplit; }
  /// Marks cells whose bounds no split narrows: can_split() is false from now on.
  void close(std::span<const size_t> which);
  /// Makes each cell one half of itself; the others are the last cells, in the same order. Both
  /// keep the bounds that hold for them, until they are narrowed. No cell is named twice.
  void split(std::span<const size_t> which);

  /// The greatest distance known on a face: some point is so far, and none is known to be farther.
  float reached(uint32_t face) const { return reached_[face]; }
  const std::vector<float>& reached_of_faces() const { return reached_; }
  std::vector<float> highest_of_faces() const;
  /// The same on any face.
  float reached() const;

 private:
  static constexpr unsigned kMostDepth = 64;
  static constexpr uint8_t kNoSplit = 3;

  void split(size_t i, size_t half);
  void see_split(size_t i);
  void set_shares();

  const Mesh& a_;
  std::vector<gpu::Cell> cells_;
  std::vector<gpu::CellBounds> bounds_;
  std::vector<uint8_t> depth_;
  std::vector<uint8_t> opposite_;  // the corner opposite its longest edge, or kNoSplit
  std::vector<float> reached_;     // one per face
  std::vector<double> shares_;
};

}  // namespace vkh
