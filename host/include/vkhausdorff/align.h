// The rotation and shift that lay one mesh onto another: a fit that is found, not proven the best.
#pragma once

#include <cstdint>

#include "vkhausdorff/mesh_transform.h"
#include "vkhausdorff/solver.h"

namespace vkh {

struct AlignOptions {
  uint32_t samples = 40'000;  ///< points of A in the last stage; more resolve finer than the noise
  /// Called between the steps, on the running thread, with the number of closest points found so
  /// far; false ends the fit with Interrupted.
  ClosestGoesOn goes_on = {};
};

struct Alignment {
  /// A rotation and a shift: x of A goes to matrix x. The rotation's entries are each rounded once,
  /// so that |R^T R - I| is at most 1e-15; its determinant is 1.
  MatrixRows matrix;
  FoundFit fit;
};

/// Finds a place for A at which samples of its area are close to B: from where A lies, from its
/// principal axes laid on B's in their four turns, and from many turns where those do not decide.
/// Iterated closest points: the nearest 80 % of the samples, and at last all within three times
/// their noise, go down the square of their distance from B. Where A is off, its mirror image is
/// tried, too, and reported if it lies far closer; A is never mirrored. The same meshes give the
/// same bits on the same device. Throws what Solver::closest throws, and Interrupted where
/// `goes_on` says no.
Alignment align(Solver& solver, const Mesh& a, const PreparedMesh& b,
                const AlignOptions& options = {});
Alignment align(Solver& solver, const Mesh& a, const Mesh& b, const AlignOptions& options = {});

}  // namespace vkh
