#include "host/survey/area_figures.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "host/survey/kept.h"
#include "host/survey/lengths.h"

namespace vkh {
namespace {

constexpr int kCurveSteps = 100;

// Asks for everything that the figures of a surface need in one tally, and finds the answers in it.
class Questions {
 public:
  Questions(const FiguresAsked& asked, bool has_curve) : asked_(asked) {
    for (const Threshold& band : asked.bands()) {
      const auto around = asked.around(band);
      at_.insert(at_.end(), around.begin(), around.end());
    }
    curve_ = at_.size();
    for (int k = 0; has_curve && k <= kCurveSteps; ++k) {
      steps_.push_back(asked.largest * k / kCurveSteps);
      at_.push_back(asked.threshold(steps_.back()));
    }
    if (asked.options.max_distance) at_.push_back(asked.most());
  }

  std::span<const Threshold> at() const { return at_; }

  std::vector<AreaWithin> bands(const Tallied& all) const {
    std::vector<AreaWithin> bands;
    for (size_t i = 0; i < asked_.options.bands.size(); ++i) {
      constexpr size_t kOfBand = FiguresAsked::kOfBand;
      const auto around = std::span(all.shares).subspan(kOfBand * i, kOfBand);
      bands.push_back(within(asked_.options.bands[i], around[0]));
      bands[i].jump = asked_.is_atom(around) &&
                      FiguresAsked::width(bands[i].share) > asked_.options.area_tolerance;
    }
    return bands;
  }
  std::vector<AreaWithin> curve(const Tallied& all) const {
    std::vector<AreaWithin> curve;
    for (size_t k = 0; k < steps_.size(); ++k)
      curve.push_back(within(steps_[k], all.shares[curve_ + k]));
    return curve;
  }
  // The share that is within max_distance.
  static Enclosure kept(const Tallied& all) { return all.shares.back(); }

 private:
  // All area is within a distance that no point exceeds. The tally may show only nearly all area
  // there, since displacement moves its threshold.
  AreaWithin within(double distance, const Enclosure& share) const {
    return {distance, distance >= asked_.largest ? Enclosure{1, 1} : share};
  }

  const FiguresAsked& asked_;
  std::vector<Threshold> at_;
  std::vector<double> steps_;
  size_t curve_ = 0;
};

// A larger share needs at least the same distance. So each end also follows from the others', which
// were sought separately.
void put_in_order(std::span<const double> shares, std::span<Enclosure> at) {
  for (size_t i = 0; i < at.size(); ++i) {
    for (size_t j = 0; j < at.size(); ++j) {
      if (!(shares[i] <= shares[j])) continue;
      at[j].lower = std::max(at[j].lower, at[i].lower);
      at[i].upper = std::min(at[i].upper, at[j].upper);
    }
  }
}

// Percentiles without a goal are as wide as the goals of other figures leave them.
std::vector<Percentile> percentiles_of(AreaDistances& distances, const FiguresAsked& asked,
                                       const SurveyedPair& pair) {
  const std::vector<double>& shares = asked.options.percentiles;
  const bool has_goal = asked.options.narrows_percentiles;
  const double resolution =
      has_goal ? asked.resolution(distances.reached()) : std::numeric_limits<double>::infinity();
  std::vector<Enclosure> at = distances.percentiles({shares, resolution});
  put_in_order(shares, at);
  std::vector<Percentile> found;
  std::vector<Threshold> beside;
  for (size_t i = 0; i < at.size(); ++i) {
    found.push_back({shares[i], in_files(pair, at[i]), false});
    if (!has_goal || !asked.is_open(at[i])) continue;
    const double near = at[i].lower + asked.beside(at[i]), far = at[i].upper - asked.beside(at[i]);
    beside.insert(beside.end(), {{near, near}, {far, far}});
  }
  if (beside.empty()) return found;
  const std::vector<Enclosure> between = distances.tally({beside}).shares;
  for (size_t i = 0, k = 0; i < at.size(); ++i) {
    if (!asked.is_open(at[i])) continue;
    found[i].jump = asked.is_gap(at[i], between[k], between[k + 1]);
    k += 2;
  }
  return found;
}

}  // namespace

bool has_only_shares(const SurveyOptions& options) {
  const bool has_lengths =
      options.narrows_mean || options.narrows_rms || options.narrows_percentiles;
  return !options.bands.empty() && !has_lengths && !options.map && !options.normals_within &&
         !options.max_distance;
}

std::optional<Statistics> statistics_of(AreaDistances& distances, const Areas& areas,
                                        const SurveyedPair& pair, const SurveyOptions& options) {
  if (!areas.is_positive()) return std::nullopt;
  FiguresAsked asked(options, pair);
  asked.largest = in_files(pair, {0, distances.highest()}).upper;
  const double area = areas.unit.length_up(areas.unit.length_up(areas.whole));
  if (!std::isfinite(asked.largest) || !std::isfinite(area)) return std::nullopt;
  const Questions questions(asked, !has_only_shares(options));
  const Tallied all = distances.tally({questions.at(), asked.most()});
  Statistics s;
  if (pair.a.are_points) {
    s.points = pair.a.faces.size();
  } else {
    s.area = area;
  }
  s.bands = questions.bands(all);
  s.curve = questions.curve(all);
  if (options.max_distance) {
    keep_within({asked, pair, Questions::kept(all), all.moments}, distances, s);
    return s;
  }
  s.mean = in_files(pair, all.moments.mean);
  s.rms = in_files(pair, all.moments.rms);
  s.percentiles = percentiles_of(distances, asked, pair);
  return s;
}

void add_middles(bool only_shares, Statistics& s) {
  const auto put = [](Enclosure& e) {
    if (std::isfinite(e.upper)) e.estimate = e.lower + (e.upper - e.lower) / 2;
  };
  for (AreaWithin& band : s.bands) {
    put(band.share);
    if (band.agreeing) put(*band.agreeing);
  }
  if (s.normal_cosine) put(*s.normal_cosine);
  if (only_shares) return;
  for (Enclosure* figure : {&s.mean, &s.rms}) put(*figure);
  for (Percentile& p : s.percentiles) put(p.distance);
  for (AreaWithin& step : s.curve) put(step.share);
}

}  // namespace vkh
