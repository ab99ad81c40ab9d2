// The corners of a cell, as its device's words hold them.
#pragma once

#include "host/solve/cells.h"
#include "shaders/math/dyadic.h"

namespace vkh {

inline lib::Bary3 corners_of(const gpu::Cell& cell) {
  const gpu::uvec4& w = cell.corners;
  return lib::unpack_corners({w.x, w.y, w.z, w.w});
}

inline void set_corners(gpu::Cell& cell, const lib::Bary3& corners) {
  const glm::uvec4 w = lib::pack_corners(corners);
  cell.corners = {w.x, w.y, w.z, w.w};
}

}  // namespace vkh
