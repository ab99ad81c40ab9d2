#include "host/survey/leaf.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "host/base/rounding.h"
#include "host/mesh/face_point.h"

namespace vkh {
namespace {

constexpr double kUlp = 0x1p-52;
// Low parts lose so much of a point's largest coordinate and of the largest seen from it: each
// component of the point is off by 2^-98 for each of a hundred halvings, so by 2^-91.3, and of an
// offset by twelve roundings of under 2^-103. The root of three times their square is under 2^-90.
constexpr double kOff = 0x1p-90;

struct TwoDoubles {
  double hi, lo;
};

TwoDoubles sum(double a, double b) { return {a + b, sum_error(a, b)}; }

// Low parts alone are rounded, here and in x + t d for t in [0, 1]: they are under 2^-51 of the
// largest number, so that each rounding is under 2^-104 of it.
TwoDoubles difference(TwoDoubles x, TwoDoubles y) {
  const TwoDoubles d = sum(x.hi, -y.hi);
  return {d.hi, d.lo + (x.lo - y.lo)};
}

TwoDoubles moved(TwoDoubles x, double t, TwoDoubles d) {
  const double step = t * d.hi;
  const double step_lo = std::fma(t, d.hi, -step) + t * d.lo;
  const TwoDoubles s = sum(x.hi, step);
  return sum(s.hi, s.lo + (x.lo + step_lo));
}

// x + t (y - x).
TwoDoubles between(TwoDoubles x, TwoDoubles y, double t) { return moved(x, t, difference(y, x)); }

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// From p to a point of t, each component rounded once, besides roundings of low parts.
glm::dvec3 offset(const Point2& p, const std::array<glm::dvec3, 3>& t, const FaceWeights& at) {
  const auto component = [&](int i) {
    const auto corner = [&](size_t of) { return difference({t[of][i], 0}, {p.hi[i], p.lo[i]}); };
    const TwoDoubles base = corner(at.base);
    const TwoDoubles along = moved(base, at.v, difference(corner(at.end), base));
    return moved(along, at.w, difference(corner(at.third), base)).hi;
  };
  return {component(0), component(1), component(2)};
}

bool is_zero(const glm::dvec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

// Distances of a part's corners from one face.
struct Row {
  uint32_t face;
  std::array<glm::dvec3, 3> corners;
  std::array<double, 3> distance;
  double most() const { return std::max({distance[0], distance[1], distance[2]}); }
};

using Rows = std::vector<Row>;

Row row_of(const Part& part, const ScaledMesh& b, uint32_t face) {
  Row row{.face = face, .corners = b.corners(face), .distance = {}};
  for (size_t i = 0; i < 3; ++i) row.distance[i] = distance_up(part[i], row.corners);
  return row;
}

constexpr int kCutUnits = 1 << 16;

// A cut between two faces on the edge from `from` to `to`.
class Cutting {
 public:
  Cutting(const Part& part, const Row& near, const Row& far, double upper)
      : part_(part), near_(near), far_(far), upper_(upper) {}

  // The place on the edge where both are within reach: `near` is from the start of the edge to some
  // place, `far` from some place to the end, for both distances are convex.
  std::optional<uint16_t> on(size_t from, size_t to) const {
    const double falls = near_.distance[to] - far_.distance[to];
    const double rises = far_.distance[from] - near_.distance[from];
    const double guess = rises + falls > 0 ? rises / (rises + falls) : 0.5;
    int low = 0, high = kCutUnits;
    int at = static_cast<int>(std::clamp(kCutUnits * guess, 1.0, kCutUnits - 1.0));
    while (low + 1 < high) {
      const Point2 p = between(part_[from], part_[to], at / double{kCutUnits});
      const bool near = distance_up(p, near_.corners) <= upper_;
      const bool far = distance_up(p, far_.corners) <= upper_;
      if (near && far) return static_cast<uint16_t>(at);
      if (!near && !far) return {};
      (near ? low : high) = at;
      at = (low + high) / 2;
    }
    return {};
  }

 private:
  const Part& part_;
  const Row &near_, &far_;
  double upper_;
};

constexpr size_t kTried = 3;  // rows on each side of a cut: the ones that reach farthest

// The rows that hold at all of `at`, the best first by the distances of `by`.
std::vector<const Row*> holding(const Rows& rows, std::initializer_list<size_t> at,
                                std::initializer_list<size_t> by, double upper) {
  std::vector<const Row*> found;
  for (const Row& row : rows) {
    if (std::all_of(at.begin(), at.end(), [&](size_t i) { return row.distance[i] <= upper; }))
      found.push_back(&row);
  }
  const auto rank = [&](const Row* row) {
    double most = 0;
    for (const size_t i : by) most = std::max(most, row->distance[i]);
    return most;
  };
  std::sort(found.begin(), found.end(),
            [&](const Row* x, const Row* y) { return rank(x) < rank(y); });
  if (found.size() > kTried) found.resize(kTried);
  return found;
}

std::optional<Leaf> cut_of(const Part& part, const Rows& rows, double upper) {
  for (size_t o = 0; o < 3; ++o) {
    const size_t j = (o + 1) % 3, k = (o + 2) % 3;
    const std::vector<const Row*> nears = holding(rows, {o}, {j, k}, upper);
    if (nears.empty()) return {};  // no cut has this corner
    const std::vector<const Row*> fars = holding(rows, {j, k}, {o}, upper);
    for (const Row* near : nears) {
      for (const Row* far : fars) {
        const Cutting cutting(part, *near, *far, upper);
        const std::optional<uint16_t> next = cutting.on(o, j);
        if (!next) continue;
        const std::optional<uint16_t> last = cutting.on(o, k);
        if (last)
          return Leaf{.alone = static_cast<uint8_t>(o),
                      .first = near->face,
                      .second = far->face,
                      .cut_next = *next,
                      .cut_last = *last};
      }
    }
  }
  return {};
}

}  // namespace

Point2 between(const Point2& x, const Point2& y, double t) {
  Point2 p;
  for (int i = 0; i < 3; ++i) {
    const TwoDoubles at = between({x.hi[i], x.lo[i]}, {y.hi[i], y.lo[i]}, t);
    p.hi[i] = at.hi;
    p.lo[i] = at.lo;
  }
  return p;
}

ScaledMesh::ScaledMesh(const Mesh& mesh, int exponent) : mesh_(mesh) {
  vertices_.reserve(mesh.vertices.size());
  for (const glm::dvec3& v : mesh.vertices) {
    vertices_.emplace_back(std::ldexp(v.x, exponent), std::ldexp(v.y, exponent),
                           std::ldexp(v.z, exponent));
  }
}

std::array<glm::dvec3, 3> ScaledMesh::corners(uint32_t face) const {
  const glm::uvec3& f = mesh_.faces[face];
  return {vertices_[f.x], vertices_[f.y], vertices_[f.z]};
}

Part ScaledMesh::part(uint32_t face) const {
  const std::array<glm::dvec3, 3> c = corners(face);
  return {Point2{.hi = c[0], .lo = {}}, Point2{.hi = c[1], .lo = {}}, Point2{.hi = c[2], .lo = {}}};
}

double distance_up(const Point2& p, const std::array<glm::dvec3, 3>& t) {
  constexpr double kTiny = 0x1p-500;  // where squares underflow
  std::array<glm::dvec3, 3> from;
  double reach = 0;
  for (size_t i = 0; i < 3; ++i) {
    from[i] = (t[i] - p.hi) - p.lo;
    if (is_zero(from[i]) && is_zero(p.lo)) return 0;
    reach = std::max(reach, largest(from[i]));
  }
  const double length = glm::length(offset(p, t, closest_weights({}, from)));
  return length * (1 + 4 * kUlp) + kOff * (reach + largest(p.hi)) + kTiny;
}

void Hints::add(uint32_t one) {
  const auto end = face.begin() + static_cast<std::ptrdiff_t>(count);
  if (count < kMostHints && std::find(face.begin(), end, one) == end) face[count++] = one;
}

double middle_distance_up(const Part& part, const std::array<glm::dvec3, 3>& t) {
  return distance_up({.hi = (part[0].hi + part[1].hi + part[2].hi) / 3.0, .lo = {}}, t);
}

Hints nearest_faces(const Part& part, const ScaledMesh& b) {
  using Found = std::pair<double, uint32_t>;
  std::vector<Found> nearest;  // a heap, the farthest of them first
  for (uint32_t face = 0; face < b.face_count(); ++face) {
    const Found found{middle_distance_up(part, b.corners(face)), face};
    if (nearest.size() == kMostHints && found >= nearest.front()) continue;
    if (nearest.size() == kMostHints) {
      std::pop_heap(nearest.begin(), nearest.end());
      nearest.pop_back();
    }
    nearest.push_back(found);
    std::push_heap(nearest.begin(), nearest.end());
  }
  std::sort(nearest.begin(), nearest.end());
  Hints hints;
  for (const Found& found : nearest) hints.add(found.second);
  return hints;
}

std::optional<Leaf> proof_of(const Part& part, const ScaledMesh& b, const Hints& hints,
                             double upper) {
  Rows rows;
  for (size_t i = 0; i < hints.count; ++i) {
    rows.push_back(row_of(part, b, hints.face[i]));
    if (rows.back().most() <= upper) return Leaf{.alone = Leaf::kUncut, .first = hints.face[i]};
  }
  return cut_of(part, rows, upper);
}

Nearest nearest_of(const Part& part, const ScaledMesh& b, const Hints& hints) {
  Nearest best{.leaf = {}, .upper = std::numeric_limits<double>::infinity()};
  for (size_t i = 0; i < hints.count; ++i) {
    const double most = row_of(part, b, hints.face[i]).most();
    if (most < best.upper) best = {{.alone = Leaf::kUncut, .first = hints.face[i]}, most};
  }
  return best;
}

}  // namespace vkh
