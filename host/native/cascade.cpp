#include "host/native/cascade.h"

namespace vkh::native {
namespace {

constexpr double kUnbounded = 1e30;

bool has_corner(const Corners& t, const vec3& p) {
  const auto is = [&p](const vec3& q) { return p.x == q.x && p.y == q.y && p.z == q.z; };
  return is(t.a) || is(t.b) || is(t.c);
}

}  // namespace

Family::Family(const Problem& problem, const Face& face, uint32_t centre)
    : problem_(problem), face_(face) {
  if (centre != kNone) know(centre);
}

void Family::add_point(const uvec2& at, uint32_t nearest) {
  point_[points_] = two(local_corner(face_, at));
  known_of_[points_++] = static_cast<uint32_t>(know(nearest));
}

size_t Family::know(uint32_t place) {
  for (size_t k = 0; k < count_; ++k) {
    if (known_[k].place == place) return k;
  }
  Known& fresh = known_[count_];
  fresh.place = place;
  fresh.is_made = false;
  fresh.measured = fresh.inside = 0;
  return count_++;
}

// Measures the child's corners, unless a sibling did.
Family::Known& Family::measure(size_t k, const Child& child) {
  Known& known = known_[k];
  if (!known.is_made) {
    const Corners& t = problem_.tree.triangle(known.place);
    known.surface = make_surface(two(t.a), two(t.b), two(t.c), view_around(two(face_.a)));
    known.is_made = true;
  }
  for (const uint32_t i : child.corner) {
    const uint32_t bit = 1u << i;
    if ((known.measured & bit) != 0) continue;
    bool inside = false;
    known.distance[i] = surface_distance_up(point_[i], known.surface, inside);
    known.measured |= bit;
    if (inside) known.inside |= bit;
  }
  return known;
}

vec3 Family::distances(size_t k, const Child& child) {
  const Known& known = measure(k, child);
  return {known.distance[child.corner[0]], known.distance[child.corner[1]],
          known.distance[child.corner[2]]};
}

Patch Family::patch(const Child& child) const {
  return make_patch(point_[child.corner[0]], point_[child.corner[1]], point_[child.corner[2]]);
}

// The bounds from single triangles: of its own corners first, since most children need no more.
void Family::narrow_by_single(const Child& child, const Patch& t, size_t own_count,
                              double threshold, Verdict& v, size_t& best) {
  vec3 own(kUnbounded, kUnbounded, kUnbounded);
  double ha = kUnbounded;
  const auto narrow = [&](double bound, Close by) {
    const double kept = kept_bound(bound, face_.slack);
    if (kept < v.upper) v = {kept, by, v.centre};
  };
  for (size_t n = 0; n < count_; ++n) {
    const vec3 d = distances(order_[n], child);
    own = min(own, d);
    if (bound_single(d) < ha) {
      ha = bound_single(d);
      best = order_[n];
    }
    narrow(ha, own_count == 1 ? kByExact : kByHa);
    if (n + 1 != own_count && n + 1 != count_) continue;
    narrow(bound_u1(t, own), kByU1);
    narrow(bound_u2(t, own), kByU2);
    if (v.upper <= threshold) return;
  }
}

// Whether the point lies above the nearer of two surfaces and beside the other.
bool Family::is_beside(size_t i, size_t j, uint32_t point) const {
  const Known &s = known_[i], &r = known_[j];
  const bool in_s = (s.inside >> point & 1u) != 0, in_r = (r.inside >> point & 1u) != 0;
  return s.distance[point] <= r.distance[point] ? in_s && !in_r : in_r && !in_s;
}

// How far corners are from the cut of u3: as from_cut of shaders/math/bounds.h, which has the
// reason, with flags in place of the last bits of floats. It steers.
vec3 Family::sides(size_t i, size_t j, const Child& child) const {
  std::array<double, 3> difference, between;
  bool beside = false;
  for (size_t n = 0; n < 3; ++n) {
    const uint32_t point = child.corner[n];
    const double ds = known_[i].distance[point], dr = known_[j].distance[point];
    difference[n] = ds - dr;
    between[n] = root_between(ds, dr, 0.0);
    beside = beside || is_beside(i, j, point);
  }
  const std::array<double, 3>& side = beside ? between : difference;
  return {side[0], side[1], side[2]};
}

// u3, for pairs that may close the child: a pair cannot beat the better of its two distances at the
// worst corner.
void Family::narrow_by_pairs(const Child& child, const Patch& t, double threshold, Verdict& v) {
  for (size_t i = 1; i < count_; ++i) {
    const vec3 di = distances(i, child);
    for (size_t j = 0; j < i; ++j) {
      const vec3 dj = distances(j, child);
      const double at_best = bound_nearer(di, dj);
      if (kept_bound(at_best, face_.slack) >= v.upper) continue;
      const Cut cut = cut_by(di - dj);
      if (cut.none) continue;
      const double at_cut =
          bound_cut(t, cut, sides(i, j, child), known_[i].surface, known_[j].surface);
      const double u3 = kept_bound(max(at_best, at_cut), face_.slack);
      if (u3 < v.upper) v = {u3, kByU3, v.centre};
      if (v.upper <= threshold) return;
    }
  }
}

uint32_t Family::ask_centre(const Child& child, size_t best, Gain& gain) const {
  const vec3 p = near_position(face_, centroid_of(child.at));
  Nearest start;
  problem_.tree.try_triangle(p, known_[best].place, start);
  ++gain.queries;
  return problem_.tree.nearest(p, start).place;
}

Verdict Family::bound(const Child& child, double upper, double threshold, Gain& gain) {
  ++gain.candidates;
  const Patch t = patch(child);
  size_t own_count = 0;
  for (size_t k = 0; k < count_; ++k) order_[k] = k;
  for (const uint32_t i : child.corner) {
    const auto mine = std::find(order_.begin(), order_.begin() + count_, known_of_[i]);
    const auto place = static_cast<size_t>(mine - order_.begin());
    if (place >= own_count) std::swap(order_[own_count++], order_[place]);
  }
  Verdict v{upper, kByRisen, kNone};
  size_t best = order_[0];
  narrow_by_single(child, t, own_count, threshold, v, best);
  if (v.upper <= threshold) return v;
  v.centre = ask_centre(child, best, gain);
  const size_t shared = count_;
  if (know(v.centre) == shared) {
    order_[shared] = shared;
    narrow_by_single(child, t, 0, threshold, v, best);
  }
  if (v.upper > threshold) narrow_by_pairs(child, t, threshold, v);
  count_ = shared;  // the next child does not know this one's own
  return v;
}

bool Family::is_shared(const UVec3& face_of_a, Gain& gain) const {
  const std::vector<vec3>& at = problem_.placed_a.at;
  const Child whole{whole_face(), {0, 1, 2}};
  const Corners& t = problem_.tree.triangle(ask_centre(whole, known_of_[0], gain));
  return has_corner(t, at[face_of_a.x]) && has_corner(t, at[face_of_a.y]) &&
         has_corner(t, at[face_of_a.z]);
}

}  // namespace vkh::native
