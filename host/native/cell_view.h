// A cell of A, and B around its centre.
#pragma once

#include "host/native/cell.h"
#include "host/native/problem.h"
#include "shaders/gpu_types.h"

namespace vkh::native {

struct CellView {
  /// The problem outlives it.
  CellView(const Problem& problem, const gpu::Cell& of)
      : tree(problem.tree), cell(frame_of_cell(problem, of)), view(cell_view(cell)) {}

  const FaceTree& tree;
  CellFrame cell;
  View view;

  Surface surface(uint32_t place) const {
    const Corners& t = tree.triangle(place);
    return make_surface(two(t.a), two(t.b), two(t.c), view);
  }

 private:
  static CellFrame frame_of_cell(const Problem& problem, const gpu::Cell& of) {
    const UVec3& f = problem.a.faces[of.face];
    const std::vector<vec3>& at = problem.placed_a.at;
    const Root root = make_root(two(at[f.x]), two(at[f.y]), two(at[f.z]));
    return make_cell(root,
                     unpack_corners({of.corners.x, of.corners.y, of.corners.z, of.corners.w}));
  }
};

}  // namespace vkh::native
