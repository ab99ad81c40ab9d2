#include "host/mesh/face_point.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "host/base/rounding.h"

namespace vkh {
namespace {

using FaceCorners = std::array<glm::dvec3, 3>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double largest_of(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

glm::dvec3 scaled(const glm::dvec3& v, int exponent) {
  return {std::scalbn(v.x, exponent), std::scalbn(v.y, exponent), std::scalbn(v.z, exponent)};
}

// Squares under this are of edges that are points beside the largest distance, which is about 1.
constexpr double kLeastSquare = 1e-290;

double ratio(double a, double b) { return b > kLeastSquare ? a / b : 0; }

// The query point is the origin.
FaceWeights on_edge(const FaceCorners& t, size_t base, size_t end) {
  const glm::dvec3 edge = t[end] - t[base];
  const double v = std::clamp(ratio(-glm::dot(t[base], edge), glm::dot(edge, edge)), 0.0, 1.0);
  const glm::dvec3 at = t[base] + v * edge;
  return {.base = base, .end = end, .third = 3 - base - end, .v = v, .distance2 = glm::dot(at, at)};
}

// The altitude h from ab to c is by Gram-Schmidt, as in shaders/math/triangle.h: normal equations
// would lose a factor (longest edge / altitude)^2 on needles. The distance is infinite if the
// origin does not lie above the inside; 4 ulp under 1, so that the exact v + w is at most 1.
FaceWeights inside(const FaceCorners& t) {
  const glm::dvec3 ab = t[1] - t[0], ac = t[2] - t[0];
  const double ee = glm::dot(ab, ab);
  const double s = ratio(glm::dot(ac, ab), ee);
  const glm::dvec3 h = ac - s * ab;
  const double hh = glm::dot(h, h);
  if (!(hh > kLeastSquare)) return {};
  const double x = ratio(-glm::dot(t[0], ab), ee);
  const double w = ratio(glm::dot(-t[0] - x * ab, h), hh);
  const double v = x - w * s;
  if (!(v >= 0 && w >= 0 && v + w <= 1 - 0x1p-50)) return {};
  const glm::dvec3 at = (t[0] + v * ab) + w * ac;
  return {.v = v, .w = w, .distance2 = glm::dot(at, at)};
}

}  // namespace

FaceWeights closest_weights(const glm::dvec3& p, const std::array<glm::dvec3, 3>& corners) {
  FaceCorners t{corners[0] - p, corners[1] - p, corners[2] - p};
  const double size = std::max({largest_of(t[0]), largest_of(t[1]), largest_of(t[2])});
  if (size == 0) return {};
  for (glm::dvec3& corner : t) corner = scaled(corner, -std::ilogb(size));
  FaceWeights best = inside(t);
  for (const FaceWeights& edge : {on_edge(t, 0, 1), on_edge(t, 1, 2), on_edge(t, 2, 0)})
    if (edge.distance2 < best.distance2) best = edge;
  return best;
}

namespace {

// A point in double, and how far it may be from the exact one, rounded up.
struct Placed {
  glm::dvec3 point;
  double off = 0;
};

// With u = 2^-53: a difference and a product are each off by u of themselves, so that the two
// products are by 2 u (and u^2), their sum by one u more of both, and the last sum by u of itself:
// 3 u of the products and u of the result, of which the latter is computed, too; the 4 takes that
// and the sum's own rounding. Products that underflow are off by 2^-1074.
Placed place(const FaceCorners& corners, const FaceWeights& at) {
  if (at.w == 0 && (at.v == 0 || at.v == 1)) return {corners[at.v == 0 ? at.base : at.end]};
  const glm::dvec3& base = corners[at.base];
  const glm::dvec3 along = at.v * (corners[at.end] - base);
  const glm::dvec3 across = at.w * (corners[at.third] - base);
  Placed placed{base + (along + across)};
  for (int i = 0; i < 3; ++i)
    placed.off += 0x1p-53 * std::abs(placed.point[i]) +
                  0x1p-51 * (std::abs(along[i]) + std::abs(across[i])) + 0x1p-1070;
  placed.off *= 1 + 0x1p-50;
  return placed;
}

struct LengthBounds {
  double lower, upper;
};

// Differences are off by u of themselves, squares by u, their sum by 2 u: the sum of squares by 5
// u, its root by 2.5 u and its own, 3.5 u, which 8 u takes with the product's rounding. What
// underflows when the largest component is about 1 is nothing beside that. Scaling back rounds
// where the result is not normal: one step more.
LengthBounds bounds_of_length(const glm::dvec3& p, const glm::dvec3& q) {
  const glm::dvec3 offset = p - q;
  const double largest = largest_of(offset);
  if (largest == 0) return {0, 0};
  if (!std::isfinite(largest)) return {std::numeric_limits<double>::max(), kInfinity};
  const int exponent = std::ilogb(largest);
  const glm::dvec3 unit = scaled(offset, -exponent);
  const double length = std::sqrt(glm::dot(unit, unit));
  return {std::nextafter(std::scalbn(length * (1 - 0x1p-50), exponent), 0.0),
          std::nextafter(std::scalbn(length * (1 + 0x1p-50), exponent), kInfinity)};
}

FacePoint found_at(const glm::dvec3& p, const Placed& placed) {
  const LengthBounds length = bounds_of_length(p, placed.point);
  return {placed.point, length.lower, add_up(length.upper, placed.off)};
}

// min over the corners of (p - corner).r / |r|, rounded down; `t` is the corners from p, the
// largest coordinate about 1, and L their largest length. Each corner is off by u of itself, its
// product with r by 3 u more of |corner| |r|: 4 u (8 taken) of L |r|. The quotient is off by u, |r|
// by 3.5 u: 8 u.
double separation_down(const FaceCorners& t, const glm::dvec3& direction) {
  const double size = largest_of(direction);
  if (!(size > 0) || !std::isfinite(size)) return 0;
  const glm::dvec3 r = scaled(direction, -std::ilogb(size));
  double reach = kInfinity, longest = 0;
  for (const glm::dvec3& corner : t) {
    reach = std::min(reach, -glm::dot(corner, r));
    longest = std::max(longest, glm::length(corner));
  }
  const double length = glm::length(r);
  return std::max((reach - 0x1p-50 * longest * length) / length * (1 - 0x1p-50), 0.0);
}

}  // namespace

double face_distance_down(const glm::dvec3& p, const std::array<glm::dvec3, 3>& corners,
                          const FacePoint& near) {
  FaceCorners t{corners[0] - p, corners[1] - p, corners[2] - p};
  const double size = std::max({largest_of(t[0]), largest_of(t[1]), largest_of(t[2])});
  if (size == 0 || !std::isfinite(size)) return 0;
  const int exponent = std::ilogb(size);
  for (glm::dvec3& corner : t) corner = scaled(corner, -exponent);
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double best = std::max({separation_down(t, p - near.point), separation_down(t, normal),
                                separation_down(t, -normal)});
  return std::min(std::nextafter(std::scalbn(best, exponent), 0.0), near.upper);
}

FacePoint closest_on_face(const glm::dvec3& p, const std::array<glm::dvec3, 3>& corners) {
  const double largest = std::max(
      {largest_of(p), largest_of(corners[0]), largest_of(corners[1]), largest_of(corners[2])});
  // Differences of larger ones may overflow: a point is placed in a sixteenth of the size, which
  // moves what underflows by 2^-1070 at most.
  constexpr double kSafe = 0x1p1020;
  if (largest <= kSafe) return found_at(p, place(corners, closest_weights(p, corners)));
  const FaceCorners small{corners[0] / 16.0, corners[1] / 16.0, corners[2] / 16.0};
  const FaceWeights at = closest_weights(p / 16.0, small);
  Placed placed = place(small, at);
  const bool is_corner = placed.off == 0;
  constexpr double kMost = std::numeric_limits<double>::max() / 16;  // rounding may pass it
  placed.point = 16.0 * glm::clamp(placed.point, -kMost, kMost);
  placed.off = 16 * placed.off + (is_corner ? 0 : 0x1p-1066);
  if (is_corner) placed.point = corners[at.v == 0 ? at.base : at.end];
  return found_at(p, placed);
}

}  // namespace vkh
