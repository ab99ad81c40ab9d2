// A mesh moved so that every coordinate stays exact: signs and order of axes, a power of two, a
// shift. The distance of a pair that is moved so is the old one times the power of two.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "vkhausdorff/mesh.h"

namespace vkh::pairs {

struct Move {
  std::array<int, 3> axes{0, 1, 2};  ///< coordinate i comes from coordinate axes[i]
  std::array<double, 3> signs{1, 1, 1};
  int exponent = 0;    ///< of the power of two
  glm::dvec3 shift{};  ///< added last
};

/// Depends on `number` alone; one in four has a shift by multiples of `size`, a power of two.
Move draw_move(uint64_t number, double size);

/// Returns false if a coordinate would not be exact in double: the mesh is then of no use.
bool move_exactly(Mesh& mesh, const Move& move);

/// Whether every coordinate is a float.
bool is_float(const Mesh& mesh);

/// Binary PLY, read back as the same mesh.
void write_ply(const Mesh& mesh, const std::string& path);

}  // namespace vkh::pairs
