#include "host/survey/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "host/base/hypot3.h"
#include "host/base/parallel.h"
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

// No square of a component may underflow.
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

// Every point counts alike, as one. Sums of ones are exact: the error is of quotients and products
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

// A quotient of differences of floats, which are exact or off by kUnit of themselves.
double share_within(float a, float b, float c, double t) {
  const auto [low, high] = std::minmax({a, b, c});
  const double least = static_cast<double>(low), most = static_cast<double>(high);
  if (t < least) return 0;
  if (t >= most) return 1;
  const double middle = static_cast<double>(std::max(std::min(a, b), std::min(std::max(a, b), c)));
  const double below = t - least, above = most - t;
  if (t < middle) return below / (middle - least) * (below / (most - least));
  return 1 - above / (most - middle) * (above / (most - least));
}

namespace {

double part_of(const CellStore& cells, const Areas& areas, size_t i) {
  return cells.share(i) * areas.of_face[cells.face(i)];
}

// Shares of all and of nothing are exact.
Enclosure share_of(double least, double most, const Areas& areas) {
  return {std::clamp((least - areas.error) / (areas.whole + areas.error), 0.0, 1.0),
          std::clamp((most + areas.error) / (areas.whole - areas.error), 0.0, 1.0)};
}

}  // namespace

Enclosure mean_over(const CellStore& cells, const Areas& areas,
                    const std::function<Enclosure(size_t)>& of_cell) {
  struct Parts {
    Sum lower, upper;
    double least = 1, most = 0;
    void add(double area_lower, double area_upper, const Enclosure& value) {
      lower.add(area_lower);
      upper.add(area_upper);
      least = std::min(least, value.lower);
      most = std::max(most, value.upper);
    }
  };
  std::vector<Parts> blocks(block_count(cells.count()));
  for_each_block(cells.count(), [&](size_t block, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const double area = part_of(cells, areas, i);
      const Enclosure value = of_cell(i);
      blocks[block].add(area * value.lower, area * value.upper, value);
    }
  });
  Parts all;
  for (const Parts& block : blocks)
    all.add(block.lower.value(), block.upper.value(), {block.least, block.most});
  Enclosure mean = share_of(all.lower.value(), all.upper.value(), areas);
  if (all.least == 1) mean.lower = 1;
  if (all.most == 0) mean.upper = 0;
  return mean;
}

// A share of 1 or 0 is exact, whatever the others are rounded to.
Enclosure share_within(const CellStore& cells, size_t i, const Threshold& at) {
  const gpu::CellBounds& b = cells.bounds(i);
  const auto share = [](const std::array<float, 3>& affine, double all, double t) {
    if (t >= all) return 1.0;
    if (t < static_cast<double>(std::min({affine[0], affine[1], affine[2]}))) return 0.0;
    return std::clamp(share_within(affine[0], affine[1], affine[2], t),
                      std::numeric_limits<double>::min(), 1 - kUnit);
  };
  const double most = static_cast<double>(std::max({b.lower_a, b.lower_b, b.lower_c}));
  return {share({b.upper_a, b.upper_b, b.upper_c}, static_cast<double>(b.highest), at.down),
          share({b.lower_a, b.lower_b, b.lower_c}, most, at.up)};
}

double mean_lower(const gpu::CellBounds& b) {
  const double sum = static_cast<double>(b.lower_a) + static_cast<double>(b.lower_b) +
                     static_cast<double>(b.lower_c);
  const double size = std::abs(static_cast<double>(b.lower_a)) +
                      std::abs(static_cast<double>(b.lower_b)) +
                      std::abs(static_cast<double>(b.lower_c));
  return std::max(sum / 3 - 4 * kUnit * size, 0.0);
}

float least_float_above(double x) {
  const auto near = static_cast<float>(x);
  return static_cast<double>(near) < x
             ? std::nextafter(near, std::numeric_limits<float>::infinity())
             : near;
}

// Scaling by a power of two rounds subnormal results alone, which are far below `displacement`.
Threshold threshold_at(const Frame& frame, double displacement, double distance) {
  const double d = frame.to_frame(distance);
  return {d * (1 - 1e-15) - displacement, d * (1 + 1e-15) + displacement};
}

}  // namespace vkh
