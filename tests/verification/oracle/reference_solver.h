// The independent oracle: directed Hausdorff distances in double precision on one CPU core, written
// from the mathematics (docs/method.md, sections 3 and 7) and sharing no code with the engine.
#pragma once

#include <cstdint>

#include "tests/verification/oracle/closest.h"
#include "vkhausdorff/mesh.h"

namespace vkh::test {

struct Interval {
  double lower = 0.0;
  double upper = 0.0;

  bool contains(double value) const { return lower <= value && value <= upper; }
  bool meets(const Interval& other) const { return lower <= other.upper && other.lower <= upper; }
};

/// The solver's work, for comparison.
struct ReferenceStats {
  uint64_t candidates = 0;  ///< sub-triangles of A whose upper bound was computed, A's faces too
  uint64_t queries = 0;     ///< closest-point queries against B
  uint32_t waves = 0;       ///< generations of subdivision
};

/// Encloses h(A, B). The interval holds no matter what stopped the search; its width is at most
/// absolute_tolerance plus 2 * 64 * 2^-53 * the joint diagonal (the rounding margin) unless
/// max_candidates were bounded first.
Interval reference_hausdorff(const Mesh& a, const Mesh& b, double absolute_tolerance,
                             uint64_t max_candidates = 4'000'000, ReferenceStats* stats = nullptr);

}  // namespace vkh::test
