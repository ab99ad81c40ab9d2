#include "host/survey/area_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <numeric>

namespace vkh {
namespace {

// Covers an integer of 64 bits as a double, which is off by 2^-53, and the few sums, products and
// quotients of one sign that it goes through.
constexpr double kLess = 1 - 0x1p-49, kMore = 1 + 0x1p-49;

uint64_t whole_of(const gpu::Wide& x) { return uint64_t{x.high} << 32 | x.low; }

// The areas within each edge: of the cells that are entirely within it or an edge before it, and of
// the cells that it cuts.
std::vector<double> areas_within(const gpu::SurveyTable& table, uint32_t whole, uint32_t part,
                                 size_t edges) {
  std::vector<double> areas;
  uint64_t all = 0;
  for (size_t k = 0; k < edges; ++k) {
    all += whole_of(table.sums[whole + k]);
    areas.push_back(static_cast<double>(all + whole_of(table.sums[part + k])));
  }
  return areas;
}

template <class End>
std::vector<size_t> order_of(std::span<const Threshold> thresholds, const End& end) {
  std::vector<size_t> order(thresholds.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t x, size_t y) { return end(thresholds[x]) < end(thresholds[y]); });
  return order;
}

}  // namespace

// An area is rounded down to an integer, and so loses less than one.
AreaWeights weights_of(const Areas& areas) {
  constexpr int kBits = 60;
  AreaWeights weights;
  if (!areas.is_positive()) {
    weights.of_face.assign(areas.of_face.size(), 0);
    return weights;
  }
  const int scale = kBits - std::ilogb(areas.whole);
  weights.of_face.reserve(areas.of_face.size());
  uint64_t whole = 0;
  for (const double area : areas.of_face) {
    weights.of_face.push_back(static_cast<uint64_t>(std::ldexp(area, scale)));
    whole += weights.of_face.back();
  }
  weights.whole = static_cast<double>(whole);
  weights.error = kMore * (std::ldexp(areas.error, scale) +
                           static_cast<double>(areas.of_face.size()) + 0x1p-53 * weights.whole);
  return weights;
}

TallyEdges edges_of(std::span<const Threshold> thresholds) {
  TallyEdges all;
  all.edges.resize(thresholds.size());
  all.of.resize(thresholds.size());
  const std::vector<size_t> downs = order_of(thresholds, [](const Threshold& t) { return t.down; });
  const std::vector<size_t> ups = order_of(thresholds, [](const Threshold& t) { return t.up; });
  for (size_t k = 0; k < thresholds.size(); ++k) {
    all.edges[k] = edge_of({thresholds[downs[k]].down, thresholds[ups[k]].up});
    all.of[downs[k]].down = all.of[ups[k]].up = k;
  }
  return all;
}

gpu::SurveyEdge edge_of(const Threshold& at) {
  return {-least_float_above(-std::min(at.down, kAnyDistance)),
          least_float_above(std::min(at.up, kAnyDistance))};
}

gpu::SurveyPlan plan_of(const TallyEdges& at, const Tally& asked) {
  gpu::SurveyPlan plan{};
  plan.edge_count = static_cast<uint32_t>(at.edges.size());
  std::copy(at.edges.begin(), at.edges.end(), std::begin(plan.edges));
  plan.classes = asked.classes;
  plan.far = asked.far;
  plan.moments = asked.moments ? 1 : 0;
  plan.of_normals = asked.of_normals ? 1 : 0;
  if (asked.moments) plan.most = edge_of(*asked.moments);
  return plan;
}

void add_table(const gpu::SurveyTable& table, gpu::SurveyTable& sum) {
  for (size_t k = 0; k < gpu::kSurveySums; ++k) {
    const uint64_t both = whole_of(sum.sums[k]) + whole_of(table.sums[k]);
    sum.sums[k] = {static_cast<uint32_t>(both), static_cast<uint32_t>(both >> 32)};
  }
  sum.highest = std::max(sum.highest, table.highest);
  sum.not_lowest = std::max(sum.not_lowest, table.not_lowest);
  sum.reached = std::max(sum.reached, table.reached);
  sum.not_far = std::max(sum.not_far, table.not_far);
}

// A square that is rounded up has 2^-60 added (round_up in certified.h), and must be below the
// unit's: so the unit is 2^-29 at least.
int tally_unit(float farthest) { return std::ilogb(std::max(farthest, 0x1p-30f)) + 1 + 127; }

AreaTable::AreaTable(const gpu::SurveyTable& table, const TallyEdges& at,
                     const AreaWeights& weights, int unit)
    : table_(table),
      at_(at),
      weights_(weights),
      unit_(std::ldexp(1.0, unit - 127)),
      surely_(areas_within(table, gpu::kSurelyWhole, gpu::kSurelyPart, at.edges.size())),
      perhaps_(areas_within(table, gpu::kPerhapsWhole, gpu::kPerhapsPart, at.edges.size())) {}

double AreaTable::lowest() const {
  return static_cast<double>(std::bit_cast<float>(~table_.not_lowest));
}
double AreaTable::highest() const {
  return static_cast<double>(std::bit_cast<float>(table_.highest));
}

// Shares of all and of nothing are exact; of all only if all cells count.
Enclosure AreaTable::share(const TallyEdges::Places& at, bool are_all) const {
  const auto& [of_face, whole, error] = weights_;
  const double least = kLess * surely_[at.down] - error, most = kMore * perhaps_[at.up] + error;
  Enclosure e{std::clamp(kLess * (least / (whole + error)), 0.0, 1.0),
              std::clamp(kMore * (most / (whole - error)), 0.0, 1.0)};
  if (are_all && static_cast<double>(at_.edges[at.down].down) >= highest()) e.lower = 1;
  if (static_cast<double>(at_.edges[at.up].up) < lowest()) e.upper = 0;
  return e;
}

// A cell that counts leaves the complement of its lowest, which is no NaN.
void AreaTable::answer(const Tally& asked, Tallied& all) const {
  all.is_empty = table_.not_lowest == 0;
  const bool are_all = asked.classes == gpu::kAllClasses;
  for (const TallyEdges::Places& at : at_.of)
    all.shares.push_back(all.is_empty ? Enclosure{} : share(at, are_all));
  if (asked.of_normals) {
    all.moments = moments(1);
    all.moments.mean.upper = std::min(all.moments.mean.upper, 1.0);
  } else if (asked.moments) {
    all.moments = moments(std::min(highest(), std::max(asked.moments->up, 0.0)));
  }
  if (all.is_empty) return;
  all.lowest = lowest();
  all.highest = highest();
  all.reached = std::bit_cast<float>(table_.reached);
  if (table_.not_far != 0) all.far = ~table_.not_far;
}

// A mean in the sum's unit of values up to `largest`, which the areas' error weighs at most.
double AreaTable::mean_down(uint32_t sum, double largest) const {
  const double least =
      kLess * static_cast<double>(whole_of(table_.sums[sum])) - kMore * weights_.error * largest;
  return std::max(kLess * (least / (weights_.whole + weights_.error)), 0.0);
}
double AreaTable::mean_up(uint32_t sum, double largest) const {
  const double most =
      kMore * (static_cast<double>(whole_of(table_.sums[sum])) + weights_.error * largest);
  return kMore * (most / (weights_.whole - weights_.error));
}

// No value that counts is above `most`; one may count on as much area as the areas are off by.
Moments AreaTable::moments(double most) const {
  const double largest = most / unit_, square = largest * largest;
  return {{unit_ * mean_down(gpu::kMeanLower, largest), unit_ * mean_up(gpu::kMeanUpper, largest)},
          {unit_ * kLess * std::sqrt(mean_down(gpu::kSquareLower, square)),
           unit_ * kMore * std::sqrt(mean_up(gpu::kSquareUpper, square))}};
}

}  // namespace vkh
