#include "tests/verification/oracle/exact_side.h"

#include <algorithm>
#include <climits>
#include <cmath>

namespace vkh::test {
namespace {

using exact::Vector;

int least_exponent(const std::vector<DVec3>& vertices) {
  int least = INT_MAX;
  for (const glm::dvec3& v : vertices) {
    for (int i = 0; i < 3; ++i) least = std::min(least, exact::Dyadic(v[i]).exponent);
  }
  return least;
}

Integer integer(double x, int exponent, unsigned shift) {
  const exact::Dyadic d(x);
  Integer value(d.mantissa);
  if (d.mantissa != 0) value <<= static_cast<unsigned>(d.exponent - exponent) + shift;
  return value;
}

Vector vector(const glm::dvec3& v, int exponent, unsigned shift) {
  return {integer(v.x, exponent, shift), integer(v.y, exponent, shift),
          integer(v.z, exponent, shift)};
}

const Integer& at(const Vector& v, size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

// The sign of (b - a) x (c - a) along the axis.
int turn(size_t axis, const Vector& a, const Vector& b, const Vector& c) {
  const size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  const Integer left = (at(b, i) - at(a, i)) * (at(c, j) - at(a, j));
  const Integer right = (at(b, j) - at(a, j)) * (at(c, i) - at(a, i));
  return sgn(Integer(left - right));
}

int side(const std::array<Vector, 3>& t, const Vector& p) {
  return sgn(exact::dot(exact::cross(t[1] - t[0], t[2] - t[0]), p - t[0]));
}

bool has_area(const std::array<Vector, 3>& t) {
  const Vector n = exact::cross(t[1] - t[0], t[2] - t[0]);
  return sgn(n.x) != 0 || sgn(n.y) != 0 || sgn(n.z) != 0;
}

// Above what get_d() cuts off, twice over, and an integer more.
double rounding(const Integer& x) { return 0x1p-50 * std::abs(x.get_d()) + 1; }

}  // namespace

ExactSides::ExactSides(const Mesh& a, const Mesh& b)
    : faces_a_(a.faces.begin(), a.faces.end()),
      tree_({b.vertices.begin(), b.vertices.end()}, {b.faces.begin(), b.faces.end()}) {
  int exponent = std::min(least_exponent(a.vertices), least_exponent(b.vertices));
  if (exponent == INT_MAX) exponent = 0;
  for (const glm::dvec3& v : a.vertices) a_.push_back(vector(v, exponent, 0));
  std::vector<Vector> vertices;
  for (const glm::dvec3& v : b.vertices) vertices.push_back(vector(v, exponent, kBits));
  for (const glm::uvec3& f : b.faces) {
    Face face{{vertices[f.x], vertices[f.y], vertices[f.z]}, {}, {}, {}, {}};
    for (size_t i = 0; i < 3; ++i) {
      face.lo[i] =
          std::min({at(face.corners[0], i), at(face.corners[1], i), at(face.corners[2], i)});
      face.hi[i] =
          std::max({at(face.corners[0], i), at(face.corners[1], i), at(face.corners[2], i)});
    }
    for (size_t i = 0; i < 3; ++i) {
      face.below[i] = face.lo[i].get_d() - rounding(face.lo[i]);
      face.above[i] = face.hi[i].get_d() + rounding(face.hi[i]);
    }
    b_.push_back(std::move(face));
    near_b_.push_back({b.vertices[f.x], b.vertices[f.y], b.vertices[f.z]});
  }
}

Vector ExactSides::point(uint32_t face, const glm::uvec3& weights) const {
  const glm::uvec3& f = faces_a_[face];
  const Vector &a = a_[f.x], &b = a_[f.y], &c = a_[f.z];
  return {a.x * weights.x + b.x * weights.y + c.x * weights.z,
          a.y * weights.x + b.y * weights.y + c.y * weights.z,
          a.z * weights.x + b.z * weights.y + c.z * weights.z};
}

std::optional<int> ExactSides::winding_along(size_t axis, const Vector& p) const {
  const size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  int winding = 0;
  const double near_i = at(p, i).get_d(), near_j = at(p, j).get_d();
  const double off_i = rounding(at(p, i)), off_j = rounding(at(p, j));
  for (const Face& face : b_) {
    if (near_i + off_i < face.below[i] || near_i - off_i > face.above[i] ||
        near_j + off_j < face.below[j] || near_j - off_j > face.above[j])
      continue;
    if (at(p, i) < face.lo[i] || at(p, i) > face.hi[i] || at(p, j) < face.lo[j] ||
        at(p, j) > face.hi[j] || at(p, axis) > face.hi[axis])
      continue;
    const auto& t = face.corners;
    if (!has_area(t)) continue;
    const int x = turn(axis, p, t[0], t[1]), y = turn(axis, p, t[1], t[2]),
              z = turn(axis, p, t[2], t[0]);
    if (std::min({x, y, z}) < 0 && std::max({x, y, z}) > 0) continue;
    if (x == 0 || y == 0 || z == 0) return {};
    const int of_p = side(t, p);
    if (of_p == 0) return {};
    if (of_p != x) winding += x;
  }
  return winding;
}

std::optional<int> ExactSides::winding(const Vector& p) const {
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::optional<int> found = winding_along(axis, p);
    if (found) return found;
  }
  return {};
}

ExactSides::Closest ExactSides::closest(const Vector& p, const glm::dvec3& near, double off) const {
  std::vector<double> distance(b_.size());
  double best = std::numeric_limits<double>::infinity();
  for (size_t f = 0; f < b_.size(); ++f) {
    distance[f] = point_triangle_distance(near, near_b_[f][0], near_b_[f][1], near_b_[f][2]);
    best = std::min(best, distance[f]);
  }
  std::optional<exact::Fraction> least;
  std::vector<size_t> which;
  for (size_t f = 0; f < b_.size(); ++f) {
    if (distance[f] > best + 2 * off) continue;
    const auto& [x, y, z] = b_[f].corners;
    exact::Fraction d = exact::to_triangle(p, x, y, z);
    if (least && exact::less(*least, d)) continue;
    if (!least || exact::less(d, *least)) which.clear();
    which.push_back(f);
    least = std::move(d);
  }
  Closest found;
  for (const size_t f : which) {
    const int of_p = side(b_[f].corners, p);
    if (!has_area(b_[f].corners)) {
      ++found.degenerate;
    } else {
      ++(of_p > 0 ? found.above : of_p < 0 ? found.below : found.in_plane);
    }
  }
  return found;
}

}  // namespace vkh::test
