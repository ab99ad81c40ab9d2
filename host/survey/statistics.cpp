#include "host/survey/statistics.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <numeric>

#include "host/base/hypot3.h"
#include "host/base/parallel.h"
#include "host/base/rounding.h"
#include "shaders/math/parts.h"

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

// Both ascend, and are as many.
struct Thresholds {
  std::span<const double> surely, perhaps;
};

// The areas that are surely, and perhaps, within each of some distances that ascend.
struct Within {
  explicit Within(size_t count) : surely(count), perhaps(count) {}
  std::vector<Sum> surely, perhaps;
};

// An affine function over a cell by its values at the corners: at t, the part of the cell on which
// it is at most t is within, and from `most` on the whole cell is.
struct Slope {
  float a, b, c, most;
  /// Nothing of the cell is within less, whatever the function says.
  float floor = -std::numeric_limits<float>::infinity();
  /// The whole cell is within this, although the function's values may all be above it.
  float ceiling = std::numeric_limits<float>::infinity();
  double least() const {
    return static_cast<double>(std::max(std::min({a, b, c, ceiling}), floor));
  }
  double share(double t) const {
    return t < static_cast<double>(floor) ? 0 : share_within(a, b, c, t);
  }
};

// Cells, and what is counted on them: distances, where there are no sides; otherwise signed ones,
// which are the distances over B, less than none under it, and of either sign where there is no
// side.
struct Counted {
  const CellStore& cells;
  std::span<const CellSide> sides = {};

  size_t count() const { return cells.count(); }
  const gpu::CellBounds& bounds(size_t i) const { return cells.bounds(i); }
  SurfaceSide side(size_t i) const { return sides.empty() ? SurfaceSide::kOver : sides[i].side; }
};

// Under B all is within -lowest(), even where bounds from below at the corners are negative.
Slope surely_within(const Counted& counted, size_t i) {
  const gpu::CellBounds& b = counted.bounds(i);
  constexpr float kNone = -std::numeric_limits<float>::infinity();
  if (counted.side(i) == SurfaceSide::kUnder)
    return {-b.lower_a, -b.lower_b, -b.lower_c, -lowest(b), kNone, -lowest(b)};
  if (counted.sides.empty()) return {b.upper_a, b.upper_b, b.upper_c, b.highest};
  return {b.upper_a, b.upper_b, b.upper_c, b.highest, kNone, b.highest};
}
Slope perhaps_within(const Counted& counted, size_t i) {
  const gpu::CellBounds& b = counted.bounds(i);
  if (counted.side(i) != SurfaceSide::kOver)
    return {-b.upper_a, -b.upper_b, -b.upper_c, -std::min({b.upper_a, b.upper_b, b.upper_c}),
            -b.highest};
  const Slope slope{b.lower_a, b.lower_b, b.lower_c, std::max({b.lower_a, b.lower_b, b.lower_c})};
  if (counted.sides.empty()) return slope;
  return {slope.a, slope.b, slope.c, std::max(slope.most, 0.0f), 0.0f};
}

// Adds a part to what is within each: nothing, a share of it, or all of it from some distance on.
class Adder {
 public:
  Adder(std::span<const double> at, std::vector<Sum>& sums)
      : at_(at), sums_(sums), whole_(at.size() + 1) {}

  void add(double area, const Slope& slope) {
    auto k = std::lower_bound(at_.begin(), at_.end(), slope.least()) - at_.begin();
    const auto most = static_cast<double>(slope.most);
    for (; k < std::ssize(at_) && at_[static_cast<size_t>(k)] < most; ++k) {
      const auto i = static_cast<size_t>(k);
      sums_[i].add(area * slope.share(at_[i]));
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

Within block_within(const Counted& counted, const Areas& areas, const Thresholds& at, size_t begin,
                    size_t end) {
  Within within(at.surely.size());
  Adder from_below(at.surely, within.surely), from_above(at.perhaps, within.perhaps);
  for (size_t i = begin; i < end; ++i) {
    const double area = part_of(counted.cells, areas, i);
    from_below.add(area, surely_within(counted, i));
    from_above.add(area, perhaps_within(counted, i));
  }
  from_below.finish();
  from_above.finish();
  return within;
}

Within areas_within(const Counted& counted, const Areas& areas, const Thresholds& at) {
  std::vector<Within> blocks(block_count(counted.count()), Within(0));
  for_each_block(counted.count(), [&](size_t block, size_t begin, size_t end) {
    blocks[block] = block_within(counted, areas, at, begin, end);
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
Extremes extremes_of(const Counted& counted) {
  std::vector<Extremes> blocks(block_count(counted.count()));
  for_each_block(counted.count(), [&](size_t block, size_t begin, size_t end) {
    Extremes& e = blocks[block];
    for (size_t i = begin; i < end; ++i) {
      e.lowest = std::min(e.lowest, static_cast<double>(lowest(counted.bounds(i))));
      e.highest = std::max(e.highest, static_cast<double>(counted.bounds(i).highest));
    }
  });
  Extremes all;
  for (const Extremes& e : blocks) {
    all.lowest = std::min(all.lowest, e.lowest);
    all.highest = std::max(all.highest, e.highest);
  }
  if (!counted.sides.empty()) all.lowest = -all.highest;
  return all;
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
  const auto share = [](const Slope& slope, double t) {
    if (t < slope.least()) return 0.0;
    if (t >= static_cast<double>(slope.most)) return 1.0;
    return std::clamp(slope.share(t), std::numeric_limits<double>::min(), 1 - kUnit);
  };
  return {share(surely_within({cells}, i), at.down), share(perhaps_within({cells}, i), at.up)};
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
  const Within within = areas_within({cells}, areas, {down, up});
  const Extremes extremes = extremes_of({cells});
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

// For a cell that a bracket cuts each section of a pass costs two divisions: 8 of them twice are
// fewer than 64 once. All cells are looked at for the first ones.
constexpr size_t kFirstSections = 32, kSections = 8;

// The bracket of a reached share: `perhaps` at `low`, `surely` at `high`; each bracket gets
// narrower.
struct Bracket {
  double low, high;

  // The ends of sections, without the bracket's own; they ascend.
  std::vector<double> cuts(size_t sections) const {
    std::vector<double> at;
    for (size_t k = 1; k < sections; ++k)
      at.push_back(low + (high - low) * static_cast<double>(k) / static_cast<double>(sections));
    return at;
  }

  // Narrows to the section in which `reaches(sum)` becomes true.
  template <class Reaches>
  void narrow(const std::vector<double>& at, const std::vector<Sum>& sums, const Reaches& reaches) {
    const double first = low, last = high;
    for (size_t k = 0; k < at.size(); ++k) {
      if (!(at[k] > first) || !(at[k] < last)) continue;
      double& end = reaches(sums[k].value()) ? high : low;
      end = reaches(sums[k].value()) ? std::min(high, at[k]) : std::max(low, at[k]);
    }
  }
};

// The area within the cuts of some brackets. Cells that are to one side of a bracket, which only
// gets narrower, are looked at once for it. `slope_of`: surely_within or perhaps_within.
template <Slope (*slope_of)(const Counted&, size_t)>
class BracketSums {
 public:
  BracketSums(const Counted& counted, const Areas& areas)
      : counted_(counted), areas_(areas), blocks_(block_count(counted.count())) {}

  // The sums at each bracket's cuts: the brackets are as many as before, and within those.
  std::vector<std::vector<Sum>> at(const std::vector<Bracket>& brackets) {
    std::vector<std::vector<std::vector<Sum>>> sums(blocks_.size());
    for_each_block(counted_.count(), [&](size_t block, size_t begin, size_t end) {
      std::vector<Part>& parts = blocks_[block];
      if (parts.empty()) look_at_all(parts, brackets, begin, end);
      for (size_t b = 0; b < brackets.size(); ++b)
        sums[block].push_back(sums_of(parts[b], brackets[b], begin));
    });
    std::vector<std::vector<Sum>> all(brackets.size(), std::vector<Sum>(kSections - 1));
    for (const auto& block : sums) {
      for (size_t b = 0; b < all.size(); ++b) {
        for (size_t k = 0; k < all[b].size(); ++k) all[b][k].add(block[b][k].value());
      }
    }
    return all;
  }

 private:
  // A block's cells as a bracket sees them.
  struct Part {
    Sum whole;                   // area of the cells that are all within `low`
    std::vector<uint16_t> open;  // offsets in the block of the cells that the bracket cuts
  };
  static_assert(kBlock <= size_t{1} << 16);

  // Returns whether the bracket cuts the cell; otherwise it is done with.
  static bool is_open(const Slope& slope, double area, const Bracket& bracket, Sum& whole) {
    if (slope.least() >= bracket.high) return false;
    if (static_cast<double>(slope.most) > bracket.low) return true;
    whole.add(area);
    return false;
  }

  void look_at_all(std::vector<Part>& parts, const std::vector<Bracket>& brackets, size_t begin,
                   size_t end) const {
    parts.resize(brackets.size());
    for (size_t i = begin; i < end; ++i) {
      const Slope slope = slope_of(counted_, i);
      const double area = part_of(counted_.cells, areas_, i);
      for (size_t b = 0; b < parts.size(); ++b) {
        if (is_open(slope, area, brackets[b], parts[b].whole))
          parts[b].open.push_back(static_cast<uint16_t>(i - begin));
      }
    }
  }

  std::vector<Sum> sums_of(Part& part, const Bracket& bracket, size_t begin) const {
    const std::vector<double> cuts = bracket.cuts(kSections);
    std::vector<Sum> sums(cuts.size());
    std::erase_if(part.open, [&](uint16_t offset) {
      const Slope slope = slope_of(counted_, begin + offset);
      const double area = part_of(counted_.cells, areas_, begin + offset);
      if (!is_open(slope, area, bracket, part.whole)) return true;
      add(slope, area, cuts, sums);
      return false;
    });
    for (Sum& sum : sums) sum.add(part.whole.value());
    return sums;
  }

  static void add(const Slope& slope, double area, const std::vector<double>& cuts,
                  std::vector<Sum>& sums) {
    for (size_t k = 0; k < cuts.size(); ++k) {
      if (cuts[k] < slope.least()) continue;
      sums[k].add(cuts[k] < static_cast<double>(slope.most) ? area * slope.share(cuts[k]) : area);
    }
  }

  const Counted counted_;
  const Areas& areas_;
  std::vector<std::vector<Part>> blocks_;
};

constexpr int kMostPasses = 20;  // 60 bits

// Narrows each bracket to a section of the given width. `reaches(b, area)`: whether the share of
// bracket b is reached.
template <class Sums, class Reaches>
void narrow(std::vector<Bracket>& brackets, double to, Sums sums, const Reaches& reaches) {
  const auto is_wide = [&](const Bracket& bracket) { return bracket.high - bracket.low > to; };
  for (int pass = 0; pass < kMostPasses && std::ranges::any_of(brackets, is_wide); ++pass) {
    const std::vector<std::vector<Sum>> at = sums.at(brackets);
    for (size_t b = 0; b < brackets.size(); ++b) {
      brackets[b].narrow(brackets[b].cuts(kSections), at[b],
                         [&](double area) { return reaches(b, area); });
    }
  }
}

}  // namespace

namespace {

// The brackets of percentiles: of the bounds from below, and from above.
struct Brackets {
  std::vector<Bracket> lower, upper;
};

// A share is not reached below `low` of a bracket: so much that may be within is too little. At
// `high` it is: so much is surely within.
class Reached {
 public:
  Reached(const Areas& areas, std::span<const double> shares) : areas_(areas), shares_(shares) {}
  bool perhaps(size_t b, double area) const { return area >= shares_[b] * areas_.whole - slack_; }
  bool surely(size_t b, double area) const { return area >= shares_[b] * areas_.whole + slack_; }

 private:
  const Areas& areas_;
  const std::span<const double> shares_;
  const double slack_ = 2 * areas_.error;
};

// All cells are looked at once for all shares.
Brackets first_brackets(const Counted& counted, const Areas& areas, const Reached& reached,
                        size_t count) {
  const Extremes e = extremes_of(counted);
  const std::vector<Bracket> whole(count, {e.lowest, e.highest});
  const std::vector<double> cuts = whole[0].cuts(kFirstSections);
  const Within within = areas_within(counted, areas, {cuts, cuts});
  Brackets all{whole, whole};
  for (size_t b = 0; b < count; ++b) {
    all.lower[b].narrow(cuts, within.perhaps,
                        [&](double area) { return reached.perhaps(b, area); });
    all.upper[b].narrow(cuts, within.surely, [&](double area) { return reached.surely(b, area); });
  }
  return all;
}

Brackets brackets_of(std::span<const Enclosure> known) {
  Brackets all;
  for (const Enclosure& e : known) all.lower.push_back({e.lower, e.upper});
  all.upper = all.lower;
  return all;
}

std::vector<Enclosure> percentiles_of(const Counted& counted, const Areas& areas,
                                      const PercentileSearch& search) {
  const auto& [shares, resolution, known] = search;
  if (shares.empty()) return {};
  const Reached reached(areas, shares);
  Brackets at =
      known.empty() ? first_brackets(counted, areas, reached, shares.size()) : brackets_of(known);
  narrow(at.lower, resolution, BracketSums<perhaps_within>(counted, areas),
         [&](size_t b, double area) { return reached.perhaps(b, area); });
  narrow(at.upper, resolution, BracketSums<surely_within>(counted, areas),
         [&](size_t b, double area) { return reached.surely(b, area); });
  std::vector<Enclosure> all;
  for (size_t b = 0; b < shares.size(); ++b) all.push_back({at.lower[b].low, at.upper[b].high});
  return all;
}

}  // namespace

std::vector<Enclosure> percentiles(const CellStore& cells, const Areas& areas,
                                   const PercentileSearch& search) {
  return percentiles_of({cells}, areas, search);
}

std::vector<Enclosure> signed_percentiles(const CellStore& cells, std::span<const CellSide> sides,
                                          const Areas& areas, const PercentileSearch& search) {
  return percentiles_of({cells, sides}, areas, search);
}

double undecided_share(const CellStore& cells, std::span<const CellSide> sides, size_t i,
                       const Threshold& at) {
  const Counted counted{cells, sides};
  const auto share = [](const Slope& slope, double t) {
    if (t < slope.least()) return 0.0;
    return t >= static_cast<double>(slope.most) ? 1.0 : slope.share(t);
  };
  return std::max(
      share(perhaps_within(counted, i), at.up) - share(surely_within(counted, i), at.down), 0.0);
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

  // From below both are those of the positive part of `lower`, as a device's tally has them.
  void add(const gpu::CellBounds& b, double area) {
    const lib::vec3 at(b.lower_a, b.lower_b, b.lower_c);
    const double down = std::max(mean_lower(b), static_cast<double>(lib::mean_over_down(at)));
    const double squares = static_cast<double>(lib::square_over_down(at));
    const auto up = static_cast<double>(b.mean_upper), highest = static_cast<double>(b.highest);
    lower.add(area * down);
    upper.add(area * up);
    square_lower.add(area * std::max(down * down * (1 - 2 * kUnit), squares));
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

// Bounds the integrals over the part of a cell that is within `most`: all of a cell that surely is,
// nothing of one that surely is not. Of one that may be, nothing is known from below, and from
// above no distance that counts exceeds `most`.
gpu::CellBounds within_most(const Threshold& most, gpu::CellBounds b) {
  if (static_cast<double>(b.highest) <= most.down) return b;
  const double cap = static_cast<double>(lowest(b)) > most.up ? 0 : most.up;
  const float up = least_float_above(std::max(cap, 0.0));
  b.lower_a = b.lower_b = b.lower_c = 0;
  b.mean_upper = std::min(b.mean_upper, up);
  b.highest = std::min(b.highest, up);
  b.square_upper =
      std::min(b.square_upper, least_float_above(std::max(cap, 0.0) * cap * (1 + 4 * kUnit)));
  return b;
}

Sums sums_of(const CellStore& cells, const Areas& areas, const Threshold& most) {
  std::vector<Sums> blocks(block_count(cells.count()));
  for_each_block(cells.count(), [&](size_t block, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      blocks[block].add(within_most(most, cells.bounds(i)), part_of(cells, areas, i));
  });
  Sums all;
  for (const Sums& block : blocks) all.add(block);
  return all;
}

}  // namespace

Moments moments_of(const CellStore& cells, const Areas& areas, const Threshold& most) {
  const Sums sums = sums_of(cells, areas, most);
  const double square = sums.largest * sums.largest;
  const double rms_down = std::sqrt(mean_down(sums.square_lower, square, areas)) * (1 - 2 * kUnit);
  const double rms_up = std::sqrt(mean_up(sums.square_upper, square, areas)) * (1 + 2 * kUnit);
  return {{mean_down(sums.lower, sums.largest, areas), mean_up(sums.upper, sums.largest, areas)},
          {rms_down, rms_up}};
}

namespace {

// Sums over the parts of A: of the positive part of the signed distance and of its negative part,
// each from below and above, since what a sum loses is a share of what is added without signs.
struct SignedSums {
  Sum over_lower, over_upper, under_lower, under_upper;
  double largest = 0;

  void add(const gpu::CellBounds& b, SurfaceSide side, double area) {
    const double down = mean_lower(b), up = static_cast<double>(b.mean_upper);
    if (side == SurfaceSide::kOver) over_lower.add(area * down);
    if (side == SurfaceSide::kUnder) under_lower.add(area * down);
    if (side != SurfaceSide::kUnder) over_upper.add(area * up);
    if (side != SurfaceSide::kOver) under_upper.add(area * up);
    largest = std::max(largest, static_cast<double>(b.highest));
  }
  void add(const SignedSums& other) {
    over_lower.add(other.over_lower.value());
    over_upper.add(other.over_upper.value());
    under_lower.add(other.under_lower.value());
    under_upper.add(other.under_upper.value());
    largest = std::max(largest, other.largest);
  }
};

}  // namespace

// The positive and the negative part are means over all of A, each of which is not negative, and
// their difference rounds by kUnit of itself.
Enclosure signed_mean(const CellStore& cells, std::span<const CellSide> sides, const Areas& areas) {
  std::vector<SignedSums> blocks(block_count(cells.count()));
  for_each_block(cells.count(), [&](size_t block, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      blocks[block].add(cells.bounds(i), sides[i].side, part_of(cells, areas, i));
  });
  SignedSums all;
  for (const SignedSums& block : blocks) all.add(block);
  return {add_down(mean_down(all.over_lower, all.largest, areas),
                   -mean_up(all.under_upper, all.largest, areas)),
          add_up(mean_up(all.over_upper, all.largest, areas),
                 -mean_down(all.under_lower, all.largest, areas))};
}

std::array<Enclosure, kDoubts + 2> shares_of_sides(const CellStore& cells,
                                                   std::span<const CellSide> sides,
                                                   const Areas& areas) {
  std::array<Sum, kDoubts + 2> sums;
  for (size_t i = 0; i < cells.count(); ++i) {
    const CellSide& side = sides[i];
    const size_t kind = side.side == SurfaceSide::kOver    ? kDoubts
                        : side.side == SurfaceSide::kUnder ? kDoubts + 1
                                                           : static_cast<size_t>(side.doubt);
    sums[kind].add(part_of(cells, areas, i));
  }
  std::array<Enclosure, kDoubts + 2> shares;
  for (size_t k = 0; k < sums.size(); ++k) {
    const double sum = sums[k].value();
    if (sum > 0) shares[k] = share_of(sum * (1 - kSumError), sum * (1 + kSumError), areas);
  }
  return shares;
}

}  // namespace vkh
