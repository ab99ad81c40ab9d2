// Simplifies a mesh to a limit that is proven: the result is as near to A as was asked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include "vkhausdorff/limit.h"
#include "vkhausdorff/solver.h"

namespace vkh {

/// Handed to the progress callback before each candidate is judged.
struct SimplifyProgress {
  size_t tried = 0;            ///< candidates that were judged
  uint64_t faces = 0;          ///< of the smallest that passed, or of A
  uint64_t faces_of_next = 0;  ///< of the next candidate
};

struct SimplifyOptions {
  Limit max;  ///< the limit in A's unit, both ends positive and finite
  /// Limits h(A, result) alone: each point of A is near the result. Otherwise h(result, A) too.
  bool one_way = false;
  bool lock_borders = false;     ///< keeps each vertex of an edge that only one face has
  bool rounds_to_float = false;  ///< the result has coordinates that are float32, as some files do
  double time_limit_s = std::numeric_limits<double>::infinity();
  SolveOptions solve;  ///< switches, preset and memory of the runs; the rest is not read
  std::function<bool(const SimplifyProgress&)> progress;  ///< false ends the search
  std::function<bool()> goes_on;  ///< asked within runs, too; false ends the search
};

/// How far two meshes are apart, both ways or from A alone.
struct Deviation {
  Report a_to_b;
  std::optional<Report> b_to_a;  ///< none if one_way
  /// Encloses the larger of the distances that were asked; `upper` is at most max.within where
  /// `verdict` is kWithin.
  CertifiedInterval interval;
  Verdict verdict = Verdict::kUndecided;  ///< whether it is within max
};

struct Simplified {
  Mesh mesh;              ///< without faces if `found` is false; its unit is A's
  Deviation deviation;    ///< from A, as it is returned
  bool found = false;     ///< whether a mesh passed; its faces may still be as many as A's
  bool complete = false;  ///< false: time or the callback ended the search, not its own steps
  size_t tried = 0;       ///< candidates that were judged
};

/// Finds a mesh with few faces, whose vertices are some of A's, within options.max of A. Each
/// candidate is judged by two runs of the solver, so the limit holds in exact arithmetic; nothing
/// else is promised: neither watertightness, nor orientation, nor the fewest faces possible. Throws
/// UsageError for a limit that is not positive and finite and in a build without meshoptimizer;
/// InputError and DeviceError as Solver does. The time limit is checked between candidates and
/// within runs.
Simplified simplify(Solver& solver, const Mesh& a, const SimplifyOptions& options);

/// The pipelines for Solver::make_ready() that simplify() begins with, where `solve` has this
/// `engine` and the limit is `share` of A's diagonal: to be made while A is read.
EngineOptions simplify_engine(const EngineOptions& engine, double share);

/// Encloses the distance of `b` from `a` to a thousandth of the limit, and judges it: for a mesh
/// that was written and read back. `options` are those of simplify(); progress is not called.
Deviation measure_deviation(Solver& solver, const Mesh& a, const Mesh& b,
                            const SimplifyOptions& options);

}  // namespace vkh
