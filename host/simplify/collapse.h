// Collapses edges of a mesh by meshoptimizer, whose own errors are estimates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "vkhausdorff/mesh.h"

namespace vkh {

using Faces = std::vector<UVec3>;

/// The request to meshoptimizer: it ends at either.
struct CollapseTarget {
  double error = std::numeric_limits<double>::infinity();  ///< an estimate, in the mesh's unit
  size_t faces = 0;
};

/// The vertices of a mesh, each position once, for any number of collapses. Several threads may
/// use it at once.
class Collapser {
 public:
  /// `rounds`: positions are rounded to float32 first. `lock_borders`: see SimplifyOptions.
  Collapser(const Mesh& mesh, bool lock_borders, bool rounds);

  /// All faces of the mesh, by the vertices here.
  const Faces& faces() const { return faces_; }
  const std::vector<DVec3>& vertices() const { return vertices_; }

  /// Returns fewer of faces like `from`, with vertices of these; none of `locked` is moved or
  /// dropped. Faces with two equal corners are dropped. Throws UsageError in a build without
  /// meshoptimizer.
  Faces collapse(const Faces& from, const CollapseTarget& target,
                 std::span<const uint32_t> locked = {}) const;

  /// The mesh of the faces, which are not none.
  Mesh mesh_of(const Faces& faces) const;

 private:
  void weld(const Mesh& mesh, bool rounds);
  void place();

  std::vector<DVec3> vertices_;
  std::vector<float> places_;  ///< three for each vertex, within [-1, 1] of the middle
  Faces faces_;
  std::string name_, unit_;
  double extent_ = 0;  ///< length of a step of 1 in `places_`
  bool lock_borders_;
};

}  // namespace vkh
