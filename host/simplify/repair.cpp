// Goes on from the best candidate: faces that a coarser one breaks are locked, and the rest is
// simplified.
#include <algorithm>

#include "host/simplify/search.h"

namespace vkh {
namespace {

// Rounds of locks at one error. Each locks what is a little nearer to the limit, too: otherwise
// the last places break one by one, and a round costs as much for each.
constexpr int kLockRounds = 8;
constexpr double kStepOfShare = 0.03;
constexpr int kMostErrors = 12;
constexpr double kWorthwhile = 0.99;  // a repair that keeps more of the faces was the last there

DVec3 middle_of(const DVec3& p, const DVec3& q) { return 0.5 * p + 0.5 * q; }

// Adds four points of a face that are no corners: the middles of its edges, and its own.
void add_inner_points(const Mesh& mesh, const UVec3& face, std::vector<DVec3>& points) {
  const DVec3 &a = mesh.vertices[face.x], &b = mesh.vertices[face.y], &c = mesh.vertices[face.z];
  const DVec3 middle = middle_of(a, b);
  points.insert(points.end(), {middle, middle_of(b, c), middle_of(c, a),
                               middle_of(c, middle) * (2.0 / 3) + middle * (1.0 / 3)});
}

}  // namespace

std::vector<DVec3> Search::broken_places(const Mesh& broken, double share) {
  std::vector<DVec3> places;
  for (const Report* r : {&why_.a_to_b, why_.b_to_a ? &*why_.b_to_a : nullptr})
    if (r != nullptr && r->has_witness && r->lower > 0) places.push_back(r->witness_a.point);
  const auto add = [&places](const std::vector<DVec3>& found) {
    places.insert(places.end(), found.begin(), found.end());
  };
  add(judge_.beyond(judge_.solver().prepare(broken), judge_.a().mesh().vertices, share));
  if (options_.one_way) return places;
  std::vector<DVec3> points;
  for (const UVec3& face : broken.faces) add_inner_points(broken, face, points);
  add(judge_.beyond(judge_.a(), points, share));
  return places;
}

void Search::lock_around(const PreparedMesh& best, std::span<const DVec3> places,
                         std::vector<char>& is_locked) {
  const ClosestPoints closest =
      judge_.solver().closest(best, places, [this](size_t) { return goes_on(); });
  std::vector<char> is_near(is_locked.size());
  for (const uint32_t f : closest.faces)
    for (const uint32_t v : {best_[f].x, best_[f].y, best_[f].z}) is_near[v] = 1;
  for (const UVec3& face : best_) {
    if (!is_near[face.x] && !is_near[face.y] && !is_near[face.z]) continue;
    for (const uint32_t v : {face.x, face.y, face.z}) is_locked[v] = 1;
  }
}

bool Search::add_locks(const Mesh& broken, const PreparedMesh& best, double share,
                       std::vector<uint32_t>& locked) {
  std::vector<char> is_locked(collapser_.vertices().size());
  for (const uint32_t v : locked) is_locked[v] = 1;
  const size_t before = locked.size();
  lock_around(best, broken_places(broken, share), is_locked);
  locked.clear();
  for (uint32_t v = 0; v < is_locked.size(); ++v)
    if (is_locked[v]) locked.push_back(v);
  return locked.size() > before;
}

bool Search::repair_by(double error) {
  const PreparedMesh best = judge_.solver().prepare(collapser_.mesh_of(best_));
  std::vector<uint32_t> locked;
  for (int round = 0; round < kLockRounds && goes_on(); ++round) {
    const Faces next = collapser_.collapse(best_, {.error = error}, locked);
    const Outcome outcome = attempt(next);
    if (outcome == Outcome::kPassed) return true;
    if (outcome == Outcome::kUseless || next.empty() || !goes_on()) return false;
    const double share = 1 - kStepOfShare * round;
    if (!add_locks(collapser_.mesh_of(next), best, share, locked)) return false;
  }
  return false;
}

void Search::repair() {
  if (!has_best()) return;
  const double limit = options_.max.within;
  const double smallest = best_error_ > 0 ? best_error_ : limit / 64;
  double error = std::max(failed_error_, limit / 2);
  for (int i = 0; i < kMostErrors && goes_on() && error >= smallest; ++i) {
    const auto before = static_cast<double>(best_.size());
    const bool passed = repair_by(error);
    if (!passed || static_cast<double>(best_.size()) > kWorthwhile * before) error /= 2;
  }
}

}  // namespace vkh
