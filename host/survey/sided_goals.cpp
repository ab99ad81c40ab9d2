#include "host/survey/sided_goals.h"

#include <algorithm>
#include <cmath>

#include "host/mesh/mesh_pair.h"
#include "host/survey/area_table.h"

namespace vkh {
namespace {

// Scores cells that may be farther than a distance.
void add_farther(double distance, double weight, uint32_t classes, gpu::SurveyPlan& plan) {
  add_open({distance, kAnyDistance}, weight, plan, classes);
}

}  // namespace

SidedLimitGoals::SidedLimitGoals(const SurveyOptions& options, const SurveyedPair& pair,
                                 WaveSurvey& waves)
    : over_(FiguresAsked(options, pair).threshold(options.sided->over)),
      under_(FiguresAsked(options, pair).threshold(options.sided->under)),
      waves_(waves) {}

// Tallies without thresholds give what cells reach, and what they do not exceed.
bool SidedLimitGoals::look(const Tallied& /*tallied*/) {
  const double most = std::max(over_.up, under_.up);
  bool are_within = true, is_beyond = false;
  const auto see = [&](uint32_t classes, double within, double beyond) {
    const std::optional<Tallied> tallied = waves_.tally_now({.at = {}, .classes = classes});
    are_within = are_within && tallied && (tallied->is_empty || tallied->highest <= within);
    is_beyond = is_beyond || (tallied && static_cast<double>(tallied->reached) > beyond);
  };
  see(kOverB, over_.down, over_.up);
  see(kUnderB, under_.down, under_.up);
  see(kWithoutSide, least(), most);
  are_met_ = are_within || is_beyond;
  return false;
}

gpu::SurveyPlan SidedLimitGoals::plan(double /*whole*/) const {
  constexpr auto kAny = static_cast<float>(kAnyDistance);
  const auto down = [](double within) { return edge_of({within, within}).down; };
  gpu::SurveyPlan plan{};
  plan.faces = 1;
  plan.face_tolerance = -kAny;
  plan.face_beyond = kAny;
  plan.face_within[0] = down(least());
  plan.face_within[gpu::kClassOver] = down(over_.down);
  plan.face_within[gpu::kClassUnder] = down(under_.down);
  return plan;
}

bool UnsidedGoals::look(const Tallied& /*tallied*/) {
  constexpr double kEnough = 0.05;
  const std::array<Threshold, 2> at{{{near(), near()}, {kAnyDistance, kAnyDistance}}};
  const std::optional<Tallied> tallied = waves_.tally_now({.at = at, .classes = kMayGetSide});
  are_met_ = tallied && tallied->shares[1].upper - tallied->shares[0].lower <= kEnough;
  return false;
}

gpu::SurveyPlan UnsidedGoals::plan(double whole) const {
  gpu::SurveyPlan plan{};
  plan.of_whole = static_cast<float>(1 / whole);
  add_farther(near(), 1, kMayGetSide, plan);
  return plan;
}

SignedGoals::SignedGoals(const SurveyOptions& options, const SurveyedPair& pair,
                         SignedDistances& distances)
    : options_(options),
      distances_(distances),
      least_(std::max(options.signed_floor * pair.frame.to_frame(diagonal(bounding_box(pair.a))),
                      2 * pair.displacement)),
      mean_{-distances.highest(), distances.highest()} {
  for (const double share : kSignedShares) quantiles_.emplace_back(share, mean_);
}

// A signed figure may be 0, and a share of that is no goal: then the mean distance is the scale.
double SignedGoals::enough(const Enclosure& figure) const {
  const double size = std::max({figure.lower, -figure.upper, distances_.plain_mean()});
  return std::max(options_.signed_tolerance * size, least_);
}

std::vector<Threshold> SignedGoals::thresholds() const {
  std::vector<Threshold> at;
  for (const QuantileGoal& p : quantiles_) {
    if (is_open(p.known)) p.add_thresholds(0.4 * enough(p.known), at);
  }
  return at;
}

std::optional<Threshold> SignedGoals::wanted_moments() const {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  return Threshold{kAll, kAll};
}

bool SignedGoals::look(const Tallied& tallied) {
  const std::vector<Threshold> at = thresholds();
  bool may_be_closer = false;
  size_t k = 0;
  for (QuantileGoal& p : quantiles_) {
    constexpr size_t kOf = QuantileGoal::kThresholds;
    if (k + kOf > at.size() || !is_open(p.known)) continue;
    const double before = p.doubt();
    p.look(std::span(at).subspan(k, kOf), std::span(tallied.shares).subspan(k, kOf));
    k += kOf;
    p.narrow({tallied.lowest, tallied.highest});
    may_be_closer =
        may_be_closer || (is_open(p.known) && p.is_coarse(p.width()) && 2 * p.doubt() < before);
  }
  mean_ = tallied.moments.mean;
  return may_be_closer;
}

bool SignedGoals::are_met() const {
  return !is_open(mean_) && std::none_of(quantiles_.begin(), quantiles_.end(),
                                         [&](const QuantileGoal& p) { return is_open(p.known); });
}

// At a threshold of either sign, cells of one side are undecided around that distance; cells that
// may get a side are undecided wherever they may be farther.
gpu::SurveyPlan SignedGoals::plan(double whole) const {
  gpu::SurveyPlan plan{};
  plan.of_whole = static_cast<float>(1 / whole);
  plan.most = {static_cast<float>(kAnyDistance), static_cast<float>(kAnyDistance)};
  if (is_open(mean_)) {
    plan.mean = static_cast<float>(weight_of_width(mean_.upper - mean_.lower));
    plan.mean_classes = kOverB | kUnderB | kMayGetSide;
    plan.either_side = kMayGetSide;
  }
  for (const QuantileGoal& p : quantiles_) {
    if (!is_open(p.known)) continue;
    for (const double at : {p.first, p.last}) {
      const double distance = std::abs(at);
      add_open({distance, distance}, p.weight(), plan, at < 0 ? kUnderB : kOverB);
      add_farther(distance, p.weight(), kMayGetSide, plan);
    }
  }
  return plan;
}

}  // namespace vkh
