#include "host/mesh/exact_sum.h"
#include "host/mesh/make_mesh.h"

namespace vkh {

// The cross product of two edges is zero if and only if the triangle's three projections along the
// axes are collinear. One projection that is surely not collinear decides: a face in a plane of the
// axes has two collinear ones, which would cost exact sums. Equal corners come last, since few
// faces have them: their projections never surely turn.
bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto along = [&](int i, int j, const auto& turn) {
    return turn(Point2{a[i], a[j]}, Point2{b[i], b[j]}, Point2{c[i], c[j]});
  };
  if (along(0, 1, sure_turn) != 0 || along(1, 2, sure_turn) != 0 || along(2, 0, sure_turn) != 0)
    return false;
  if (a == b || b == c || c == a) return true;
  return along(0, 1, exact_turn) == 0 && along(1, 2, exact_turn) == 0 &&
         along(2, 0, exact_turn) == 0;
}

}  // namespace vkh
