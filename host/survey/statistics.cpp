#include "host/survey/statistics.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "host/base/hypot3.h"
#include "host/base/rounding.h"

namespace vkh {
namespace {

constexpr double kUnit = 0x1p-53;  // a rounding, relative

// A sum of numbers that are not negative: what each addition loses is added up, too (Neumaier
// 1974). With n numbers it is off by less than kUnit + (n kUnit)^2 of itself, which is under 1.01
// kUnit for 2^22 of them. Here sums are of sums, up to four deep: 5.
class Sum {
 public:
  void add(double x) {
    const double sum = sum_ + x;
    lost_ += sum_error(sum_, x);
    sum_ = sum;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};
constexpr double kSumError = 12 * kUnit;  // with a product's rounding in each part

struct FaceArea {
  double area, error;
};

// Uses hypot3, since no square of a component may underflow.
double length_of(const glm::dvec3& v) { return hypot3(v.x, v.y, v.z); }

// Half of |e x f|. Differences are off by kUnit of themselves, a component of the product by 4
// kUnit of its parts, so the vector by less than 16 |e| |f| kUnit, its length by
// 5 kUnit of itself besides, and half of that by less than 16 |e| |f| kUnit in all.
// If a product underflows it is off by 2^-1075, a component by twice that, and so all of it by less
// than 2^-1072. Vertices that are off by delta move it by 2 delta (|e| + |f| + 2 delta).
FaceArea area_of(const glm::dvec3& e, const glm::dvec3& f, double delta) {
  const double e_length = length_of(e), f_length = length_of(f);
  const double area = 0.5 * length_of(glm::cross(e, f));
  const double moved = 2 * delta * (e_length + f_length + 2 * delta);
  return {area, 1.01 * (16 * kUnit * e_length * f_length + moved) + 0x1p-1070};
}

// Scales the largest component of an edge to between 1 and 2.
Frame unit_of(const Mesh& a) {
  double largest = 0;
  for (const glm::uvec3& f : a.faces) {
    for (const uint32_t to : {f.y, f.z}) {
      const glm::dvec3 d = glm::abs(a.vertices[to] - a.vertices[f.x]);
      largest = std::max({largest, d.x, d.y, d.z});
    }
  }
  Frame unit;
  if (largest > 0 && std::isfinite(largest)) unit.exponent = -std::ilogb(largest);
  return unit;
}

// Every point counts as one. Sums of ones are exact: the error is of quotients and products
// with them.
Areas counts_of(size_t points) {
  Areas areas;
  areas.of_face.assign(points, 1.0);
  areas.whole = static_cast<double>(points);
  areas.error = 2 * kSumError * areas.whole;
  return areas;
}

}  // namespace

Areas areas_of(const Mesh& a) {
  if (a.are_points) return counts_of(a.faces.size());
  Areas areas;
  areas.unit = unit_of(a);
  areas.of_face.reserve(a.faces.size());
  const double delta = areas.unit.to_frame(a.delta);
  Sum whole, error;
  for (const glm::uvec3& f : a.faces) {
    const auto edge = [&](uint32_t to) {
      const glm::dvec3 d = a.vertices[to] - a.vertices[f.x];
      const Frame& unit = areas.unit;
      return glm::dvec3(unit.to_frame(d.x), unit.to_frame(d.y), unit.to_frame(d.z));
    };
    const FaceArea face = area_of(edge(f.y), edge(f.z), delta);
    areas.of_face.push_back(face.area);
    whole.add(face.area);
    error.add(face.error);
  }
  areas.whole = whole.value();
  areas.error = 1.01 * error.value() + 2 * kSumError * areas.whole;
  return areas;
}

float least_float_above(double x) {
  const auto near = static_cast<float>(x);
  return static_cast<double>(near) < x
             ? std::nextafter(near, std::numeric_limits<float>::infinity())
             : near;
}

// Scaling by a power of two rounds only subnormal results, which are far below `displacement`.
Threshold threshold_at(const Frame& frame, double displacement, double distance) {
  const double d = frame.to_frame(distance);
  return {d * (1 - 1e-15) - displacement, d * (1 + 1e-15) + displacement};
}

}  // namespace vkh
