#include "host/mesh/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "host/mesh/round_to_float.h"

namespace vkh {
namespace {

using glm::dvec3;

// Raises the cost by this share of the squared length: on a plane every collapse costs nothing but
// rounding noise, and short edges should go first there.
constexpr double kLengthCost = 1e-6;
// A face may turn by at most 78 degrees in one collapse.
constexpr double kTurnCosine = 0.2;
// Below this share of the trace cubed, the quadric's 3x3 system has no minimum worth trusting.
constexpr double kSingular = 1e-5;

/// Sum of squared distances to planes: p'Ap + 2 b'p + c, with A symmetric.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  dvec3 b{0};
  double c = 0;

  void add_plane(const dvec3& n, double offset, double weight) {
    xx += weight * n.x * n.x;
    xy += weight * n.x * n.y;
    xz += weight * n.x * n.z;
    yy += weight * n.y * n.y;
    yz += weight * n.y * n.z;
    zz += weight * n.z * n.z;
    b += weight * offset * n;
    c += weight * offset * offset;
  }

  Quadric& operator+=(const Quadric& o) {
    xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
    b += o.b;
    c += o.c;
    return *this;
  }

  dvec3 row_x() const { return {xx, xy, xz}; }
  dvec3 row_y() const { return {xy, yy, yz}; }
  dvec3 row_z() const { return {xz, yz, zz}; }

  double at(const dvec3& p) const {
    const dvec3 ap{glm::dot(row_x(), p), glm::dot(row_y(), p), glm::dot(row_z(), p)};
    return glm::dot(ap, p) + 2 * glm::dot(b, p) + c;
  }

  /// Finds its minimum by Cramer's rule; false if the minimum is a line or a plane.
  bool minimum(dvec3& p) const {
    const dvec3 yz_cross = glm::cross(row_y(), row_z());
    const double det = glm::dot(row_x(), yz_cross);
    const double trace = xx + yy + zz;
    if (!(det > kSingular * trace * trace * trace)) return false;
    const dvec3 zx_cross = glm::cross(row_z(), row_x());
    const dvec3 xy_cross = glm::cross(row_x(), row_y());
    p = -(yz_cross * b.x + zx_cross * b.y + xy_cross * b.z) / det;
    return true;
  }
};

struct Collapse {
  double cost = 0;
  uint32_t keep = 0, drop = 0;
  uint32_t keep_age = 0, drop_age = 0;  ///< stale once a corner has aged
  dvec3 position{0};

  // A total order, so that equal costs pop in the same order from every standard library's heap.
  bool operator<(const Collapse& o) const {
    return std::tie(o.cost, o.keep, o.drop, o.keep_age, o.drop_age) <
           std::tie(cost, keep, drop, keep_age, drop_age);
  }
};

class Simplifier {
 public:
  explicit Simplifier(const Mesh& mesh);
  void run(size_t target_faces);
  Mesh result(const std::string& name) const;

 private:
  using Face = glm::uvec3;

  void find_edges();
  void push(uint32_t v, uint32_t w);
  bool is_dead(uint32_t face) const { return faces_[face].x == faces_[face].y; }
  bool keeps_topology(uint32_t v, uint32_t w);
  bool folds(uint32_t v, uint32_t other, const dvec3& position) const;
  void apply(const Collapse& collapse);
  void neighbours(uint32_t v, std::vector<uint32_t>& out) const;

  std::vector<dvec3> positions_;
  std::vector<Face> faces_;  ///< a dead face has its first two corners equal
  std::vector<std::vector<uint32_t>> faces_of_;
  std::vector<Quadric> quadrics_;
  std::vector<uint32_t> ages_;
  std::vector<bool> on_border_;
  std::priority_queue<Collapse> queue_;
  size_t live_faces_ = 0;
  std::vector<uint32_t> ring_v_, ring_w_;  ///< kept between calls for their memory
};

bool has(const glm::uvec3& face, uint32_t v) { return face.x == v || face.y == v || face.z == v; }

Simplifier::Simplifier(const Mesh& mesh)
    : positions_(mesh.vertices),
      faces_of_(mesh.vertices.size()),
      quadrics_(mesh.vertices.size()),
      ages_(mesh.vertices.size(), 0),
      on_border_(mesh.vertices.size(), false) {
  for (const Face& face : mesh.faces) {
    if (face.x == face.y || face.y == face.z || face.z == face.x) continue;
    const dvec3& p = positions_[face.x];
    const dvec3 scaled = glm::cross(positions_[face.y] - p, positions_[face.z] - p);
    const double twice_area = std::sqrt(glm::dot(scaled, scaled));
    const dvec3 n = twice_area > 0 ? scaled / twice_area : dvec3(0);
    for (int k = 0; k < 3; ++k) {
      quadrics_[face[k]].add_plane(n, -glm::dot(n, p), twice_area);
      faces_of_[face[k]].push_back(static_cast<uint32_t>(faces_.size()));
    }
    faces_.push_back(face);
  }
  live_faces_ = faces_.size();
  find_edges();
}

void Simplifier::find_edges() {
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  edges.reserve(3 * faces_.size());
  for (const Face& face : faces_) {
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax({face[k], face[(k + 1) % 3]}));
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::pair<uint32_t, uint32_t>> inner;
  for (size_t i = 0, next = 0; i < edges.size(); i = next) {
    while (next < edges.size() && edges[next] == edges[i]) ++next;
    if (next - i == 2) {
      inner.push_back(edges[i]);
    } else {
      on_border_[edges[i].first] = on_border_[edges[i].second] = true;
    }
  }
  for (const auto& [v, w] : inner) push(v, w);
}

void Simplifier::push(uint32_t v, uint32_t w) {
  if (on_border_[v] || on_border_[w]) return;
  Collapse collapse{.keep = std::min(v, w), .drop = std::max(v, w)};
  collapse.keep_age = ages_[collapse.keep];
  collapse.drop_age = ages_[collapse.drop];

  Quadric quadric = quadrics_[collapse.keep];
  quadric += quadrics_[collapse.drop];
  const dvec3 p = positions_[collapse.keep], q = positions_[collapse.drop];
  const double squared_length = glm::dot(p - q, p - q);
  const dvec3 middle = round_to_float(0.5 * (p + q));
  std::array<dvec3, 4> choices{p, q, middle, middle};
  // A minimum far from the edge is that of two nearly parallel planes, not of this surface.
  dvec3 best;
  if (quadric.minimum(best) && glm::dot(best - middle, best - middle) < squared_length) {
    choices[3] = round_to_float(best);
  }
  collapse.cost = std::numeric_limits<double>::infinity();
  for (const dvec3& choice : choices) {
    const double cost = std::max(0.0, quadric.at(choice)) + kLengthCost * squared_length;
    if (cost < collapse.cost) collapse.cost = cost, collapse.position = choice;
  }
  queue_.push(collapse);
}

void Simplifier::neighbours(uint32_t v, std::vector<uint32_t>& out) const {
  out.clear();
  for (uint32_t f : faces_of_[v]) {
    for (int k = 0; k < 3; ++k) {
      if (faces_[f][k] != v) out.push_back(faces_[f][k]);
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

// The link condition: v and w share the two corners opposite their edge and no other neighbour.
bool Simplifier::keeps_topology(uint32_t v, uint32_t w) {
  size_t shared_faces = 0;
  for (uint32_t f : faces_of_[v]) shared_faces += has(faces_[f], w);
  if (shared_faces != 2) return false;
  neighbours(v, ring_v_);
  neighbours(w, ring_w_);
  size_t shared = 0;
  for (uint32_t n : ring_v_) shared += std::binary_search(ring_w_.begin(), ring_w_.end(), n);
  return shared == 2 && ring_v_.size() + ring_w_.size() > 6;  // 3 + 3 is a tetrahedron
}

// Whether a face of v that survives the collapse of (v, other) would turn over or lose its area.
bool Simplifier::folds(uint32_t v, uint32_t other, const dvec3& position) const {
  for (uint32_t f : faces_of_[v]) {
    const Face& face = faces_[f];
    if (has(face, other)) continue;
    const int k = face.x == v ? 0 : face.y == v ? 1 : 2;
    const dvec3& p = positions_[face[(k + 1) % 3]];
    const dvec3& q = positions_[face[(k + 2) % 3]];
    const dvec3 before = glm::cross(q - p, positions_[v] - p);
    const dvec3 after = glm::cross(q - p, position - p);
    const double limit =
        kTurnCosine * std::sqrt(glm::dot(before, before)) * std::sqrt(glm::dot(after, after));
    if (!(glm::dot(before, after) > limit)) return true;
  }
  return false;
}

void Simplifier::apply(const Collapse& collapse) {
  const uint32_t keep = collapse.keep, drop = collapse.drop;
  for (uint32_t f : faces_of_[drop]) {
    if (has(faces_[f], keep)) {
      for (int k = 0; k < 3; ++k) {
        auto& list = faces_of_[faces_[f][k]];
        if (faces_[f][k] != drop) list.erase(std::find(list.begin(), list.end(), f));
      }
      faces_[f] = Face(drop);
      --live_faces_;
    } else {
      for (int k = 0; k < 3; ++k) {
        if (faces_[f][k] == drop) faces_[f][k] = keep;
      }
      faces_of_[keep].push_back(f);
    }
  }
  faces_of_[drop].clear();
  positions_[keep] = collapse.position;
  quadrics_[keep] += quadrics_[drop];
  ++ages_[keep];
  ++ages_[drop];
  neighbours(keep, ring_v_);
  for (uint32_t n : ring_v_) push(keep, n);
}

void Simplifier::run(size_t target_faces) {
  while (live_faces_ > target_faces && !queue_.empty()) {
    const Collapse next = queue_.top();
    queue_.pop();
    if (ages_[next.keep] != next.keep_age || ages_[next.drop] != next.drop_age) continue;
    if (!keeps_topology(next.keep, next.drop)) continue;
    if (folds(next.keep, next.drop, next.position) || folds(next.drop, next.keep, next.position)) {
      continue;
    }
    apply(next);
  }
}

Mesh Simplifier::result(const std::string& name) const {
  constexpr uint32_t kUnused = std::numeric_limits<uint32_t>::max();
  std::vector<uint32_t> renamed(positions_.size(), kUnused);
  std::vector<dvec3> vertices;
  std::vector<Face> faces;
  faces.reserve(live_faces_);
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    if (is_dead(f)) continue;
    Face face = faces_[f];
    for (int k = 0; k < 3; ++k) {
      uint32_t& index = renamed[face[k]];
      if (index == kUnused) {
        index = static_cast<uint32_t>(vertices.size());
        vertices.push_back(round_to_float(positions_[face[k]]));
      }
      face[k] = index;
    }
    faces.push_back(face);
  }
  return make_mesh(name, std::move(vertices), std::move(faces));
}

}  // namespace

Mesh simplify(const Mesh& mesh, size_t target_faces) {
  Simplifier simplifier(mesh);
  simplifier.run(target_faces);
  return simplifier.result(mesh.name + ", simplified");
}

}  // namespace vkh
