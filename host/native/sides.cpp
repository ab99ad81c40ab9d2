// The side of B on which a cell lies: the functions of shaders/report/side.h in doubles, through
// the boxes of native's tree.
#include <algorithm>

#include "host/native/cell_view.h"
#include "host/native/cells.h"

namespace vkh::native {
namespace {

// A lower bound of the distances of all points of the cell.
double lowest_of(const gpu::CellBounds& b) {
  return std::max(static_cast<double>(std::min({b.lower_a, b.lower_b, b.lower_c})), 0.0);
}

class SideOfCell {
 public:
  SideOfCell(const CellView& v, const gpu::SurveySidesPush& search,
             std::span<const uint32_t> face_kinds)
      : v_(v),
        search_(search),
        face_kinds_(face_kinds),
        moved_(static_cast<double>(search.moved)) {}

  // The class by counting along rays on the three axes; kClassUnseen: each ray meets an edge of B,
  // or starts where the cell may touch it.
  uint32_t by_winding(const vec3& lower, bool is_off) const {
    for (uint32_t axis = 0; axis < 3; ++axis) {
      if (!is_off && !is_off_inside(lower, axis, moved_)) continue;
      int winding = 0;
      const auto look = [&](uint32_t place) {
        const Crossing c = crossing_along(v_.cell, v_.surface(place), axis);
        winding += c.winding;
        return c.is_sure;
      };
      if (v_.tree.each_in(RayBoxes(v_.cell, axis), look))
        return winding == search_.front ? gpu::kClassOver : gpu::kClassUnder;
    }
    return gpu::kClassUnseen;
  }

  uint32_t by_planes(const gpu::CellBounds& b, bool is_off) const {
    const Above above{{b.upper_a, b.upper_b, b.upper_c}, b.highest};
    uint32_t found = gpu::kClassUnseen, count = 0;
    Walk walk(v_.tree, v_.cell.origin.hi);
    const float reach = cell_reach(static_cast<double>(b.highest) + 2 * moved_, v_.cell);
    for (Leaf leaf = walk.next(reach); !leaf.is_none(); leaf = walk.next(reach)) {
      for (uint32_t place = leaf.begin; place < leaf.end; ++place) {
        const uint32_t kind = face_kinds_[v_.tree.face(place)];
        const Surface s = v_.surface(place);
        if ((kind & gpu::kFaceCovered) != 0 || !may_be_closest(v_.cell, s, above, moved_)) continue;
        if (++count > gpu::kCellTriangles) return gpu::kClassMany;
        found = class_with(found, kind, side_of_cell(v_.cell, s, moved_));
        if (!has_side(found)) return found == gpu::kClassEdge && !is_off ? gpu::kClassMeets : found;
      }
    }
    return found;
  }

 private:
  // Whether a ray from the cell may meet a triangle in a box: a box of floats is exact in doubles,
  // and the point is off by a few roundings.
  struct RayBoxes {
    RayBoxes(const CellFrame& t, uint32_t along)
        : axis(along),
          p(t.origin.hi + inner_point(t, along)),
          margin(8 * kUlp * (t.reach + t.radius)) {}

    bool operator()(const FaceTree::Box& box) const {
      for (uint32_t i = 0; i < 3; ++i) {
        const double at = i == 0 ? p.x : i == 1 ? p.y : p.z;
        if (static_cast<double>(box.hi[i]) < at - margin) return false;
        if (i != axis && static_cast<double>(box.lo[i]) > at + margin) return false;
      }
      return true;
    }

    const uint32_t axis;
    const vec3 p;
    const double margin;
  };

  const CellView& v_;
  const gpu::SurveySidesPush& search_;
  const std::span<const uint32_t> face_kinds_;
  const double moved_;
};

}  // namespace

uint32_t PlacedPair::side_class(const gpu::Cell& cell, const gpu::CellBounds& bounds,
                                const gpu::SurveySidesPush& search,
                                std::span<const uint32_t> face_kinds) const {
  const CellView view(*problem_, cell);
  const SideOfCell side(view, search, face_kinds);
  const auto moved = static_cast<double>(search.moved);
  const vec3 lower(bounds.lower_a, bounds.lower_b, bounds.lower_c);
  const vec3 upper(bounds.upper_a, bounds.upper_b, bounds.upper_c);
  const bool off = is_off(lowest_of(bounds), moved);
  const bool has_one =
      off || is_off_but_near(lower, upper, moved, static_cast<double>(search.near));
  const uint32_t found =
      search.is_solid != 0 && has_one ? side.by_winding(lower, off) : gpu::kClassUnseen;
  return found != gpu::kClassUnseen ? found : side.by_planes(bounds, off);
}

}  // namespace vkh::native
