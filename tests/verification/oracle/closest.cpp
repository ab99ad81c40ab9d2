#include "tests/verification/oracle/closest.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

namespace vkh::test {
namespace {

using glm::dvec3;

constexpr double kUnit = 0x1p-53;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr uint32_t kLeafFaces = 4;

double length_squared(const dvec3& v) { return glm::dot(v, v); }
double taxicab(const dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

double inverse_or_zero(double x) {
  const double inverse = 1.0 / x;
  return std::isfinite(inverse) ? inverse : 0.0;
}

void keep_shorter(dvec3& best, const dvec3& offset) {
  if (length_squared(offset) < length_squared(best)) best = offset;
}

/// The offset from the closest point of the segment s..s+edge to s+r.
dvec3 from_segment(const dvec3& r, const dvec3& edge, double inverse) {
  return r - std::clamp(glm::dot(r, edge) * inverse, 0.0, 1.0) * edge;
}

double box_squared(const dvec3& lo, const dvec3& hi, const dvec3& p) {
  return length_squared(glm::max(glm::max(lo - p, p - hi), dvec3(0.0)));
}

}  // namespace

PreparedTriangle::PreparedTriangle(const dvec3& p0, const dvec3& p1, const dvec3& p2) {
  const double e0 = length_squared(p2 - p1);
  const double e1 = length_squared(p0 - p2);
  const double e2 = length_squared(p1 - p0);
  const bool first = e0 >= e1 && e0 >= e2;
  const bool second = !first && e1 >= e2;
  a = first ? p0 : second ? p1 : p2;
  const dvec3 b = first ? p1 : second ? p2 : p0;
  const dvec3 c = first ? p2 : second ? p0 : p1;
  ab = b - a;
  ac = c - a;
  bc = c - b;
  inverse_ab = inverse_or_zero(length_squared(ab));
  inverse_ac = inverse_or_zero(length_squared(ac));
  inverse_bc = inverse_or_zero(length_squared(bc));
  const dvec3 n = glm::cross(ab, ac);
  const double inverse_n = inverse_or_zero(length_squared(n));
  to_v = glm::cross(ac, n) * inverse_n;
  to_w = glm::cross(n, ab) * inverse_n;
  noise = 16.0 * kUnit * std::max(taxicab(to_v), taxicab(to_w));
  flat = noise * std::sqrt(std::max({e0, e1, e2})) > 0x1p-26;
}

// Every offset that is compared starts at a point of the triangle, so a wrong turn costs tightness
// only. In a cap the barycentrics lose digits to the flat angle: the foot's own offset is projected
// again until that adds no more than noise. The rest moves the foot of a point at height d
// along the triangle by noise * length * d, and its distance by half the square of that over d;
// where this could show, the triangle is so flat that its edges are as close, and they are tried
// too.
dvec3 PreparedTriangle::offset(const dvec3& p) const {
  const dvec3 r = p - a;
  double v = glm::dot(r, to_v);
  double w = glm::dot(r, to_w);
  dvec3 best(kInfinity);
  const double slack = noise * taxicab(r);
  if (noise > 0.0 && v >= -slack && w >= -slack && v + w <= 1.0 + 2.0 * slack) {
    dvec3 foot = r - v * ab - w * ac;
    for (int step = 0; step < 8; ++step) {
      const double dv = glm::dot(foot, to_v);
      const double dw = glm::dot(foot, to_w);
      v += dv;
      w += dw;
      foot = r - v * ab - w * ac;
      if (std::max(std::abs(dv), std::abs(dw)) <= noise * taxicab(foot) + 2.0 * kUnit) break;
    }
    if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) best = foot;
    if (!flat && v > slack && w > slack && v + w < 1.0 - 2.0 * slack) return best;
  }
  keep_shorter(best, from_segment(r, ab, inverse_ab));
  keep_shorter(best, from_segment(r, ac, inverse_ac));
  keep_shorter(best, from_segment(r - ab, bc, inverse_bc));
  return best;
}

dvec3 closest_point_on_triangle(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c) {
  return p - PreparedTriangle(a, b, c).offset(p);
}

double point_triangle_distance(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c) {
  return PreparedTriangle(a, b, c).distance(p);
}

MeshPoint closest_point_on_mesh(const dvec3& p, const Mesh& mesh) {
  MeshPoint best = {p, kInfinity, 0xffffffffu};
  for (uint32_t i = 0; i < mesh.faces.size(); ++i) {
    const glm::uvec3 f = mesh.faces[i];
    const PreparedTriangle t(mesh.vertices[f.x], mesh.vertices[f.y], mesh.vertices[f.z]);
    const dvec3 offset = t.offset(p);
    const double distance = glm::length(offset);
    if (distance < best.distance) best = {p - offset, distance, i};
  }
  return best;
}

double point_mesh_distance(const dvec3& p, const Mesh& mesh) {
  return closest_point_on_mesh(p, mesh).distance;
}

ClosestTree::ClosestTree(const std::vector<dvec3>& points, const std::vector<glm::uvec3>& faces)
    : order_(faces.size()) {
  std::vector<Box> boxes;
  for (const glm::uvec3& f : faces) {
    const dvec3 &a = points[f.x], &b = points[f.y], &c = points[f.z];
    triangles_.emplace_back(a, b, c);
    boxes.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
  }
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(2 * order_.size());
  build(boxes, 0, static_cast<uint32_t>(order_.size()));
}

uint32_t ClosestTree::build(const std::vector<Box>& boxes, uint32_t first, uint32_t end) {
  Box box = {dvec3(kInfinity), dvec3(-kInfinity)};
  Box centroids = box;  // doubled
  for (uint32_t i = first; i < end; ++i) {
    const Box& each = boxes[order_[i]];
    box = {glm::min(box.lo, each.lo), glm::max(box.hi, each.hi)};
    centroids = {glm::min(centroids.lo, each.lo + each.hi),
                 glm::max(centroids.hi, each.lo + each.hi)};
  }
  const auto at = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back({box, first, end - first});
  if (end - first <= kLeafFaces) return at;
  const dvec3 e = centroids.hi - centroids.lo;
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const auto doubled = [&](uint32_t i) { return boxes[i].lo[axis] + boxes[i].hi[axis]; };
  const uint32_t middle = first + (end - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end,
                   [&](uint32_t i, uint32_t j) { return doubled(i) < doubled(j); });
  nodes_[at].count = 0;
  build(boxes, first, middle);
  const uint32_t right = build(boxes, middle, end);
  nodes_[at].first = right;
  return at;
}

void ClosestTree::try_face(const dvec3& p, uint32_t face, Nearest& best) const {
  const double squared = length_squared(triangles_[face].offset(p));
  if (squared < best.squared) best = {squared, face};
}

void ClosestTree::visit(uint32_t at, const dvec3& p, Nearest& best) const {
  const Node& node = nodes_[at];
  for (uint32_t i = 0; i < node.count; ++i) try_face(p, order_[node.first + i], best);
  if (node.count > 0) return;
  const Box& left_box = nodes_[at + 1].box;
  const Box& right_box = nodes_[node.first].box;
  const double left = box_squared(left_box.lo, left_box.hi, p);
  const double right = box_squared(right_box.lo, right_box.hi, p);
  const uint32_t near = left <= right ? at + 1 : node.first;
  const uint32_t far = left <= right ? node.first : at + 1;
  if (std::min(left, right) < best.squared) visit(near, p, best);
  if (std::max(left, right) < best.squared) visit(far, p, best);
}

}  // namespace vkh::test
