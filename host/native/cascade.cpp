#include "host/native/cascade.h"

namespace vkh::native {
namespace {

bool has_corner(const Corners& t, const vec3& p) {
  const auto is = [&p](const vec3& q) { return p.x == q.x && p.y == q.y && p.z == q.z; };
  return is(t.a) || is(t.b) || is(t.c);
}

}  // namespace

Family::Family(const Problem& problem, const Face& face, uint32_t centre)
    : problem_(problem), face_(face) {
  if (centre != kNone) add_known(centre);
}

void Family::add_point(const uvec2& at, uint32_t nearest) {
  point_[points_] = two(local_corner(face_, at));
  known_of_[points_++] = static_cast<uint32_t>(add_known(nearest));
}

size_t Family::add_known(uint32_t place) {
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

// Whether the point lies above the nearer of two surfaces and beside the other.
bool Family::is_beside(size_t i, size_t j, uint32_t point) const {
  const Known &s = known_[i], &r = known_[j];
  const bool in_s = (s.inside >> point & 1u) != 0, in_r = (r.inside >> point & 1u) != 0;
  return s.distance[point] <= r.distance[point] ? in_s && !in_r : in_r && !in_s;
}

// How far corners are from the cut of u3: like from_cut of shaders/math/bounds.h, which has the
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

// u3 of two triangles. A pair that cannot close the child is left out: it cannot beat the better of
// its two distances at the worst corner.
void Family::narrow_by_pair(size_t i, size_t j, const Trial& trial, Verdict& v) {
  const vec3 di = distances(i, trial.child), dj = distances(j, trial.child);
  const double at_best = bound_nearer(di, dj);
  if (kept_bound(at_best, face_.slack) > trial.threshold) return;
  const Cut cut = cut_by(di - dj);
  if (cut.none) return;
  const double at_cut =
      bound_cut(trial.t, cut, sides(i, j, trial.child), known_[i].surface, known_[j].surface);
  narrow(max(at_best, at_cut), kByU3, v);
}

void Family::narrow(double bound, Close by, Verdict& v) const {
  const double kept = kept_bound(bound, face_.slack);
  if (kept < v.upper) v = {kept, by, v.centre};
}

// Adds the bounds of the triangle at a place of the order: alone, and with each one before it.
void Family::narrow_by(size_t n, Trial& trial, Verdict& v) {
  const size_t k = order_[n];
  const vec3 d = distances(k, trial.child);
  trial.own = min(trial.own, d);
  if (bound_single(d) < trial.ha) {
    trial.ha = bound_single(d);
    trial.best = k;
    narrow(trial.ha, n == 0 ? kByExact : kByHa, v);
  }
  for (size_t m = 0; m < n && v.upper > trial.threshold; ++m)
    narrow_by_pair(k, order_[m], trial, v);
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
  const size_t own_count = put_own_first(child);
  Trial trial{child, patch(child), threshold};
  Verdict v{upper, kByRisen, kNone};
  for (size_t n = 0; n < count_; ++n) {
    narrow_by(n, trial, v);
    if (n + 1 == own_count) {
      narrow(bound_u1(trial.t, trial.own), kByU1, v);
      narrow(bound_u2(trial.t, trial.own), kByU2, v);
    }
    if (v.upper <= threshold) return v;
  }
  v.centre = ask_centre(child, trial.best, gain);
  const size_t shared = count_;
  if (add_known(v.centre) == shared) {
    order_[shared] = shared;
    narrow_by(shared, trial, v);
  }
  count_ = shared;  // the next child does not know this one's own
  return v;
}

// A child's own triangles come first, since most children need no more. Returns how many they are.
size_t Family::put_own_first(const Child& child) {
  size_t own_count = 0;
  for (size_t k = 0; k < count_; ++k) order_[k] = k;
  for (const uint32_t i : child.corner) {
    const auto mine = std::find(order_.begin(), order_.begin() + count_, known_of_[i]);
    const auto place = static_cast<size_t>(mine - order_.begin());
    if (place >= own_count) std::swap(order_[own_count++], order_[place]);
  }
  return own_count;
}

bool Family::is_shared(const UVec3& face_of_a, Gain& gain) const {
  const std::vector<vec3>& at = problem_.placed_a.at;
  const Child whole{whole_face(), {0, 1, 2}};
  const Corners& t = problem_.tree.triangle(ask_centre(whole, known_of_[0], gain));
  return has_corner(t, at[face_of_a.x]) && has_corner(t, at[face_of_a.y]) &&
         has_corner(t, at[face_of_a.z]);
}

}  // namespace vkh::native
