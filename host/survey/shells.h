// The inside of B: whether it has one, as proven by exact arithmetic, and on which side of B a
// point lies.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/mesh/orientation.h"
#include "host/mesh/triangle_tree.h"
#include "host/survey/stoppable.h"
#include "vkhausdorff/mesh.h"
#include "vkhausdorff/side.h"

namespace vkh {

/// Throws InputError that names the edge if two faces of the mesh use one in the same direction,
/// and no other faces use it.
void refuse_conflicts(const Mesh& mesh);

/// Triangles of a mesh. Its corners may be scaled by any power of two: no result depends on that.
class Shells {
 public:
  /// `faces` index into `vertices`, which are all finite. Where `goes_on` ends it, inside() is
  /// kUndecided.
  Shells(std::vector<glm::dvec3> vertices, const std::vector<UVec3>& faces,
         const GoesOn& goes_on = {});

  /// Counts edges, and does nothing else.
  static EdgeCounts edges_of(const Mesh& mesh);

  const EdgeCounts& edges() const { return edges_; }
  Inside inside() const { return inside_; }
  InsideOut inside_out() const { return inside_out_; }

  const Corners3& corners(uint32_t face) const { return triangles_[face]; }
  /// Whether the face is a segment or a point that no other face covers.
  bool is_bare(uint32_t face) const { return kind_[face] == Kind::kBare; }
  /// Whether the face is a segment or a point of other faces.
  bool is_covered(uint32_t face) const { return kind_[face] == Kind::kCovered; }
  /// Whether some face has the same corners in the opposite order.
  bool is_two_sided(uint32_t face) const { return is_two_sided_[face]; }
  /// All faces except segments and points that other faces cover. They have the same points as all
  /// faces.
  const TriangleTree& tree() const { return tree_; }

  /// The number of times that B winds round p, exactly; nothing if p lies on B, or if rays along
  /// all three axes pass through edges.
  std::optional<int> winding(const glm::dvec3& p) const;
  /// The winding number in front of every face, where inside() is kProven.
  int front() const { return front_; }

 private:
  struct OnlyEdges {};
  Shells(std::vector<glm::dvec3> vertices, const std::vector<UVec3>& faces, OnlyEdges only);

  enum class Kind : uint8_t { kArea, kCovered, kBare };
  struct EdgeUse;

  void set_positions();
  void set_kinds();
  void cover();
  void mark_two_sided();
  std::vector<EdgeUse> edge_uses() const;
  void count_edges(const std::vector<EdgeUse>& uses);
  std::vector<uint32_t> in_tree() const;
  Inside find_inside(const std::vector<EdgeUse>& uses, const GoesOn& goes_on);
  std::optional<bool> find_contacts(const GoesOn& goes_on);
  std::vector<uint32_t> patches(const std::vector<EdgeUse>& uses) const;
  Inside wind(const std::vector<EdgeUse>& uses, const GoesOn& goes_on);
  bool has_negative_volume() const;
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
  InsideOut inside_out_ = InsideOut::kNone;
  int front_ = 0;  // the winding number in front of every face, where inside_ is kProven
};

}  // namespace vkh
