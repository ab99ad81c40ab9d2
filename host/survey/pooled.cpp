#include "host/survey/pooled.h"

#include <algorithm>
#include <limits>

#include "host/survey/figures_asked.h"
#include "host/survey/lengths.h"
#include "vkhausdorff/metrics.h"

namespace vkh {
namespace {

std::vector<Enclosure> pooled_shares(const Distribution& a, const Distribution& b,
                                     const std::vector<double>& ascending) {
  const Enclosure weight = weight_of(a.area(), b.area());
  const std::vector<Enclosure> of_a = a.shares_within(ascending);
  const std::vector<Enclosure> of_b = b.shares_within(ascending);
  std::vector<Enclosure> shares;
  for (size_t i = 0; i < of_a.size(); ++i) shares.push_back(weighted(weight, of_a[i], of_b[i]));
  return shares;
}

// Distances that cut an interval, without its own ends; they ascend.
std::vector<double> cuts_of(const Enclosure& e) {
  constexpr int kSections = 256;
  std::vector<double> cuts;
  for (int k = 1; k < kSections; ++k) {
    const double cut = e.lower + (e.upper - e.lower) * k / kSections;
    if (cut > e.lower && cut < e.upper && (cuts.empty() || cut > cuts.back())) cuts.push_back(cut);
  }
  return cuts;
}

constexpr int kMostRounds = 3;  // 24 bits

}  // namespace

// If less than the share can be within a distance, the distance is below the percentile; if at
// least the share surely is, it is not. A percentage that is typed lies within two ulps of `share`.
Enclosure pooled_percentile(const Distribution& a, const Distribution& b, double share,
                            const Enclosure& known) {
  const double down = share * (1 - 0x1p-52), up = std::min(share * (1 + 0x1p-52), 1.0);
  Enclosure e{known.lower, known.upper};
  double before = std::numeric_limits<double>::infinity();
  // If cuts no longer halve it, the cells' bounds are too wide.
  for (int pass = 0; pass < kMostRounds && 2 * FiguresAsked::width(e) < before; ++pass) {
    before = FiguresAsked::width(e);
    const std::vector<double> cuts = cuts_of(e);
    const std::vector<Enclosure> within = pooled_shares(a, b, cuts);
    for (size_t i = 0; i < cuts.size(); ++i) {
      if (within[i].upper < down) e.lower = cuts[i];
      if (within[i].lower >= up) e.upper = std::min(e.upper, cuts[i]);
    }
  }
  return e;
}

// Uses the margins of one surface's percentile (FiguresAsked::is_gap).
bool is_pooled_jump(const Distribution& a, const Distribution& b, const Enclosure& e,
                    double enough) {
  if (!(e.upper - e.lower > enough)) return false;
  const double beside = 0.4 * enough;
  const std::vector<Enclosure> at = pooled_shares(a, b, {e.lower + beside, e.upper - beside});
  return at[1].upper - at[0].lower <= FiguresAsked::kNearlyNone;
}

bool PooledGoals::is_worth_splits() const {
  constexpr double kSmallPart = 0.25;
  const double enough = std::max(MetricsOptions::kTolerance * known_.lower,
                                 pair_.frame.length_down(least_width(pair_)));
  return FiguresAsked::width(known_) > enough &&
         !is_pooled_jump(own_, *search_.other, known_, enough) &&
         own_.undecided_area(known_) >= kSmallPart * search_.other->undecided_area(known_);
}

bool PooledGoals::look(const Tallied&) {
  known_ = pooled_percentile(own_, *search_.other, search_.share, known_);
  is_open_ = is_worth_splits();
  return false;
}

std::vector<Threshold> PooledGoals::ends() const {
  return {threshold_at(pair_.frame, pair_.displacement, known_.lower),
          threshold_at(pair_.frame, pair_.displacement, known_.upper)};
}

// A cell scores by its undecided area at both ends.
gpu::SurveyPlan PooledGoals::plan(double whole) const {
  gpu::SurveyPlan plan{};
  plan.of_whole = static_cast<float>(1 / whole);
  for (const Threshold& end : ends()) add_open(end, 1, plan);
  return plan;
}

}  // namespace vkh
