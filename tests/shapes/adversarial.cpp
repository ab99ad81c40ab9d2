#include "tests/shapes/adversarial.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "host/mesh/round_to_float.h"
#include "tests/verification/oracle/closest.h"

namespace vkh::test {
namespace {

using glm::dvec3;
using Triple = std::array<dvec3, 3>;

dvec3 in_the_cube(const dvec3& p) { return glm::clamp(p, dvec3(-1.0), dvec3(1.0)); }

double sign(Random& random) { return random.below(2) == 0 ? -1.0 : 1.0; }

dvec3 few_ulps(Random& random, const dvec3& p) {
  dvec3 q = round_to_float(p);
  for (int i = 0; i < 3; ++i) {
    const double ulp = std::ldexp(1.0, std::ilogb(q[i] == 0.0 ? 1e-7 : q[i]) - 23);
    q[i] += ulp * (static_cast<double>(random.below(9)) - 4.0);
  }
  return q;
}

Triple needle(Random& random, const dvec3& about, double size) {
  const dvec3 a = about;
  const dvec3 b = about + size * random.direction();
  const dvec3 c = b + size * log_uniform(random, -44, -2) * random.direction();
  return {a, b, c};
}

Triple cap(Random& random, const dvec3& about, double size) {
  const dvec3 edge = size * random.direction();
  const double along = random.below(4) == 0 ? log_uniform(random, -40, 0) : random.range(-0.5, 1.5);
  const dvec3 foot = about + along * edge;
  const dvec3 height = size * log_uniform(random, -44, -4) * random.direction();
  return {about, about + edge, foot + height};
}

Triple grid(Random& random, const dvec3& about, double size) {
  const double step = std::ldexp(1.0, std::ilogb(size) - 2);
  const auto corner = [&] {
    const auto coordinate = [&] { return static_cast<double>(random.below(9)) - 4.0; };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return glm::round(about / step) * step + step * dvec3(x, y, z);
  };
  const dvec3 a = corner(), b = corner(), c = corner();
  return {a, b, c};
}

Triple collinear(Random& random, const dvec3& about, double size) {
  if (random.below(2) == 0) {
    const Triple t = grid(random, about, size);
    return {t[0], t[1], t[0] * 2.0 - t[1]};
  }
  const dvec3 edge = size * random.direction();
  return {about, about + edge, about + random.range(-1.0, 2.0) * edge};
}

Triple make(Random& random, Shape shape, const dvec3& about, double size) {
  const auto beside = [&] { return about + random.in_cube(size); };
  const dvec3 a = beside(), b = beside(), c = beside();
  switch (shape) {
    case Shape::kNeedle:
      return needle(random, about, size);
    case Shape::kCap:
      return cap(random, about, size);
    case Shape::kGrid:
      return grid(random, about, size);
    case Shape::kFewUlps:
    case Shape::kLowParts: {
      const dvec3 p = few_ulps(random, about), q = few_ulps(random, about);
      return {p, q, few_ulps(random, about)};
    }
    case Shape::kCollinear:
      return collinear(random, about, size);
    case Shape::kSegment:
      return {a, b, b};
    case Shape::kPoint:
      return {a, a, a};
    default:
      return {a, b, c};
  }
}

/// Every corner near the high part of the first, less than an ulp away from each other.
StoredTriangle by_low_parts(Random& random, const Triple& t) {
  StoredTriangle out;
  for (uint32_t i = 0; i < 3; ++i) {
    Stored& s = out.corner[i];
    s = stored_single(random.below(3) == 0 ? t[i] : t[0]);
    for (int k = 0; k < 3; ++k) s.lo[k] = low_part(random, s.hi[k]);
  }
  return out;
}

StoredTriangle finished(Random& random, Shape shape, Triple t) {
  const uint32_t turn = random.below(3);
  std::rotate(t.begin(), t.begin() + turn, t.end());
  if (random.below(2) == 0) std::swap(t[0], t[1]);
  for (dvec3& p : t) p = in_the_cube(p);
  if (shape == Shape::kLowParts) return by_low_parts(random, t);
  const bool single = random.below(3) == 0;
  StoredTriangle out;
  for (uint32_t i = 0; i < 3; ++i) out.corner[i] = single ? stored_single(t[i]) : stored(t[i]);
  return out;
}

Shape any_shape(Random& random) {
  return static_cast<Shape>(random.below(static_cast<uint32_t>(Shape::kCount)));
}

}  // namespace

Stored stored_single(const dvec3& p) { return {glm::vec3(round_to_float(p)), glm::vec3(0.0f)}; }

Stored stored(const dvec3& p) {
  const dvec3 hi = round_to_float(p);
  return {glm::vec3(hi), glm::vec3(round_to_float(p - hi))};
}

StoredTriangle hard_triangle(Random& random) { return hard_triangle(random, any_shape(random)); }

StoredTriangle hard_triangle(Random& random, Shape shape) {
  const double size = shape == Shape::kAny ? 1.0 : log_uniform(random, -24, 0);
  // Some about the origin, where a triangle is large for its coordinates.
  const double from_origin = random.below(4) == 0 ? 0.0 : 1.0 - size;
  return finished(random, shape, make(random, shape, random.in_cube(from_origin), size));
}

StoredTriangle hard_triangle_near(Random& random, const dvec3& about, double size) {
  const Shape shape = any_shape(random);
  return finished(random, shape, make(random, shape, about + random.in_cube(size), size));
}

float hard_base(Random& random, const StoredTriangle& t, const dvec3& p) {
  const double distance = point_triangle_distance(p, t.at(0), t.at(1), t.at(2));
  switch (random.below(4)) {
    case 0:
      return 0.0f;
    case 1:
      return static_cast<float>(distance * (1.0 - log_uniform(random, -24, 0)));
    case 2:
      return static_cast<float>(distance * (1.0 + log_uniform(random, -24, 0)));
    default:
      return static_cast<float>(log_uniform(random, -30, 2));
  }
}

dvec3 barycentrics(Random& random) {
  const double cut = random.unit();
  const double rest = random.unit() * (1.0 - cut);
  switch (random.below(5)) {
    case 0:
      return {1.0, 0.0, 0.0};
    case 1:
      return {cut, 1.0 - cut, 0.0};
    case 2:
      return {0.5, 0.5, 0.0};
    default:
      return {cut, rest, 1.0 - cut - rest};
  }
}

dvec3 on_triangle(const StoredTriangle& t, const dvec3& weights) {
  return weights.x * t.at(0) + weights.y * t.at(1) + weights.z * t.at(2);
}

dvec3 hard_point(Random& random, const StoredTriangle& t) {
  const uint32_t turn = random.below(3);
  const dvec3 w = barycentrics(random);
  const dvec3 a = t.at(turn), b = t.at(turn + 1), c = t.at(turn + 2);
  const dvec3 on = w.x * a + w.y * b + w.z * c;
  const dvec3 normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);
  const dvec3 up = length > 0.0 ? normal / length : random.direction();
  const double height = sign(random) * log_uniform(random, -45, -1);
  const double size = std::max(glm::length(b - a), glm::length(c - a));
  switch (random.below(9)) {
    case 0:
      return in_the_cube(on);
    case 1:
      return in_the_cube(on + height * up);
    case 2:
      return in_the_cube(on + height * size * up);
    case 3:
      return in_the_cube(a + (a - w.x * b - (1.0 - w.x) * c));
    case 4:
      return in_the_cube(on + height * random.direction());
    case 5:
      return in_the_cube(on + size * height * random.direction());
    // Right above an edge's line: on the border between the edge and the inside.
    case 6:
      return in_the_cube(a + w.x * (b - a) + size * random.range(-1.0, 1.0) * up);
    case 7:
      return few_ulps(random, in_the_cube(on));
    default:
      return random.in_cube(1.0);
  }
}

double log_uniform(Random& random, double lo, double hi) { return std::exp2(random.range(lo, hi)); }

float hard_float(Random& random, int lo, int hi) {
  uint32_t mantissa = static_cast<uint32_t>(random.bits()) & 0x7fffffu;
  switch (random.below(8)) {
    case 0:
      mantissa = 0;
      break;
    case 1:
      mantissa = 0x7fffffu;
      break;
    case 2:
      mantissa = (mantissa & ~0xfffu) | 0x800u;
      break;
    case 3:
      mantissa = (mantissa & ~0xfffu) | 0x7ffu;
      break;
    case 4:
      mantissa = random.below(8);
      break;
    default:
      break;
  }
  const int exponent = lo + static_cast<int>(random.below(static_cast<uint32_t>(hi - lo + 1)));
  const float x = std::bit_cast<float>(random.below(2) << 31 | 127u << 23 | mantissa);
  return std::ldexp(x, exponent);
}

float low_part(Random& random, float x) {
  if (x == 0.0f || random.below(8) == 0) return 0.0f;
  const float half_ulp = std::ldexp(1.0f, std::ilogb(x) - 24);
  switch (random.below(6)) {
    case 0:
      return std::nextafter(half_ulp, 0.0f);
    case 1:
      return -std::nextafter(half_ulp, 0.0f);
    case 2:
      return half_ulp * hard_float(random, -20, 0);
    // A remainder like that of directed rounding: up to an ulp.
    case 3:
      return std::nextafter(2.0f * half_ulp, 0.0f) * (random.below(2) == 0 ? 1.0f : -1.0f);
    default:
      return half_ulp * static_cast<float>(round_to_float(random.range(-0.99, 0.99)));
  }
}

Stored hard_vector(Random& random, int lo, int hi) {
  Stored out;
  const bool alike = random.below(2) == 0;
  const int exponent = lo + static_cast<int>(random.below(static_cast<uint32_t>(hi - lo + 1)));
  for (int i = 0; i < 3; ++i) {
    out.hi[i] = alike ? hard_float(random, exponent, exponent) : hard_float(random, lo, hi);
    if (random.below(16) == 0) out.hi[i] = 0.0f;
    out.lo[i] = low_part(random, out.hi[i]);
  }
  return out;
}

float float_up(double x) {
  const float f = static_cast<float>(round_to_float(x));
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

float length_up(const Stored& p) { return float_up(glm::length(p.value()) * (1.0 + 0x1p-50)); }

}  // namespace vkh::test
