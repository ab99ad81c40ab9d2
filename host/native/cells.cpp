#include "host/native/cells.h"

#include "host/base/rounding.h"
#include "host/mesh/round_to_float.h"
#include "host/native/cell_view.h"
#include "vkhausdorff/length.h"

namespace vkh::native {
namespace {

uint32_t nearest_place(const CellView& v, uint32_t start) {
  Nearest from;
  const auto last = static_cast<uint32_t>(v.tree.count() - 1);
  if (start != kNone) v.tree.try_triangle(v.cell.origin.hi, std::min(start, last), from);
  return v.tree.nearest(v.cell.origin.hi, from).place;
}

/// Examines the triangles that may be closest somewhere on a cell, and notes the ones that are not
/// beyond another.
class Gathering {
 public:
  Gathering(const CellView& v, uint32_t nearest)
      : v_(v), g_(begin_gathering(v.cell, v.surface(nearest), nearest)) {
    near_.count = 0;
    of_corners_.fill(g_.corners);
  }

  // Examines all of them, or some, and lets boxes stand for the rest.
  void look_around() {
    Walk walk(v_.tree, v_.cell.origin.hi);
    float reach = cell_reach(g_.highest, v_.cell);
    for (uint32_t looked_at = 0; looked_at < gpu::kCellTriangles;) {
      const Leaf leaf = walk.next(reach);
      if (leaf.is_none()) return;
      for (uint32_t i = leaf.begin; i < leaf.end; ++i) look_at(i);
      looked_at += leaf.end - leaf.begin;
      reach = std::min(reach, cell_reach(g_.highest, v_.cell));
    }
    const auto least = static_cast<double>(walk.least_left(reach));
    g_ = without(g_, v_.cell, box_distance_down(v_.cell.slack, least));
    near_ = {};
  }

  // Does what gathered() of cell.h does. That function neither returns whether it leaves S out, nor
  // S's distances, and it measures the first triangle again.
  void look_at(uint32_t triangle) {
    const Surface s = v_.surface(triangle);
    const Minorant m = minorant_of(g_, v_.cell, s);
    if (is_beyond(m.at_corners, g_.best)) return;
    near_.add(triangle);
    g_ = with_minorant(g_, m);
    if (triangle == g_.triangle || !may_be_nearer(g_, m)) return;
    const vec3 d = cell_distances(v_.cell, s);
    g_ = with_distances(g_, d, triangle);
    for (size_t k = 0; k < 3; ++k) {
      if (corner(k) == triangle) of_corners_[k] = d;
    }
  }

  // Adds the triangles nearest to the corners, two at a time, if they are not the same.
  void look_at_pairs() {
    for (size_t k = 0; k < 3; ++k) {
      const size_t i = k == 2 ? 1 : 0, j = k == 0 ? 1 : 2;
      if (corner(i) == corner(j) || (k == 2 && corner(1) == corner(0))) continue;
      g_ = cut_between(g_, v_.cell, v_.surface(corner(i)), of_corners_[i], v_.surface(corner(j)),
                       of_corners_[j]);
    }
  }

  const Gathered& found() const { return g_; }
  Nearby near() const {
    Nearby near = near_;
    near.at_corners = {corner(0), corner(1), corner(2)};
    return near;
  }

 private:
  // The triangle nearest to a corner.
  uint32_t corner(size_t k) const {
    return k == 0 ? g_.of_corners.x : k == 1 ? g_.of_corners.y : g_.of_corners.z;
  }

  const CellView& v_;
  Gathered g_;
  Nearby near_;
  std::array<vec3, 3> of_corners_;  // the distances of those triangles from all corners
};

Gathering gather(const CellView& v, uint32_t start) {
  Gathering gathering(v, nearest_place(v, start));
  gathering.look_around();
  return gathering;
}

// Some triangle of `near` is closest at each point of the cell.
Gathering gather_near(const CellView& v, const Nearby& near) {
  Nearest nearest;
  for (uint32_t k = 0; k < near.count; ++k)
    v.tree.try_triangle(v.cell.origin.hi, near.place[k], nearest);
  Gathering gathering(v, nearest.place);
  for (uint32_t k = 0; k < near.count; ++k) gathering.look_at(near.place[k]);
  return gathering;
}

// Rounded outward: an affine function of values that are not larger, at the corners, is nowhere
// larger.
gpu::CellBounds bounds_of(const Gathered& g, const CellView& v) {
  const vec3 lower = lower_of(g, v.cell);
  return {.lower_a = float_down(lower.x),
          .lower_b = float_down(lower.y),
          .lower_c = float_down(lower.z),
          .upper_a = float_up(g.upper.x),
          .upper_b = float_up(g.upper.y),
          .upper_c = float_up(g.upper.z),
          .highest = float_up(g.highest),
          .reached = float_down(reached_of(g)),
          .mean_upper = float_up(min(g.mean, g.highest)),
          .square_upper = float_up(g.square),
          .face_a = v.tree.face(g.of_corners.x),
          .face_b = v.tree.face(g.of_corners.y),
          .face_c = v.tree.face(g.of_corners.z),
          .face = v.tree.face(g.triangle),
          .triangle = g.triangle};
}

}  // namespace

PlacedPair::PlacedPair(const Mesh& a, const Mesh& b)
    : problem_(std::make_unique<const Problem>(a, b)) {}
PlacedPair::~PlacedPair() = default;

const Frame& PlacedPair::frame() const { return problem_->frame; }
double PlacedPair::displacement() const { return problem_->displacement; }
double PlacedPair::farthest() const {
  return farthest_in(problem_->joint, add_up(problem_->a.delta, problem_->b.delta));
}

gpu::Vertex PlacedPair::vertex_of_a(uint32_t number) const {
  const vec3& p = problem_->placed_a.at[number];
  const auto low = [](double x) {
    return nearest_float(x - static_cast<double>(nearest_float(x)));
  };
  return {{nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)},
          {low(p.x), low(p.y), low(p.z)}};
}

gpu::CellBounds PlacedPair::bounds(const gpu::Cell& cell, Nearby& near) const {
  const CellView view(*problem_, cell);
  Gathering gathering = near.is_known() ? gather_near(view, near) : gather(view, cell.start);
  gathering.look_at_pairs();
  near = gathering.near();
  return bounds_of(gathering.found(), view);
}

// Does what survey_split.comp does.
uint32_t PlacedPair::split(const gpu::Cell& cell, const gpu::CellBounds& bounds,
                           const Nearby& near) const {
  const CellView v(*problem_, cell);
  const Corners& t = v.cell.at;
  const float widest = std::max({bounds.upper_a - bounds.lower_a, bounds.upper_b - bounds.lower_b,
                                 bounds.upper_c - bounds.lower_c});
  if (widest < kLeastGain || bounds.triangle == kNone) return split_as_shaped(t);
  const std::array of{near.at_corners[0], near.at_corners[1], near.at_corners[2], bounds.triangle};
  const auto distances_of = [&](const Corners& at) {
    Distances d;
    for (size_t k = 0; k < 4; ++k) {
      const size_t same = static_cast<size_t>(std::find(of.begin(), of.end(), of[k]) - of.begin());
      d.from[k] = same < k ? d.from[same] : distances_from(v.surface(of[k]), at, v.cell);
    }
    return d;
  };
  const Distances corners = distances_of(t), middles = distances_of(middles_of(t));
  const uint32_t x = edge_to_halve(t, corners, middles);
  return split_from(x, t, corners, middles, distances_of(fresh_middles(t, x)));
}

}  // namespace vkh::native
