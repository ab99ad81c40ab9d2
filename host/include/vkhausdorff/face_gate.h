// Decides whether each face of A is within a limit of its own.
#pragma once

#include <cstdint>
#include <span>

#include "vkhausdorff/solver.h"

namespace vkh {

/// The outcome. The interval of `report` is a true one of h(A,B) but wide: it was not sought.
struct FaceGate {
  Verdict verdict = Verdict::kUndecided;
  Report report;        ///< its witness, if beyond, is on a face that is beyond its limit
  Limit limit;          ///< that face's limit; otherwise the largest of all
  uint64_t within = 0;  ///< faces that are proven to be within their limits
  uint64_t runs = 0;    ///< runs of parts of A
};

/// `limits`: one for each face of A, each above 0; faces with similar limits are solved together,
/// and separately if that decides nothing. Ends at the first face that is beyond. Throws what
/// Solver::distance throws, and UsageError for limits that are not positive and finite, or too few.
/// options.limit is ignored; the time and the callback are those of all runs together.
FaceGate gate_faces(Solver& solver, const Mesh& a, const Mesh& b, std::span<const Limit> limits,
                    const SolveOptions& options);

}  // namespace vkh
