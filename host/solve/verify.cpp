#include "vkhausdorff/verify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "host/base/float128.h"
#include "host/base/hypot3.h"

namespace vkh {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// The error of Float128 numbers: 2^-113 for each of a few operations on coordinates; taken 256
// times over.
const Float128 kFloat128Ulp = float128(0x1p-105);
// The error of a length computed in Float128 and rounded to double: hypot3 is within 5 * 2^-53, the
// rest is nothing.
constexpr double kOutward = 0x1p-48;

struct Triangle {
  std::array<Float128Vector, 3> corner;
};

// p minus the closest point of the segment from s to s + e.
Float128Vector from_segment(const Float128Vector& p, const Float128Vector& s,
                            const Float128Vector& e) {
  const Float128Vector r = p - s;
  const Float128 length2 = dot(e, e);
  Float128 t = length2 > 0 ? dot(r, e) / length2 : 0;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return r - t * e;
}

// p minus a closest point of the triangle, rounded: only its direction is used.
Float128Vector offset_of(const Float128Vector& p, const Triangle& t) {
  const auto& [a, b, c] = t.corner;
  Float128Vector best = from_segment(p, a, b - a);
  for (const Float128Vector& other : {from_segment(p, b, c - b), from_segment(p, c, a - c)}) {
    if (dot(other, other) < dot(best, best)) best = other;
  }
  const Float128Vector n = cross(b - a, c - a);
  const bool inside = dot(n, n) > 0 && dot(cross(b - a, p - a), n) >= 0 &&
                      dot(cross(c - b, p - b), n) >= 0 && dot(cross(a - c, p - c), n) >= 0;
  return inside ? (dot(p - a, n) / dot(n, n)) * n : best;
}

double length(const Float128Vector& r) {
  return hypot3(static_cast<double>(r.x), static_cast<double>(r.y), static_cast<double>(r.z));
}

// A positive distance, made smaller or larger by more than its rounding.
double outward(double distance, double direction) {
  const double moved = distance * (1 + direction * kOutward);
  return std::max(std::nextafter(moved, direction * kInfinity), 0.0);
}

struct DistanceBounds {
  double lower = 0, upper = 0;
  bool beyond = false;  // d >= the bound asked about: decided in Float128, where no double rounds
};

// d(p, t) and whether it is at least `bound`, for p known to within `scale` * kFloat128Ulp in each
// coordinate.
DistanceBounds distance_to(const Float128Vector& p, const Triangle& t, Float128 scale,
                           double bound) {
  const Float128Vector r = offset_of(p, t);
  const Float128 size = magnitude(r);
  const double upper = outward(length(r) + static_cast<double>(scale * kFloat128Ulp), 1);
  if (!(size > 0)) return {0, upper, bound <= 0};
  const Float128Vector d = (1 / size) * r;  // so that nothing underflows
  Float128 reach = dot(p - t.corner[0], d);
  for (const Float128Vector& s : t.corner) {
    const Float128 along = dot(p - s, d);
    reach = along < reach ? along : reach;
  }
  reach -= 16 * scale * kFloat128Ulp;  // |d| < 2, three coordinates, each off by less than 2 units
  if (!(reach > 0)) return {0, upper, bound <= 0};
  const bool beyond =
      float128(bound) * float128(bound) * dot(d, d) * (1 + kFloat128Ulp) <= reach * reach;
  return {outward(static_cast<double>(reach) / length(d), -1), upper, beyond};
}

// The exact point: barycentrics are multiples of 2^-40, so that their products with doubles have 93
// bits; the sum of three of them is rounded.
Float128Vector witness_of(const Mesh& a, const Report& r) {
  const glm::uvec3 f = a.faces[r.witness_a.face];
  const glm::dvec3 w = r.witness_a.barycentric;
  return float128(w.x) * float128(a.vertices[f.x]) + float128(w.y) * float128(a.vertices[f.y]) +
         float128(w.z) * float128(a.vertices[f.z]);
}

double largest(const Mesh& mesh) {
  double out = 0;
  for (const glm::dvec3& v : mesh.vertices) {
    const glm::dvec3 m = glm::abs(v);
    out = std::max({out, m.x, m.y, m.z});
  }
  return out;
}

// A lower bound of the distance from p to the box of three points; p is rounded to double.
double box_distance_down(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t, double scale) {
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    const auto [lo, hi] = std::minmax({t[0][i], t[1][i], t[2][i]});
    most = std::max({most, lo - p[i], p[i] - hi});
  }
  return most * (1 - 0x1p-50) - scale * 0x1p-51;
}

bool is_exact_point(const glm::dvec3& weights) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double units = weights[i] * 0x1p40;
    if (!(units >= 0 && units <= 0x1p40 && units == std::floor(units))) return false;
    sum += units;
  }
  return sum == 0x1p40;
}

}  // namespace

WitnessCheck verify_witness(const Mesh& a, const Mesh& b, const Report& report) {
  WitnessCheck out;
  const bool named =
      report.witness_a.face < a.faces.size() && is_exact_point(report.witness_a.barycentric);
  if (!named) return out;
  const Float128Vector p = witness_of(a, report);
  const glm::dvec3 near(static_cast<double>(p.x), static_cast<double>(p.y),
                        static_cast<double>(p.z));
  const double scale = std::max(largest(a), largest(b));
  out.distance_lower = out.distance_upper = kInfinity;
  out.holds = true;
  for (const glm::uvec3& f : b.faces) {
    const std::array<glm::dvec3, 3> t = {b.vertices[f.x], b.vertices[f.y], b.vertices[f.z]};
    // Skips a face whose box is farther than a face that was measured.
    if (box_distance_down(near, t, scale) > out.distance_upper) continue;
    const DistanceBounds d = distance_to(p, {{float128(t[0]), float128(t[1]), float128(t[2])}},
                                         float128(scale), report.lower);
    out.holds = out.holds && d.beyond;
    out.distance_lower = std::min(out.distance_lower, d.lower);
    out.distance_upper = std::min(out.distance_upper, d.upper);
  }
  return out;
}

}  // namespace vkh
