// Where a user puts a mesh: in another unit, and by a matrix.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "vkhausdorff/needs_cpp20.h"

namespace vkh {

/// The three upper rows of a matrix by rows, whose last row is 0 0 0 1.
using MatrixRows = std::array<std::array<double, 4>, 3>;

/// Maps x to matrix (numerator / denominator x): the unit first, then the matrix.
struct MeshTransform {
  double numerator = 1, denominator = 1;  ///< positive whole numbers, exact as doubles
  std::optional<MatrixRows> matrix = {};

  bool is_identity() const { return numerator == denominator && !matrix; }
  bool operator==(const MeshTransform&) const = default;
};

/// A fit that was found, not proven the best: how close a mesh is where it was laid.
struct FoundFit {
  double rms = 0;        ///< root mean square distance of the samples that count, in B's unit
  double share = 0;      ///< of the samples: those within three deviations, which count
  uint64_t samples = 0;  ///< points of A's area
  bool is_poor = false;  ///< far from B for its size, or few count: look at it
  /// Set if another place is about as good, such as for a symmetric part: the root mean square of
  /// the nearest 80 % there.
  std::optional<double> rival = {};
  /// Set if A's mirror image would lie far closer to B than A does: the root mean square of all
  /// samples there, none farther than a twentieth of B's size.
  std::optional<double> mirrored = {};

  bool operator==(const FoundFit&) const = default;
};

/// How a mesh came to where it is, for a mesh that was placed.
struct PlacedFrom {
  MeshTransform by;
  std::string from = {};     ///< the unit that it was in; empty: unknown
  double delta = 0;          ///< Mesh::delta before it was rounded here, as long as it is now
  std::string corners = {};  ///< SHA-256 of its corners before, in hexadecimal digits, if asked for
  std::optional<FoundFit> fit = {};  ///< the matrix was found by align()
};

}  // namespace vkh
