#include "tests/verification/oracle/reference_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace vkh::test {
namespace {

using glm::dvec3;

constexpr double kUnit = 0x1p-53;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr uint32_t kNone = 0xffffffffu;
// A candidate this deep is closed at its upper bound. With D the joint diagonal, u = 2^-53 and
// coordinates centred (norms <= D/2), the computed result is off by at most: uD/2 a mesh for
// centring, uD/2 a level for midpoints (24 uD in all), about 16 uD for a distance and its prunings:
// < 64 uD.
constexpr uint32_t kMaxDepth = 48;
constexpr double kMarginUnits = 64.0;

/// A point of A whose distance to B is known.
struct Sample {
  dvec3 point;
  double distance;
  uint32_t face;  ///< of B, where the closest point lies
};

struct Candidate {
  std::array<Sample, 3> corner;
  double upper = kInfinity;
  uint32_t depth = 0;
};

/// A few faces of B that may be close to a candidate, without repeats.
struct FaceSet {
  std::array<uint32_t, 8> face = {};
  uint32_t count = 0;

  bool add(uint32_t f) {
    if (count == face.size() ||
        std::find(face.begin(), face.begin() + count, f) != face.begin() + count) {
      return false;
    }
    face[count++] = f;
    return true;
  }
};

/// Distances of a candidate's corners to one face of B; `upper` is the largest (ha's term).
struct Column {
  const PreparedTriangle* triangle;
  std::array<double, 3> distance;
  double upper;
};

/// min(u1, u2), the Lipschitz bounds. u1 goes from the best corner over its longest edge; u2 from
/// the worst corner over the smallest enclosing circle.
double lipschitz_bound(const Candidate& c) {
  const auto& s = c.corner;
  const std::array<double, 3> e = {glm::distance(s[1].point, s[2].point),
                                   glm::distance(s[2].point, s[0].point),
                                   glm::distance(s[0].point, s[1].point)};
  double u1 = kInfinity;
  for (size_t i = 0; i < 3; ++i) {
    u1 = std::min(u1, s[i].distance + std::max(e[(i + 1) % 3], e[(i + 2) % 3]));
  }
  // The largest angle faces the longest edge; an acute triangle's circumradius is e / (2 sin).
  const size_t k = e[0] >= e[1] && e[0] >= e[2] ? 0 : e[1] >= e[2] ? 1 : 2;
  const dvec3 x = s[(k + 1) % 3].point - s[k].point;
  const dvec3 y = s[(k + 2) % 3].point - s[k].point;
  double radius = 0.5 * e[k];
  if (glm::dot(x, y) > 0.0) {
    radius = 0.5 * e[0] * e[1] * e[2] / glm::length(glm::cross(x, y));
  }
  return std::min(u1, radius + std::max({s[0].distance, s[1].distance, s[2].distance}));
}

/// The candidate is cut in two where its distances to faces i and k even out; each part is held
/// against its own face. Both distances are convex, so the parts' corners decide. This holds for
/// any cut.
double split_bound(const Candidate& c, const Column& i, const Column& k, double cutoff) {
  double bound = 0.0;
  for (size_t j = 0; j < 3; ++j) bound = std::max(bound, std::min(i.distance[j], k.distance[j]));
  for (size_t j = 0; j < 3 && bound < cutoff; ++j) {
    const size_t next = (j + 1) % 3;
    double from = i.distance[j] - k.distance[j];
    double to = i.distance[next] - k.distance[next];
    if ((from < 0.0) == (to < 0.0)) continue;
    dvec3 p = c.corner[j].point;
    dvec3 q = c.corner[next].point;
    double here = kInfinity;
    for (int step = 0; step < 4 && here > bound; ++step) {
      const dvec3 x = p + (from / (from - to)) * (q - p);
      const double di = i.triangle->distance(x);
      const double dk = k.triangle->distance(x);
      here = std::min(here, std::max(di, dk));
      const bool like_from = (di - dk < 0.0) == (from < 0.0);
      (like_from ? p : q) = x;
      (like_from ? from : to) = di - dk;
      if (from == to) break;
    }
    bound = std::max(bound, here);
  }
  return bound;
}

std::vector<dvec3> centred(const Mesh& mesh, const dvec3& centre) {
  std::vector<dvec3> points = mesh.vertices;
  for (dvec3& p : points) p -= centre;
  return points;
}

class Search {
 public:
  Search(ClosestTree tree, double tolerance, uint64_t max_candidates)
      : tree_(std::move(tree)), tolerance_(tolerance), max_candidates_(max_candidates) {}

  void seed(const Mesh& a, const std::vector<dvec3>& points) {
    std::vector<Sample> samples(points.size(), Sample{dvec3(0.0), 0.0, kNone});
    uint32_t hint = 0;
    const auto sample_vertex = [&](uint32_t v) {
      if (samples[v].face == kNone) samples[v] = sample(points[v], std::array{hint});
      hint = samples[v].face;
    };
    for (const glm::uvec3& f : a.faces) {
      for (int i = 0; i < 3; ++i) sample_vertex(f[i]);
    }
    for (const glm::uvec3& f : a.faces) {
      Candidate c;
      c.corner = {samples[f.x], samples[f.y], samples[f.z]};
      keep_or_drop(c, FaceSet{});
    }
  }

  void run() {
    std::vector<Candidate> frontier;
    while (!next_.empty()) {
      frontier.clear();
      std::swap(frontier, next_);
      ++stats_.waves;
      for (const Candidate& c : frontier) {
        const bool spent = stats_.candidates >= max_candidates_ || c.depth >= kMaxDepth;
        if (spent || c.upper <= lower_ + tolerance_) {
          dropped_ = std::max(dropped_, c.upper);
        } else {
          subdivide(c);
        }
      }
    }
  }

  Interval interval() const { return {lower_, std::max(lower_, dropped_)}; }
  const ReferenceStats& stats() const { return stats_; }

 private:
  template <class Hints>
  Sample sample(const dvec3& p, const Hints& hints) {
    Nearest best;
    for (uint32_t face : hints) tree_.try_face(p, face, best);
    tree_.query(p, best);
    ++stats_.queries;
    const double d = std::sqrt(best.squared);
    lower_ = std::max(lower_, d);
    return {p, d, best.face};
  }

  Sample middle(const Sample& p, const Sample& q) {
    return sample(0.5 * (p.point + q.point), std::array{p.face, q.face});
  }

  /// Splits in four at the middles of the edges, or in two across a thin candidate's longest edge.
  void subdivide(const Candidate& c) {
    const auto& s = c.corner;
    FaceSet family;
    for (const Sample& corner : s) family.add(corner.face);
    std::array<double, 3> e;
    for (size_t i = 0; i < 3; ++i) e[i] = glm::distance(s[(i + 2) % 3].point, s[(i + 1) % 3].point);
    const auto longest = static_cast<size_t>(std::max_element(e.begin(), e.end()) - e.begin());
    const auto child = [&](const Sample& x, const Sample& y, const Sample& z) {
      keep_or_drop({{x, y, z}, c.upper, c.depth + 1}, family);
    };
    if (e[longest] > 3.0 * *std::min_element(e.begin(), e.end())) {
      const Sample &apex = s[longest], &x = s[(longest + 1) % 3], &y = s[(longest + 2) % 3];
      const Sample m = middle(x, y);
      family.add(m.face);
      child(apex, x, m);
      child(apex, m, y);
      return;
    }
    const std::array<Sample, 3> m = {middle(s[1], s[2]), middle(s[2], s[0]), middle(s[0], s[1])};
    for (const Sample& each : m) family.add(each.face);
    child(s[0], m[2], m[1]);
    child(m[2], s[1], m[0]);
    child(m[1], m[0], s[2]);
    child(m[0], m[1], m[2]);
  }

  /// Drops candidates that cannot raise the answer by more than the tolerance, and remembers their
  /// largest bound.
  void keep_or_drop(Candidate c, const FaceSet& family) {
    ++stats_.candidates;
    c.upper = std::min(c.upper, lipschitz_bound(c));
    if (c.upper > lower_ + tolerance_) c.upper = std::min(c.upper, face_bound(c, family));
    if (c.upper > lower_ + tolerance_) {
      next_.push_back(c);
    } else {
      dropped_ = std::max(dropped_, c.upper);
    }
  }

  Column column(const Candidate& c, uint32_t face) const {
    const PreparedTriangle& t = tree_.triangle(face);
    Column out = {&t, {}, 0.0};
    for (size_t j = 0; j < 3; ++j) {
      out.distance[j] = t.distance(c.corner[j].point);
      out.upper = std::max(out.upper, out.distance[j]);
    }
    return out;
  }

  /// ha and the split bound, over the faces closest to the corners, to the centroid and to the
  /// parent's samples.
  double face_bound(const Candidate& c, const FaceSet& family) {
    FaceSet faces;
    std::vector<Column>& columns = columns_;
    columns.clear();
    double bound = kInfinity;
    const auto add = [&](uint32_t face) {
      if (!faces.add(face)) return;
      columns.push_back(column(c, face));
      bound = std::min(bound, columns.back().upper);
    };
    for (const Sample& s : c.corner) add(s.face);
    if (bound <= lower_ + tolerance_) return bound;
    const dvec3 centroid = (c.corner[0].point + c.corner[1].point + c.corner[2].point) / 3.0;
    add(sample(centroid, std::array{c.corner[0].face, c.corner[1].face, c.corner[2].face}).face);
    for (uint32_t i = 0; i < family.count; ++i) add(family.face[i]);
    for (size_t i = 0; i < columns.size(); ++i) {
      for (size_t k = 0; k < i && bound > lower_ + tolerance_; ++k) {
        bound = std::min(bound, split_bound(c, columns[i], columns[k], bound));
      }
    }
    return bound;
  }

  ClosestTree tree_;
  double tolerance_;
  uint64_t max_candidates_;
  double lower_ = 0.0;
  double dropped_ = 0.0;
  std::vector<Candidate> next_;
  std::vector<Column> columns_;
  ReferenceStats stats_;
};

}  // namespace

Interval reference_hausdorff(const Mesh& a, const Mesh& b, double absolute_tolerance,
                             uint64_t max_candidates, ReferenceStats* stats) {
  dvec3 lo(kInfinity);
  dvec3 hi(-kInfinity);
  for (const Mesh* mesh : {&a, &b}) {
    for (const dvec3& v : mesh->vertices) {
      lo = glm::min(lo, v);
      hi = glm::max(hi, v);
    }
  }
  const dvec3 centre = 0.5 * lo + 0.5 * hi;
  Search search(ClosestTree(centred(b, centre), b.faces), absolute_tolerance, max_candidates);
  search.seed(a, centred(a, centre));
  search.run();
  if (stats != nullptr) *stats = search.stats();
  const double margin = kMarginUnits * kUnit * glm::distance(lo, hi);
  const Interval found = search.interval();
  return {std::max(0.0, found.lower - margin), found.upper + margin};
}
}  // namespace vkh::test
