#include "host/mesh/orientation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "host/base/rounding.h"
#include "host/mesh/exact_sum.h"

namespace vkh {

void DeterminantSum::add(const Corners3& vectors) {
  const auto& [a, b, c] = vectors;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double left = b[j] * c[k], right = b[k] * c[j];
    sum += a[i] * (left - right);
    size += std::abs(a[i]) * (std::abs(left) + std::abs(right));
    largest = std::max({largest, std::abs(a[i]), std::abs(b[i]), std::abs(c[i])});
  }
}

int DeterminantSum::sign(double roundings) const {
  const bool is_sure =
      size > 1e-240 && largest < 1e60 && std::abs(sum) > roundings * 0x1p-53 * size;
  if (!is_sure) return 0;
  return sum > 0 ? 1 : -1;
}

namespace {

// The sign by plain doubles; 0 where rounding leaves it open. Each of the differences, products and
// sums rounds by 2^-53 of itself: seven of them stand between a term and the result (Shewchuk 1997
// has 7 + 2^-47 of them against the sum of the terms' sizes). Sixteen are taken.
int sure_orientation(const Corners3& from_d) {
  DeterminantSum determinant;
  determinant.add(from_d);
  return -determinant.sign(16);  // from d the corners of a triangle whose front it sees turn left
}

// Three doubles as integers of 40 bits at most over one power of two, which they share.
std::optional<std::array<int64_t, 3>> integers_of(double x, double y, double z) {
  const std::array<double, 3> all = {x, y, z};
  std::array<int64_t, 3> mantissa{}, result{};
  std::array<int, 3> exponent{};
  int least = 2000;
  for (size_t i = 0; i < 3; ++i) {
    mantissa[i] = static_cast<int64_t>(mantissa_of(all[i], exponent[i]));
    if (mantissa[i] == 0) continue;
    const int zeros = std::countr_zero(static_cast<uint64_t>(mantissa[i]));
    mantissa[i] >>= zeros;
    exponent[i] += zeros;
    least = std::min(least, exponent[i]);
  }
  for (size_t i = 0; i < 3; ++i) {
    if (mantissa[i] == 0) continue;
    const int up = exponent[i] - least;
    if (up + static_cast<int>(std::bit_width(static_cast<uint64_t>(mantissa[i]))) > 40) return {};
    result[i] = std::signbit(all[i]) ? -(mantissa[i] << up) : mantissa[i] << up;
  }
  return result;
}

bool is_exact(const glm::dvec3& p, const glm::dvec3& d) {
  return sum_error(p.x, -d.x) == 0 && sum_error(p.y, -d.y) == 0 && sum_error(p.z, -d.z) == 0;
}

// Sums up to six products of three integers of 40 bits: under 2^123.
class ShortVolume : public WideInteger<2> {
 public:
  void add_product(int64_t a, int64_t b, int64_t c, bool negative) {
    const auto size = [](int64_t x) { return static_cast<uint64_t>(x < 0 ? -x : x); };
    add(product_of(size(a), size(b), size(c)), 0, negative != ((a < 0) != ((b < 0) != (c < 0))));
  }
};

// The sign by integers, where the differences are exact and short: six products of 120 bits.
std::optional<int> short_orientation(const Corners3& from_d) {
  const auto& [a, b, c] = from_d;
  std::array<std::array<int64_t, 3>, 3> axis{};
  for (int i = 0; i < 3; ++i) {
    const auto integers = integers_of(a[i], b[i], c[i]);
    if (!integers) return {};
    axis[static_cast<size_t>(i)] = *integers;
  }
  ShortVolume sum;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum.add_product(axis[i][0], axis[j][1], axis[k][2], false);
    sum.add_product(axis[i][0], axis[k][1], axis[j][2], true);
  }
  return -sum.sign();
}

// Adds p . (q x r).
void add_determinant(ExactVolume& sum, const glm::dvec3& p, const glm::dvec3& q,
                     const glm::dvec3& r, bool negative) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum.add_product(p[i], q[j], r[k], negative);
    sum.add_product(p[i], q[k], r[j], !negative);
  }
}

// (b - a) . ((c - a) x (d - a)), multiplied out.
int exact_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                      const glm::dvec3& d) {
  ExactVolume sum;
  add_determinant(sum, b, c, d, false);
  add_determinant(sum, a, c, d, true);
  add_determinant(sum, a, b, d, false);
  add_determinant(sum, a, b, c, true);
  return sum.sign();
}

Point2 along(int axis, const glm::dvec3& p) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

// Whether numbers of these signs are all >= 0, or all <= 0.
bool agree(int x, int y, int z) { return std::min({x, y, z}) >= 0 || std::max({x, y, z}) <= 0; }

bool is_between(const Point2& p, const Point2& a, const Point2& b) {
  return std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) &&
         std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
}

// Whether the closed segments pq and ab of a plane meet.
bool segments_meet(const Point2& p, const Point2& q, const Point2& a, const Point2& b) {
  const int pa = turn_of(a, b, p), qa = turn_of(a, b, q);
  const int ap = turn_of(p, q, a), bp = turn_of(p, q, b);
  if (pa * qa < 0 && ap * bp < 0) return true;
  return (pa == 0 && is_between(p, a, b)) || (qa == 0 && is_between(q, a, b)) ||
         (ap == 0 && is_between(a, p, q)) || (bp == 0 && is_between(b, p, q));
}

bool is_inside(const Point2& p, const std::array<Point2, 3>& t) {
  return agree(turn_of(p, t[0], t[1]), turn_of(p, t[1], t[2]), turn_of(p, t[2], t[0]));
}

// The same in the triangle's plane, seen along an axis along which it has an area.
bool meets_in_plane(const glm::dvec3& p, const glm::dvec3& q, const Corners3& t) {
  int axis = 0;
  while (axis < 2 && turn_along(axis, t[0], t[1], t[2]) == 0) ++axis;
  const std::array<Point2, 3> seen = {along(axis, t[0]), along(axis, t[1]), along(axis, t[2])};
  const Point2 from = along(axis, p), to = along(axis, q);
  return is_inside(from, seen) || is_inside(to, seen) ||
         segments_meet(from, to, seen[0], seen[1]) || segments_meet(from, to, seen[1], seen[2]) ||
         segments_meet(from, to, seen[2], seen[0]);
}

}  // namespace

int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                const glm::dvec3& d) {
  if (d == a || d == b || d == c) return 0;
  const Corners3 from_d = {a - d, b - d, c - d};
  const int sure = sure_orientation(from_d);
  if (sure != 0) return sure;
  if (is_exact(a, d) && is_exact(b, d) && is_exact(c, d)) {
    const std::optional<int> by_integers = short_orientation(from_d);
    if (by_integers) return *by_integers;
  }
  return exact_orientation(a, b, c, d);
}

int turn_along(int axis, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return turn_of(along(axis, a), along(axis, b), along(axis, c));
}

bool segment_meets(const glm::dvec3& p, const glm::dvec3& q, const Corners3& t) {
  const int of_p = orientation(t[0], t[1], t[2], p), of_q = orientation(t[0], t[1], t[2], q);
  if (of_p * of_q > 0) return false;
  if (of_p == 0 && of_q == 0) return meets_in_plane(p, q, t);
  return agree(orientation(p, q, t[0], t[1]), orientation(p, q, t[1], t[2]),
               orientation(p, q, t[2], t[0]));
}

}  // namespace vkh
