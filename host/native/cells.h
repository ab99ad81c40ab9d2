// Bounds of d(x, B) over cells of A, in doubles, rounded outward to a device's floats.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "shaders/gpu_types.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/mesh.h"

namespace vkh::native {

struct Problem;

/// Triangles of B, by their places in a pair's own order, of which one is closest at each point of
/// a cell, and so at each point of a part of it; or any may be.
struct Nearby {
  static constexpr uint32_t kMost = 8;
  std::array<uint32_t, kMost> place{};
  uint32_t count = kMost + 1;            ///< more than kMost: any may be
  std::array<uint32_t, 3> at_corners{};  ///< the ones near a cell's corners, if it was bounded

  bool is_known() const { return count <= kMost; }
  void add(uint32_t triangle) {
    if (count < kMost) place[count] = triangle;
    count = std::min(count + 1, kMost + 1);
  }
};

/// The normals of A's faces, and then of B's, and the parameters of their comparison.
struct NormalsGiven {
  std::span<const gpu::FaceNormal> normals;
  gpu::SurveyNormalsPush push;
};

/// A pair in its frame, for bounding cells of A. Threads may share it.
class PlacedPair {
 public:
  /// Both outlive it, and are valid (check_mesh).
  PlacedPair(const Mesh& a, const Mesh& b);
  ~PlacedPair();

  const Frame& frame() const;
  double displacement() const;  ///< both meshes' together, in the frame
  double farthest() const;      ///< no distance is larger, in the files' unit

  /// A vertex of A in the frame, and its rest, as floats. It steers.
  gpu::Vertex vertex_of_a(uint32_t number) const;
  /// Bounds a cell, in the frame. `triangle` and `start` are places in this pair's own order of B.
  /// `near`: the triangles known to be near, which the call replaces by the ones found.
  gpu::CellBounds bounds(const gpu::Cell& cell, Nearby& near) const;
  /// How to split a cell that was bounded, by what bounds() returned: a code of math/dyadic.h.
  uint32_t split(const gpu::Cell& cell, const gpu::CellBounds& bounds, const Nearby& near) const;
  /// Finds the class of a cell with these bounds, as survey_sides.comp does. `face_kinds`: of B's
  /// faces.
  uint32_t side_class(const gpu::Cell& cell, const gpu::CellBounds& bounds,
                      const gpu::SurveySidesPush& search,
                      std::span<const uint32_t> face_kinds) const;
  /// Compares normals on a cell with these bounds, as survey_normals.comp does.
  gpu::CellAgreement agreement(const gpu::Cell& cell, const gpu::CellBounds& bounds,
                               const NormalsGiven& given) const;

 private:
  std::unique_ptr<const Problem> problem_;
};

}  // namespace vkh::native
