#include "host/survey/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <numeric>

#include "host/base/parallel.h"
#include "host/base/rounding.h"

namespace vkh {
namespace {

constexpr double kUnit = 0x1p-53;  // a rounding, relative

// A sum of numbers that are not negative, off by less than 4 kUnit of itself: what each addition
// loses is added up, too (Neumaier 1974). Sums are of blocks, and of these: 8.
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
double length_of(const glm::dvec3& v) { return std::hypot(v.x, v.y, v.z); }

// Half of |e x f|. Differences are off by kUnit of themselves, a component of the product by 4
// kUnit of its parts, so the vector by less than 16 |e| |f| kUnit, and its length by 4 of itself.
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

}  // namespace

Areas areas_of(const Mesh& a) {
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

// Both ascend, and are as many.
struct Thresholds {
  std::span<const double> surely, perhaps;
};

// The areas that are surely, and perhaps, within each of some distances that ascend.
struct Within {
  explicit Within(size_t count) : surely(count), perhaps(count) {}
  std::vector<Sum> surely, perhaps;
};

// Adds a part to what is within each: nothing, a share of it, or all of it from some distance on.
class Adder {
 public:
  Adder(std::span<const double> at, std::vector<Sum>& sums)
      : at_(at), sums_(sums), whole_(at.size() + 1) {}

  // `at_corners`: values of an affine function. From `most` on, the whole part is within.
  void add(double area, const std::array<float, 3>& at_corners, float most) {
    const auto [a, b, c] = at_corners;
    const auto least = static_cast<double>(std::min({a, b, c}));
    auto k = std::lower_bound(at_.begin(), at_.end(), least) - at_.begin();
    for (; k < std::ssize(at_) && at_[static_cast<size_t>(k)] < static_cast<double>(most); ++k) {
      const auto i = static_cast<size_t>(k);
      sums_[i].add(area * share_within(a, b, c, at_[i]));
    }
    whole_[static_cast<size_t>(k)].add(area);
  }

  void finish() {
    Sum all;
    for (size_t i = 0; i < sums_.size(); ++i) {
      all.add(whole_[i].value());
      sums_[i].add(all.value());
    }
  }

 private:
  std::span<const double> at_;
  std::vector<Sum>& sums_;
  std::vector<Sum> whole_;  // area that is all within from this distance on
};

double part_of(const CellStore& cells, const Areas& areas, size_t i) {
  return cells.share(i) * areas.of_face[cells.face(i)];
}

Within block_within(const CellStore& cells, const Areas& areas, const Thresholds& at, size_t begin,
                    size_t end) {
  Within within(at.surely.size());
  Adder from_below(at.surely, within.surely), from_above(at.perhaps, within.perhaps);
  for (size_t i = begin; i < end; ++i) {
    const gpu::CellBounds& b = cells.bounds(i);
    const double area = part_of(cells, areas, i);
    const float most = std::max({b.lower_a, b.lower_b, b.lower_c});
    from_below.add(area, {b.upper_a, b.upper_b, b.upper_c}, b.highest);
    from_above.add(area, {b.lower_a, b.lower_b, b.lower_c}, most);
  }
  from_below.finish();
  from_above.finish();
  return within;
}

Within areas_within(const CellStore& cells, const Areas& areas, const Thresholds& at) {
  std::vector<Within> blocks(block_count(cells.count()), Within(0));
  for_each_block(cells.count(), [&](size_t block, size_t begin, size_t end) {
    blocks[block] = block_within(cells, areas, at, begin, end);
  });
  Within all(at.surely.size());
  for (const Within& block : blocks) {
    for (size_t k = 0; k < at.surely.size(); ++k) {
      all.surely[k].add(block.surely[k].value());
      all.perhaps[k].add(block.perhaps[k].value());
    }
  }
  return all;
}

struct Extremes {
  double lowest = 3e38, highest = 0;
};
Extremes extremes_of(const CellStore& cells) {
  std::vector<Extremes> blocks(block_count(cells.count()));
  for_each_block(cells.count(), [&](size_t block, size_t begin, size_t end) {
    Extremes& e = blocks[block];
    for (size_t i = begin; i < end; ++i) {
      e.lowest = std::min(e.lowest, static_cast<double>(lowest(cells.bounds(i))));
      e.highest = std::max(e.highest, static_cast<double>(cells.bounds(i).highest));
    }
  });
  Extremes all;
  for (const Extremes& e : blocks) {
    all.lowest = std::min(all.lowest, e.lowest);
    all.highest = std::max(all.highest, e.highest);
  }
  return all;
}

// Shares of all and of nothing are exact.
Enclosure share_of(double least, double most, const Areas& areas) {
  return {std::clamp((least - areas.error) / (areas.whole + areas.error), 0.0, 1.0),
          std::clamp((most + areas.error) / (areas.whole - areas.error), 0.0, 1.0)};
}

}  // namespace

std::vector<Enclosure> shares_within(const CellStore& cells, const Areas& areas,
                                     std::span<const Threshold> thresholds) {
  std::vector<size_t> order(thresholds.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(),
            [&](size_t x, size_t y) { return thresholds[x].down < thresholds[y].down; });
  std::vector<double> down, up;
  for (const size_t i : order) {
    down.push_back(thresholds[i].down);
    up.push_back(thresholds[i].up);
  }
  std::sort(up.begin(), up.end());  // in the same order: they are apart by as much
  const Within within = areas_within(cells, areas, {down, up});
  const Extremes extremes = extremes_of(cells);
  std::vector<Enclosure> shares(thresholds.size());
  for (size_t k = 0; k < order.size(); ++k) {
    Enclosure& share = shares[order[k]];
    share = share_of(within.surely[k].value(), within.perhaps[k].value(), areas);
    if (down[k] >= extremes.highest) share.lower = 1;
    if (up[k] < extremes.lowest) share.upper = 0;
  }
  return shares;
}

namespace {

constexpr size_t kSections = 32;
constexpr int kPasses = 4;

// The bracket of a reached share: `perhaps` at `down`, `surely` at `up`; each bracket gets
// narrower.
struct Bracket {
  double low, high;
  std::vector<double> cuts() const {
    std::vector<double> at;
    for (size_t k = 1; k < kSections; ++k)
      at.push_back(low + (high - low) * static_cast<double>(k) / kSections);
    return at;
  }
};

// Narrows each bracket to the section in which `reaches(sum)` becomes true.
template <class Reaches>
void narrow(std::vector<Bracket>& brackets, const std::vector<Sum>& sums,
            const std::vector<double>& at, const Reaches& reaches) {
  for (size_t b = 0; b < brackets.size(); ++b) {
    Bracket& bracket = brackets[b];
    const double low = bracket.low, high = bracket.high;
    for (size_t k = 0; k < at.size(); ++k) {
      if (!(at[k] > low) || !(at[k] < high)) continue;
      if (reaches(b, sums[k].value())) {
        bracket.high = std::min(bracket.high, at[k]);
      } else {
        bracket.low = std::max(bracket.low, at[k]);
      }
    }
  }
}

std::vector<double> cuts_of(const std::vector<Bracket>& brackets) {
  std::vector<double> at;
  for (const Bracket& b : brackets) {
    const std::vector<double> cuts = b.cuts();
    at.insert(at.end(), cuts.begin(), cuts.end());
  }
  std::sort(at.begin(), at.end());
  return at;
}

}  // namespace

// A share is not reached below `low` of a bracket: so much that may be within is too little. At
// `high` it is: so much is surely within.
std::vector<Enclosure> percentiles(const CellStore& cells, const Areas& areas,
                                   std::span<const double> shares) {
  const Extremes e = extremes_of(cells);
  std::vector<Bracket> lower(shares.size(), {e.lowest, e.highest});
  std::vector<Bracket> upper = lower;
  const double slack = 2 * areas.error;
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::vector<double> below = cuts_of(lower), above = cuts_of(upper);
    const Within within = areas_within(cells, areas, {above, below});
    narrow(lower, within.perhaps, below,
           [&](size_t b, double area) { return area >= shares[b] * areas.whole - slack; });
    narrow(upper, within.surely, above,
           [&](size_t b, double area) { return area >= shares[b] * areas.whole + slack; });
  }
  std::vector<Enclosure> all;
  for (size_t i = 0; i < shares.size(); ++i) all.push_back({lower[i].low, upper[i].high});
  return all;
}

namespace {

// Divide a weighted sum of numbers up to `largest` by the area, rounding down and up. Each of fewer
// than 2^40 parts may have underflowed, by 2^-1073, but for those of zeros alone.
double mean_down(const Sum& sum, double largest, const Areas& areas) {
  const double least = sum.value() * (1 - kSumError) - areas.error * largest;
  return std::max(least / (areas.whole + areas.error) * (1 - 4 * kUnit), 0.0);
}
double mean_up(const Sum& sum, double largest, const Areas& areas) {
  const double lost = largest > 0 ? 0x1p-1030 : 0;
  const double most = sum.value() * (1 + kSumError) + areas.error * largest + lost;
  return most / (areas.whole - areas.error) * (1 + 4 * kUnit);
}

}  // namespace

double mean_lower(const gpu::CellBounds& b) {
  const double sum = static_cast<double>(b.lower_a) + static_cast<double>(b.lower_b) +
                     static_cast<double>(b.lower_c);
  const double size = std::abs(static_cast<double>(b.lower_a)) +
                      std::abs(static_cast<double>(b.lower_b)) +
                      std::abs(static_cast<double>(b.lower_c));
  return std::max(sum / 3 - 4 * kUnit * size, 0.0);
}

namespace {

struct Sums {
  Sum lower, upper, square_lower, square_upper;
  double largest = 0;

  void add(const gpu::CellBounds& b, double area) {
    const double down = mean_lower(b), up = static_cast<double>(b.mean_upper);
    const auto highest = static_cast<double>(b.highest);
    lower.add(area * down);
    upper.add(area * up);
    square_lower.add(area * down * down);
    square_upper.add(area * std::min(static_cast<double>(b.square_upper), highest * up));
    largest = std::max(largest, highest);
  }
  void add(const Sums& other) {
    lower.add(other.lower.value());
    upper.add(other.upper.value());
    square_lower.add(other.square_lower.value());
    square_upper.add(other.square_upper.value());
    largest = std::max(largest, other.largest);
  }
};

Sums sums_of(const CellStore& cells, const Areas& areas) {
  std::vector<Sums> blocks(block_count(cells.count()));
  for_each_block(cells.count(), [&](size_t block, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      blocks[block].add(cells.bounds(i), part_of(cells, areas, i));
  });
  Sums all;
  for (const Sums& block : blocks) all.add(block);
  return all;
}

}  // namespace

Moments moments_of(const CellStore& cells, const Areas& areas) {
  const Sums sums = sums_of(cells, areas);
  const double square = sums.largest * sums.largest;
  const double rms_down = std::sqrt(mean_down(sums.square_lower, square, areas)) * (1 - 2 * kUnit);
  const double rms_up = std::sqrt(mean_up(sums.square_upper, square, areas)) * (1 + 2 * kUnit);
  return {{mean_down(sums.lower, sums.largest, areas), mean_up(sums.upper, sums.largest, areas)},
          {rms_down, rms_up}};
}

}  // namespace vkh
