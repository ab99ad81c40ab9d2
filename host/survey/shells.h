// The inside of B: whether it has one, as proven by exact arithmetic, and on which side of B a
// point lies.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/mesh/mesh.h"
#include "host/mesh/orientation.h"
#include "host/mesh/triangle_tree.h"

namespace vkh {

/// The side of B, as its faces are oriented: over is in front of them.
enum class Side : int8_t { kUnder = -1, kUnsigned = 0, kOver = 1 };

/// Whether B has an inside, or the first reason why it has none.
enum class Inside {
  kProven,     ///< closed, no two faces cross, and it winds round each point once or not at all
  kOpen,       ///< an edge has not as many faces on both sides
  kCrossing,   ///< two faces cross, or lie on each other
  kWinding,    ///< it winds round some point otherwise: shells in each other, or of both kinds
  kUndecided,  ///< no point was found beside some part of it at which that could be counted
};
const char* inside_name(Inside inside);  ///< "proven", "open", "crossing", "winding", "undecided"

/// An edge, and two faces that both use it in one direction, as no orientation would have them.
struct EdgeConflict {
  std::array<uint32_t, 2> vertices{}, faces{};
};

/// The number of edges that are no closed, oriented surface's.
struct EdgeCounts {
  uint64_t open = 0;       ///< edges with more faces in one direction than in the other
  uint64_t uneven = 0;     ///< open edges of three faces or more
  uint64_t conflicts = 0;  ///< edges of two faces, both in one direction
  std::optional<EdgeConflict> first = {};  ///< the first conflict
};

/// Triangles of a mesh, by corners that any power of two may scale: no statement here depends on
/// it.
class Shells {
 public:
  /// `faces` index into `vertices`, which are all finite.
  Shells(std::vector<glm::dvec3> vertices, const std::vector<UVec3>& faces);

  const EdgeCounts& edges() const { return edges_; }
  Inside inside() const { return inside_; }
  /// The two faces of the first crossing, where inside() is kCrossing.
  std::array<uint32_t, 2> crossing() const { return crossing_; }

  const Corners3& corners(uint32_t face) const { return triangles_[face]; }
  /// Whether the face is a segment or a point that no other face covers.
  bool is_bare(uint32_t face) const { return kind_[face] == Kind::kBare; }
  /// Whether some face has the same corners in the opposite order.
  bool is_two_sided(uint32_t face) const { return is_two_sided_[face]; }
  /// All faces but those segments and points that other faces cover: the same points.
  const TriangleTree& tree() const { return tree_; }

  /// The number of times that B winds round p, exactly; nothing where p lies on B, or where rays
  /// along all three axes pass through edges.
  std::optional<int> winding(const glm::dvec3& p) const;
  /// The side of a point that is not on B, where inside() is kProven: nothing as for winding().
  std::optional<Side> side_of(const glm::dvec3& p) const;

 private:
  enum class Kind : uint8_t { kArea, kCovered, kBare };
  struct EdgeUse;

  void set_positions();
  void set_kinds();
  void cover();
  void mark_two_sided();
  std::vector<EdgeUse> edge_uses() const;
  void count_edges(const std::vector<EdgeUse>& uses);
  std::vector<uint32_t> with_area() const;
  std::vector<uint32_t> in_tree() const;
  bool find_contacts();
  std::vector<uint32_t> patches(const std::vector<EdgeUse>& uses) const;
  Inside wind(const std::vector<EdgeUse>& uses);
  std::optional<int> front_winding(uint32_t face) const;
  std::optional<int> winding_beside(uint32_t face, int attempt) const;
  std::optional<int> winding_along(int axis, const glm::dvec3& p) const;
  int shared_corners(uint32_t f, uint32_t g) const;

  std::vector<glm::dvec3> vertices_;
  const std::vector<UVec3>& faces_;
  std::vector<UVec3> positions_;  // the faces' corners, each by the first vertex at its position
  std::vector<Corners3> triangles_;
  std::vector<Kind> kind_;
  std::vector<bool> is_two_sided_;
  std::vector<uint8_t>
      touches_;  // whether another face touches it elsewhere than at shared corners
  EdgeCounts edges_;
  TriangleTree tree_;
  Inside inside_ = Inside::kUndecided;
  std::array<uint32_t, 2> crossing_{};
  int front_ = 0;  // the winding number in front of every face, where inside_ is kProven
};

}  // namespace vkh
