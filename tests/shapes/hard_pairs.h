// Small pairs of meshes on which certified solvers go wrong, by family, each from a seed: vkh_sweep
// solves them by the ten thousand.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/mesh/mesh_pair.h"
#include "tests/shapes/shapes.h"

namespace vkh::test {

struct HardPair {
  MeshPair pair;
  double tolerance = 1e-6;      ///< of A's diagonal
  std::optional<double> exact;  ///< h(A, B), where it is known without rounding
  /// If h is 0: the interval must be [0, u] with u at most so much of A's diagonal.
  std::optional<double> largest_gap_at_zero;
};

/// The families in the order of pairs: pair i is of family i % count.
std::vector<std::string> family_names();

/// The same on every machine whose libm rounds sin, cos and pow alike.
HardPair hard_pair(size_t family, uint64_t seed);

}  // namespace vkh::test
