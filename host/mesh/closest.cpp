#include "host/mesh/closest.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

namespace vkh {
namespace {

struct Candidate {
  double distance2;
  ClosestPoint at;
};

// The closest point of segment xy; i and j are the corners whose barycentrics it sets.
Candidate on_edge(const glm::dvec3& p, const glm::dvec3& x, const glm::dvec3& y, int i, int j) {
  const glm::dvec3 e = y - x;
  const double ee = glm::dot(e, e);
  const double t = ee > 0 ? std::clamp(glm::dot(p - x, e) / ee, 0.0, 1.0) : 0.0;
  Candidate c;
  c.at.point = x + t * e;
  c.at.barycentric[i] = 1 - t;
  c.at.barycentric[j] = t;
  const glm::dvec3 off = p - c.at.point;
  c.distance2 = glm::dot(off, off);
  return c;
}

}  // namespace

ClosestPoint closest_point(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                           const glm::dvec3& c) {
  const Candidate edges[] = {on_edge(p, a, b, 0, 1), on_edge(p, b, c, 1, 2),
                             on_edge(p, c, a, 2, 0)};
  Candidate best = *std::min_element(
      std::begin(edges), std::end(edges),
      [](const Candidate& x, const Candidate& y) { return x.distance2 < y.distance2; });
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double nn = glm::dot(n, n);
  if (nn > 0) {
    const double v = glm::dot(glm::cross(p - a, c - a), n) / nn;
    const double w = glm::dot(glm::cross(b - a, p - a), n) / nn;
    if (v >= 0 && w >= 0 && v + w <= 1) {
      const glm::dvec3 q = a + v * (b - a) + w * (c - a);
      const glm::dvec3 off = p - q;
      if (glm::dot(off, off) < best.distance2) best.at = {q, {1 - v - w, v, w}};
    }
  }
  return best.at;
}

// Scales by a power of two, which is exact except for numbers that become subnormal beside the
// largest coordinate.
ClosestPoint closest_point_of_any_size(const glm::dvec3& p, const glm::dvec3& a,
                                       const glm::dvec3& b, const glm::dvec3& c) {
  constexpr int kUsual = 200;
  double largest = 0;
  for (const glm::dvec3& q : {p, a, b, c})
    largest = std::max({largest, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
  const int exponent = largest > 0 && std::isfinite(largest) ? std::ilogb(largest) : 0;
  if (std::abs(exponent) <= kUsual) return closest_point(p, a, b, c);
  const auto scaled = [](const glm::dvec3& q, int by) {
    return glm::dvec3(std::ldexp(q.x, by), std::ldexp(q.y, by), std::ldexp(q.z, by));
  };
  ClosestPoint found = closest_point(scaled(p, -exponent), scaled(a, -exponent),
                                     scaled(b, -exponent), scaled(c, -exponent));
  found.point = scaled(found.point, exponent);
  return found;
}

}  // namespace vkh
