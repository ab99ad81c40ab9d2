#include "host/survey/wave_goals.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host/survey/area_table.h"

namespace vkh {
namespace {

double squares_width(const Enclosure& rms) { return rms.upper * rms.upper - rms.lower * rms.lower; }

}  // namespace

double weight_of_width(double width) { return 1 / std::max(width, 1e-9); }

void add_open(const Threshold& at, double weight, gpu::SurveyPlan& plan, uint32_t classes) {
  if (plan.open_count == gpu::kSurveyOpen) return;
  plan.open_classes[plan.open_count] = classes;
  plan.open[plan.open_count] = {static_cast<float>(at.down), static_cast<float>(at.up)};
  plan.shares[plan.open_count++] = static_cast<float>(weight);
}

FigureGoals::FigureGoals(const SurveyOptions& options, const SurveyedPair& pair, double farthest)
    : asked_(options, pair) {
  // The kept share has the same goal as any share.
  if (options.max_distance) asked_.options.bands.push_back(options.max_distance->within);
  for (const Threshold& band : asked_.bands()) bands_.push_back({band});
  for (const double share : options.percentiles) {
    quantiles_.emplace_back(share, Enclosure{0, farthest});
  }
}

bool FigureGoals::is_open(size_t band) const {
  const Band& b = bands_[band];
  return !asked_.is_enough(b.share, band) && (!b.is_atom || asked_.options.enough);
}

bool FigureGoals::is_open(const QuantileGoal& p) const {
  return asked_.options.narrows_percentiles && asked_.is_open(p.known) && !p.is_gap;
}

bool FigureGoals::is_open_mean() const {
  return asked_.options.narrows_mean && asked_.is_open(moments_.mean);
}
bool FigureGoals::is_open_rms() const {
  return asked_.options.narrows_rms && asked_.is_open(moments_.rms);
}

std::optional<Threshold> FigureGoals::wanted_moments() const {
  if (!is_open_mean() && !is_open_rms()) return {};
  return asked_.most();
}

// A goal that is met stays met, since bounds of cells hold for their parts.
std::vector<Threshold> FigureGoals::thresholds() const {
  std::vector<Threshold> at;
  for (size_t i = 0; i < bands_.size(); ++i) {
    if (!is_open(i)) continue;
    const auto around = asked_.around(bands_[i].at);
    at.insert(at.end(), around.begin(), around.end());
  }
  for (const QuantileGoal& p : quantiles_) {
    if (is_open(p)) p.add_thresholds(asked_.beside(p.known), at);
  }
  return at;
}

bool FigureGoals::look(const Tallied& tallied) {
  const std::vector<Threshold> at = thresholds();
  const std::span<const Enclosure> shares = tallied.shares;
  size_t k = 0;
  for (size_t i = 0; i < bands_.size(); ++i) {
    if (!is_open(i)) continue;
    Band& band = bands_[i];
    band.share = shares[k];
    band.is_atom = asked_.is_atom(shares.subspan(k, FiguresAsked::kOfBand));
    k += FiguresAsked::kOfBand;
  }
  if (wanted_moments()) moments_ = tallied.moments;
  bool may_be_closer = false;
  for (QuantileGoal& p : quantiles_) {
    if (!is_open(p)) continue;
    constexpr size_t kOf = QuantileGoal::kThresholds;
    const double before = p.doubt();
    p.is_gap = asked_.is_gap(p.known, shares[k + kOf - 2], shares[k + kOf - 1]);
    p.look(std::span(at).subspan(k, kOf), shares.subspan(k, kOf));
    k += kOf;
    p.narrow({tallied.lowest, tallied.highest});
    const bool may_be_gap = asked_.is_gap(p.known, p.at_first, p.at_last);
    const bool is_coarse =
        is_open(p) && p.is_coarse(may_be_gap ? asked_.beside(p.known) : p.width());
    may_be_closer = may_be_closer || (is_coarse && 2 * p.doubt() < before);
  }
  return may_be_closer;
}

bool FigureGoals::are_met() const {
  for (size_t i = 0; i < bands_.size(); ++i) {
    if (is_open(i)) return false;
  }
  return !is_open_mean() && !is_open_rms() &&
         std::none_of(quantiles_.begin(), quantiles_.end(),
                      [&](const QuantileGoal& p) { return is_open(p); });
}

gpu::SurveyPlan FigureGoals::plan(double whole) const {
  gpu::SurveyPlan plan{};
  plan.of_whole = static_cast<float>(1 / whole);
  plan.most = edge_of(asked_.most());
  plan.mean_classes = gpu::kAllClasses;
  if (is_open_mean())
    plan.mean = static_cast<float>(weight_of_width(FiguresAsked::width(moments_.mean)));
  if (is_open_rms()) plan.square = static_cast<float>(weight_of_width(squares_width(moments_.rms)));
  for (size_t i = 0; i < bands_.size(); ++i) {
    if (is_open(i))
      add_open(bands_[i].at, weight_of_width(FiguresAsked::width(bands_[i].share)), plan);
  }
  for (const QuantileGoal& p : quantiles_) {
    if (!is_open(p)) continue;
    const double weight = p.weight();
    add_open({p.first, p.first}, weight, plan);
    add_open({p.last, p.last}, weight, plan);
  }
  return plan;
}

double FigureGoals::part() const {
  double part = 0;
  const auto raise = [&](double width, double enough) {
    part = std::max(part, part_to_split(width, enough));
  };
  if (is_open_mean()) raise(FiguresAsked::width(moments_.mean), asked_.enough(moments_.mean));
  if (is_open_rms()) raise(FiguresAsked::width(moments_.rms), asked_.enough(moments_.rms));
  for (size_t i = 0; i < bands_.size(); ++i) {
    if (!is_open(i)) continue;
    if (asked_.options.enough) return kNearlyAll;
    raise(asked_.width_of_share(bands_[i].share, i), asked_.options.area_tolerance);
  }
  for (const QuantileGoal& p : quantiles_) {
    if (is_open(p)) return kNearlyAll;
  }
  return part;
}

}  // namespace vkh
