// A mesh whose faces are split at their edges' midpoints, again and again. Neither its surface nor
// any distance from it changes, if every midpoint is exact in double.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/pairs/dyadic.h"
#include "tools/pairs/ply_stream.h"
#include "vkhausdorff/mesh.h"

namespace vkh::pairs {

/// Splitting k times cuts every edge into n = 2^k pieces and every face into n^2. Its corners are
/// then (i a + j b + l c) / n, for i + j + l = n. Edges that faces share share them. Memory grows
/// with the mesh and not with the output.
class Subdivision {
 public:
  static constexpr uint32_t kMostLevels = 15;

  /// Throws InputError that names the first point that double does not hold, and UsageError if
  /// indices of 32 bits do not suffice. The mesh has to outlive it.
  Subdivision(const Mesh& mesh, uint32_t levels);

  const PlyShape& shape() const { return shape_; }
  /// The children of a face follow each other, in the order of the faces.
  void write(const std::string& path) const;

 private:
  using Corners = std::array<uint32_t, 3>;
  using Weights = std::array<uint32_t, 3>;
  struct FaceEdges {
    std::array<uint64_t, 3> first;  ///< vertex at one piece from the end that has the least index
    std::array<bool, 3> is_reversed;
  };

  void find_edges();
  void count_elements();
  void check_points();
  uint64_t first_of_edge(size_t edge) const { return mesh_.vertices.size() + edge * (n_ - 1); }
  uint64_t inside_count() const { return uint64_t{n_ - 1} * (n_ - 2) / 2; }
  FaceEdges edges_of(size_t face) const;
  /// Calls use(weights) for each new corner on an edge, or inside a face, in the file's order.
  template <class Use>
  void for_edge(const Use& use) const;
  template <class Use>
  void for_inside(const Use& use) const;
  std::array<Average, 3> point_of(const Corners& corners, const Weights& weights) const;
  Corners ends_of(size_t edge) const;
  uint32_t index_of(size_t face, const FaceEdges& edges, const Weights& weights) const;
  void write_children(std::vector<char>& rows, size_t face) const;
  struct Inexact {
    Weights weights{};
    size_t axis = 0;
    int bits = 0;  ///< that it takes
  };
  /// Elements are the edges, then the faces.
  std::optional<Inexact> first_inexact(size_t element, std::atomic<bool>& any_double) const;
  std::string place_of(size_t element) const;
  [[noreturn]] void refuse(const std::string& place, const Inexact& inexact) const;

  const Mesh& mesh_;
  uint32_t levels_, n_;
  std::vector<uint64_t> edges_;  ///< least end << 32 | other end, ascending
  PlyShape shape_;
};

}  // namespace vkh::pairs
