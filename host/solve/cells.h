// Cells of A, for surveys, and single points: a device bounds them beside a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "shaders/gpu_types.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/mesh.h"

namespace vkh {

/// One submission, which should take no longer than a user waits for Ctrl-C. Without cells it is of
/// A's faces from `first` on, as many as there are bounds.
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

/// The bounds of a cell of which nothing is known except that no distance is above `farthest`.
inline gpu::CellBounds unknown_bounds(float farthest) {
  return {.lower_a = 0,
          .lower_b = 0,
          .lower_c = 0,
          .upper_a = farthest,
          .upper_b = farthest,
          .upper_c = farthest,
          .highest = farthest,
          .reached = 0,
          .mean_upper = farthest,
          .square_upper = std::numeric_limits<float>::max(),
          .face_a = gpu::kNone,
          .face_b = gpu::kNone,
          .face_c = gpu::kNone,
          .face = gpu::kNone,
          .triangle = gpu::kNone};
}

/// The cells to split: all `above` cells whose score's bin is larger than `bin`, and the first
/// `ties` cells of this bin.
struct SurveyChoice {
  uint32_t bin = 0, above = 0, ties = 0;
  uint32_t parts = 4;  ///< halves of halves; or 2
  uint32_t count() const { return above + ties; }
};

struct CellRange {
  uint32_t first = 0, count = 0;
};

/// The input of a search for the sides of cells.
struct SideSearch {
  /// The kind of each face of B: gpu::kFaceCovered and so on.
  std::span<const uint32_t> face_kinds;
  /// B bounds a solid: it winds `front` times round all that is in front of its faces, and one time
  /// more or less round all other points off it.
  bool is_solid = false;
  int front = 0;
  float moved = 0;  ///< the most that both meshes' vertices together are from where they are stored
  float near = 0;   ///< a part of a cell that is nearer needs no side
};

/// The input of a comparison of normals.
struct NormalSearch {
  std::span<const gpu::FaceNormal> normals;  ///< of A's faces, and then of B's
  float moved = 0;  ///< the most that both meshes' vertices together are from where they are stored
  float limit_down = 0,
        limit_up = 1;  ///< normals agree if their cosine is at least a limit between these two
};

/// Cells, one entry each, until they change or are read again.
struct CellsRead {
  std::span<const gpu::Cell> cells;
  std::span<const gpu::CellBounds> bounds;
  std::span<const uint32_t> classes;
};

/// A survey's cells, which stay on the device: they tile A, each with its bounds. Calls block until
/// the device has done the work, unless their comment says otherwise.
class SurveyCells {
 public:
  virtual ~SurveyCells() = default;
  /// Makes each face of A a cell, without bounds. `weights`: of the faces' areas, together under
  /// 2^62. No distance is above `farthest`, in the frame.
  virtual void begin(std::span<const uint64_t> weights, float farthest) = 0;
  virtual size_t count() const = 0;
  /// The most cells that the device can bind.
  virtual size_t most() const = 0;
  /// Counts some cells by the bins of their scores, gpu::kScoreBins of them; bin 0 has the cells
  /// that keep their face open although no split helps. All cells must be scored before a split.
  virtual std::span<const uint32_t> score(const gpu::SurveyPlan& plan, const CellRange& some) = 0;
  /// Splits each chosen cell into parts, which have no bounds of their own until bound(); returns
  /// false, and does nothing, if there is no memory for them. It need not wait.
  virtual bool split(const SurveyChoice& choice) = 0;
  /// Bounds new cells, which are the parts of split cells, or A's faces. `wait`: false if
  /// more of them or a tally follow.
  virtual void bound(size_t first, size_t count, bool wait) = 0;
  /// Adds up some cells at the plan's edges. Every distance is below 2^(unit - 127).
  virtual const gpu::SurveyTable& tally(const gpu::SurveyPlan& plan, int unit,
                                        const CellRange& some) = 0;
  /// Finds the sides of some cells that have none yet and are farther than `above` somewhere, in
  /// the frame. Parts of a cell have its side.
  virtual void find_sides(const SideSearch& search, float above, const CellRange& some) = 0;
  /// Takes the normals of both meshes, which outlive what follows, for find_normals().
  virtual void begin_normals(const NormalSearch& search) = 0;
  /// Compares normals on the cells of a range where that was not done. These cells lose their
  /// sides.
  virtual void find_normals(const CellRange& some) = 0;
  /// Returns, for each face of A, a distance that some point of its cells of `reached_classes`
  /// reaches, and then, for each, a distance that no point of its cells of `highest_classes`
  /// exceeds; 0 for a face without such cells.
  virtual std::vector<float> faces(uint32_t reached_classes, uint32_t highest_classes) = 0;
  /// Reads some cells.
  virtual CellsRead read(const CellRange& some) = 0;
  /// Takes over bounds that the caller has narrowed.
  virtual void write(const CellRange& some, std::span<const gpu::CellBounds> bounds) = 0;
};

/// Bounds cells of A; blocks until it is done.
using BoundCells = std::function<void(const CellBatch&)>;

/// A pair that lies on the device.
struct SurveyedPair {
  const Mesh& a;
  const Mesh& b;
  Frame frame;
  double displacement;  ///< both meshes' together, in the frame
  double farthest;      ///< no distance is larger, in the files' units
  bool on_cpu;          ///< batches should be small
  BoundCells bound = {};
  SurveyCells* cells = nullptr;  ///< null: its cells can only be bounded
};

using UsePair = std::function<void(const SurveyedPair&)>;
using UsePairs = std::function<void(std::span<const SurveyedPair>)>;

}  // namespace vkh
