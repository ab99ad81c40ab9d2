// Collapses edges of a mesh by meshoptimizer, whose own errors are estimates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "host/base/thread_pool.h"
#include "host/simplify/blocks.h"
#include "vkhausdorff/mesh.h"

namespace vkh {

/// The request to meshoptimizer: it ends at either.
struct CollapseTarget {
  double error = std::numeric_limits<double>::infinity();  ///< an estimate, in the mesh's unit
  size_t faces = 0;
  bool by_blocks = true;  ///< false: as one mesh, even if that takes long
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
  /// dropped. Faces with two equal corners are dropped. Large meshes and small errors go by blocks,
  /// on several threads; the faces are the same on any number. Throws UsageError in a build without
  /// meshoptimizer.
  Faces collapse(const Faces& from, const CollapseTarget& target,
                 std::span<const uint32_t> locked = {},
                 const ThreadPool& pool = ThreadPool()) const;

  /// The mesh of the faces, which are not none.
  Mesh mesh_of(const Faces& faces) const;

 private:
  void weld(const Mesh& mesh, bool rounds);
  void measure();
  Faces collapse_blocks(const Faces& from, const Grid& grid, double error,
                        std::vector<char> is_locked, const ThreadPool& pool) const;
  Faces collapse_block(std::span<const UVec3> from, const CollapseTarget& target,
                       const std::vector<char>& is_locked) const;

  std::vector<DVec3> vertices_;
  Faces faces_;
  std::string name_, unit_;
  DVec3 corner_;     ///< the lowest of the box
  double half_ = 0;  ///< of the box's longest side
  bool lock_borders_;
};

}  // namespace vkh
