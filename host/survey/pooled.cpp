#include "host/survey/pooled.h"

#include <algorithm>
#include <memory>

#include "host/survey/figures_asked.h"
#include "vkhausdorff/metrics.h"

namespace vkh {
namespace {

std::vector<Enclosure> pooled_shares(const PooledPart& a, const PooledPart& b,
                                     const std::vector<double>& ascending) {
  const Enclosure weight = weight_of(a.area, b.area);
  const std::vector<Enclosure> of_a = a.shares(ascending), of_b = b.shares(ascending);
  std::vector<Enclosure> shares;
  for (size_t i = 0; i < of_a.size(); ++i) shares.push_back(weighted(weight, of_a[i], of_b[i]));
  return shares;
}

// Distances that cut an interval, without its own ends; they ascend.
std::vector<double> cuts_of(const Enclosure& e) {
  constexpr int kSections = 32;
  std::vector<double> cuts;
  for (int k = 1; k < kSections; ++k) {
    const double cut = e.lower + (e.upper - e.lower) * k / kSections;
    if (cut > e.lower && cut < e.upper && (cuts.empty() || cut > cuts.back())) cuts.push_back(cut);
  }
  return cuts;
}

constexpr int kPasses = 4;  // 20 bits

}  // namespace

PooledPart part_of(const Distribution& distribution) {
  return {[&distribution](const std::vector<double>& ascending) {
            return distribution.shares_within(ascending);
          },
          distribution.area()};
}

// A distance at which less than the share may be within is below the percentile; one at which it
// surely is within is not. A percentage that is typed lies within two ulps of `share`.
Enclosure pooled_percentile(const PooledPart& a, const PooledPart& b, double share,
                            const Enclosure& known) {
  const double down = share * (1 - 0x1p-52), up = std::min(share * (1 + 0x1p-52), 1.0);
  Enclosure e{known.lower, known.upper};
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::vector<double> cuts = cuts_of(e);
    const std::vector<Enclosure> within = pooled_shares(a, b, cuts);
    for (size_t i = 0; i < cuts.size(); ++i) {
      if (within[i].upper < down) e.lower = cuts[i];
      if (within[i].lower >= up) e.upper = std::min(e.upper, cuts[i]);
    }
  }
  return e;
}

// The same margins as those of one surface's percentile (FiguresAsked::is_gap).
bool is_pooled_jump(const PooledPart& a, const PooledPart& b, const Enclosure& e, double enough) {
  if (!(e.upper - e.lower > enough)) return false;
  const double beside = 0.4 * enough;
  const std::vector<Enclosure> at = pooled_shares(a, b, {e.lower + beside, e.upper - beside});
  return at[1].upper - at[0].lower <= FiguresAsked::kNearlyNone;
}

namespace {

// The cells of a survey that goes on.
PooledPart part_of_store(const CellStore& store, const Areas& areas, const SurveyedPair& pair,
                         const Enclosure& area) {
  return {[&](const std::vector<double>& ascending) {
            std::vector<Threshold> at;
            at.reserve(ascending.size());
            for (const double d : ascending)
              at.push_back(threshold_at(pair.frame, pair.displacement, d));
            return shares_within(store, areas, at);
          },
          area};
}

double undecided(const PooledPart& part, const Enclosure& e) {
  double share = 0;
  for (const Enclosure& within : part.shares({e.lower, e.upper}))
    share += within.upper - within.lower;
  return share * part.area.upper;
}

}  // namespace

Goal pooled_goal(const PooledSearch& search, const SurveyedPair& pair, const Areas& areas) {
  constexpr double kSmallPart = 0.25;
  const auto known = std::make_shared<Enclosure>(search.known);
  return [search, &pair, &areas, known, area = search.cells->area()](const CellStore& store) {
    const PooledPart own = part_of_store(store, areas, pair, area);
    const PooledPart other = part_of(*search.other);
    *known = pooled_percentile(own, other, search.share, *known);
    const double enough = std::max(MetricsOptions::kTolerance * known->lower,
                                   pair.frame.length_down(least_width(pair)));
    if (known->upper - known->lower <= enough) return Scores{{}, true};
    if (is_pooled_jump(own, other, *known, enough)) return Scores{};
    if (undecided(own, *known) < kSmallPart * undecided(other, *known)) return Scores{};
    return score_undecided(store, areas,
                           {threshold_at(pair.frame, pair.displacement, known->lower),
                            threshold_at(pair.frame, pair.displacement, known->upper)});
  };
}

}  // namespace vkh
