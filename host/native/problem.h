// A pair as it is solved: both meshes in a frame, the faces of A around their first corners, and
// the tree of B.
#pragma once

#include <vector>

#include "host/native/face_tree.h"
#include "host/native/place.h"
#include "vkhausdorff/frame.h"

namespace vkh::native {

/// A mesh's vertices in a frame, and how far the farthest may be from its exact place there.
struct PlacedVertices {
  std::vector<vec3> at;
  double displacement = 0;
};
PlacedVertices placed_vertices(const Frame& frame, const Mesh& mesh);

/// A power of two that brings the joint box to [1/2, 1); around the origin, or, where the box is
/// far from it for its size, around the box's middle.
Frame frame_of(const Box& joint);

struct Problem {
  Problem(const Mesh& a_, const Mesh& b_);

  const Mesh& a;
  const Mesh& b;
  Box box_a, joint;
  Frame frame;
  PlacedVertices placed_a, placed_b;
  double displacement;  ///< of both
  FaceTree tree;

  Face face_of_a(uint32_t f) const {
    const UVec3& v = a.faces[f];
    return make_face(placed_a.at[v.x], placed_a.at[v.y], placed_a.at[v.z]);
  }
};

}  // namespace vkh::native
