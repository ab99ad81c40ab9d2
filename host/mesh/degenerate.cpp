#include <algorithm>
#include <array>

#include "host/mesh/exact_sum.h"
#include "host/mesh/make_mesh.h"

namespace vkh {

// The cross product of two edges is zero if and only if the triangle's three projections along the
// axes are collinear. One projection that is surely not collinear decides: a face in a plane of the
// axes has two collinear ones, which would cost exact sums.
bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  if (a == b || b == c || c == a) return true;
  const std::array<std::array<Point2, 3>, 3> projections = {
      {{{{a.x, a.y}, {b.x, b.y}, {c.x, c.y}}},
       {{{a.y, a.z}, {b.y, b.z}, {c.y, c.z}}},
       {{{a.z, a.x}, {b.z, b.x}, {c.z, c.x}}}}};
  const auto surely_not = [](const auto& p) { return sure_turn(p[0], p[1], p[2]) != 0; };
  const auto exactly = [](const auto& p) { return exact_turn(p[0], p[1], p[2]) == 0; };
  return std::none_of(projections.begin(), projections.end(), surely_not) &&
         std::all_of(projections.begin(), projections.end(), exactly);
}

}  // namespace vkh
