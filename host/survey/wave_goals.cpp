#include "host/survey/wave_goals.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host/survey/area_table.h"
#include "host/survey/goals.h"

namespace vkh {
namespace {

constexpr int kPieces = 5;  // into which a tally cuts each range of a percentile

// A figure's whole width scores 1; it is not 0 where the figure is open, but for shares of
// percentiles, whose ends are known by the thresholds alone.
double weight_of_width(double width) { return 1 / std::max(width, 1e-9); }

double squares_width(const Enclosure& rms) { return rms.upper * rms.upper - rms.lower * rms.lower; }

}  // namespace

void add_open(const Threshold& at, double weight, gpu::SurveyPlan& plan) {
  if (plan.open_count == gpu::kSurveyOpen) return;
  plan.open[plan.open_count] = {static_cast<float>(at.down), static_cast<float>(at.up)};
  plan.shares[plan.open_count++] = static_cast<float>(weight);
}

FigureGoals::FigureGoals(const SurveyOptions& options, const SurveyedPair& pair, double farthest)
    : asked_(options, pair) {
  // The share that is kept is sought as narrowly as any share.
  if (options.max_distance) asked_.options.bands.push_back(options.max_distance->within);
  for (const Threshold& band : asked_.bands()) bands_.push_back({band});
  for (const double share : options.percentiles) {
    Quantile& p = quantiles_.emplace_back();
    p.share = share;
    p.known = {0, farthest};
    p.first = farthest;
  }
}

bool FigureGoals::is_open(size_t band) const {
  const Band& b = bands_[band];
  return !asked_.is_enough(b.share, band) && (!b.is_atom || asked_.options.enough);
}

bool FigureGoals::is_open(const Quantile& p) const {
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

// All that is known, and closer about both ends.
std::vector<Threshold> FigureGoals::thresholds_of(const Quantile& p) const {
  std::vector<Threshold> at;
  const auto cut = [&](double from, double to) {
    for (int k = 1; k < kPieces; ++k) {
      const double distance = std::clamp(from + (to - from) * k / kPieces, from, to);
      at.push_back({distance, distance});
    }
  };
  cut(p.known.lower, p.known.upper);
  cut(p.known.lower, std::clamp(p.first, p.known.lower, p.known.upper));
  cut(std::clamp(p.last, p.known.lower, p.known.upper), p.known.upper);
  const double beside = asked_.beside(p.known);
  at.push_back({p.known.lower + beside, p.known.lower + beside});
  at.push_back({p.known.upper - beside, p.known.upper - beside});
  return at;
}

// A goal that is met stays so: what is known of it holds for parts of cells, too.
std::vector<Threshold> FigureGoals::thresholds() const {
  std::vector<Threshold> at;
  for (size_t i = 0; i < bands_.size(); ++i) {
    if (!is_open(i)) continue;
    const auto around = asked_.around(bands_[i].at);
    at.insert(at.end(), around.begin(), around.end());
  }
  for (const Quantile& p : quantiles_) {
    if (!is_open(p)) continue;
    const std::vector<Threshold> some = thresholds_of(p);
    at.insert(at.end(), some.begin(), some.end());
  }
  return at;
}

// A distance at which less than the share may be within is below the percentile; one at which it
// surely is within is not.
void FigureGoals::look(Quantile& p, std::span<const Threshold> at,
                       std::span<const Enclosure> shares) const {
  const size_t probes = at.size() - 2;
  p.is_gap = asked_.is_gap(p.known, shares[probes], shares[probes + 1]);
  p.first = p.known.upper;
  p.last = p.known.lower;
  p.at_first = p.at_last = {};
  for (size_t k = 0; k < probes; ++k) {
    const double distance = at[k].down;
    const bool is_perhaps = shares[k].upper >= p.share, is_surely = shares[k].lower >= p.share;
    if (!is_perhaps) p.known.lower = std::max(p.known.lower, distance);
    if (is_surely) p.known.upper = std::min(p.known.upper, distance);
    if (is_perhaps && distance <= p.first) {
      p.first = distance;
      p.at_first = shares[k];
    }
    if (!is_surely && distance >= p.last) {
      p.last = distance;
      p.at_last = shares[k];
    }
  }
}

// The ends must be close to where the cells have them: to see whether they are narrow, and what to
// split; and where nearly no area lies between, to see that.
bool FigureGoals::is_coarse(const Quantile& p) const {
  if (!is_open(p)) return false;
  const bool may_be_gap = asked_.is_gap(p.known, p.at_first, p.at_last);
  const double width = FiguresAsked::width(p.known);
  return p.doubt() > (may_be_gap ? std::min(width, asked_.beside(p.known)) : width) / 8;
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
  for (Quantile& p : quantiles_) {
    if (!is_open(p)) continue;
    const double before = p.doubt();
    const size_t count = thresholds_of(p).size();
    look(p, std::span(at).subspan(k, count), shares.subspan(k, count));
    k += count;
    p.known.lower = std::clamp(tallied.lowest, p.known.lower, p.known.upper);
    p.known.upper = std::clamp(tallied.highest, p.known.lower, p.known.upper);
    may_be_closer = may_be_closer || (is_coarse(p) && 2 * p.doubt() < before);
  }
  return may_be_closer;
}

bool FigureGoals::are_met() const {
  for (size_t i = 0; i < bands_.size(); ++i) {
    if (is_open(i)) return false;
  }
  return !is_open_mean() && !is_open_rms() &&
         std::none_of(quantiles_.begin(), quantiles_.end(),
                      [&](const Quantile& p) { return is_open(p); });
}

gpu::SurveyPlan FigureGoals::plan(double whole) const {
  gpu::SurveyPlan plan{};
  plan.of_whole = static_cast<float>(1 / whole);
  plan.most = edge_of(asked_.most());
  if (is_open_mean())
    plan.mean = static_cast<float>(weight_of_width(FiguresAsked::width(moments_.mean)));
  if (is_open_rms()) plan.square = static_cast<float>(weight_of_width(squares_width(moments_.rms)));
  for (size_t i = 0; i < bands_.size(); ++i) {
    if (is_open(i))
      add_open(bands_[i].at, weight_of_width(FiguresAsked::width(bands_[i].share)), plan);
  }
  for (const Quantile& p : quantiles_) {
    if (!is_open(p)) continue;
    const double weight =
        weight_of_width(FiguresAsked::width(p.at_first) + FiguresAsked::width(p.at_last));
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
    if (asked_.options.enough) return Scores::kNearlyAll;
    raise(asked_.width_of_share(bands_[i].share, i), asked_.options.area_tolerance);
  }
  for (const Quantile& p : quantiles_) {
    if (is_open(p)) return Scores::kNearlyAll;
  }
  return part;
}

}  // namespace vkh
