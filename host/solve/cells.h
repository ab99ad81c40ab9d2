// Cells of A, for surveys, and single points: a device bounds them beside a run.
#pragma once

#include <functional>
#include <span>

#include "shaders/gpu_types.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/mesh.h"

namespace vkh {

/// One submission, which should take no longer than a user waits for Ctrl-C. Without cells: faces
/// of A from `first` on, as many as there are bounds.
struct CellBatch {
  std::span<const gpu::Cell> cells;
  uint32_t first = 0;
  std::span<gpu::CellBounds> bounds;  ///< in the frame, of the stored meshes
};

/// Points in B's frame, and the faces of B that are closest to them: one submission.
struct PointBatch {
  std::span<const gpu::Vertex> points;
  std::span<gpu::ClosestFace> found;  ///< as many
  bool has_low = false;               ///< B's vertices have low parts
};

/// A pair whose run has ended, while it still lies on the device.
struct SurveyedPair {
  const Mesh& a;
  const Mesh& b;
  Frame frame;
  double displacement;  ///< both meshes' together, in the frame
  double farthest;      ///< the run's upper bound: no distance is larger, in the files' units
  bool on_cpu;          ///< batches should be small
};

/// Bounds cells of A; blocks until it is done.
using BoundCells = std::function<void(const CellBatch&)>;
using Survey = std::function<void(const SurveyedPair&, const BoundCells&)>;

}  // namespace vkh
