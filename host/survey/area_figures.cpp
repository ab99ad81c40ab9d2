#include "host/survey/area_figures.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace vkh {
namespace {

constexpr int kCurveSteps = 100;

std::vector<AreaWithin> within(AreaDistances& distances, const FiguresAsked& asked,
                               const std::vector<double>& ascending) {
  std::vector<Threshold> at;
  at.reserve(ascending.size());
  for (const double d : ascending) at.push_back(asked.threshold(d));
  const std::vector<Enclosure> shares = distances.shares_within(at);
  std::vector<AreaWithin> all;
  for (size_t i = 0; i < at.size(); ++i) {
    // All area is within a distance that none exceeds: by the threshold, which displacement moves,
    // only nearly all may be.
    const bool is_all = ascending[i] >= asked.largest;
    all.push_back({ascending[i], is_all ? Enclosure{1, 1} : shares[i]});
  }
  return all;
}

// All area is within a band that no distance exceeds, whatever its threshold says.
void add_jumps(AreaDistances& distances, const FiguresAsked& asked,
               std::vector<AreaWithin>& bands) {
  std::vector<Threshold> at;
  for (const Threshold& band : asked.bands()) {
    at.push_back(band);
    at.push_back({band.down - asked.least, band.down - asked.least});
    at.push_back({band.up + asked.least, band.up + asked.least});
  }
  const std::vector<Enclosure> all = distances.shares_within(at);
  for (size_t i = 0; i < bands.size(); ++i) {
    bands[i].jump = asked.is_atom(all[3 * i], all[3 * i + 1], all[3 * i + 2]) &&
                    FiguresAsked::width(bands[i].share) > asked.options.area_tolerance;
  }
}

std::vector<AreaWithin> curve_of(AreaDistances& distances, const FiguresAsked& asked) {
  std::vector<double> steps;
  for (int k = 0; k <= kCurveSteps; ++k) steps.push_back(asked.largest * k / kCurveSteps);
  return within(distances, asked, steps);
}

std::vector<Percentile> percentiles_of(AreaDistances& distances, const FiguresAsked& asked,
                                       std::span<const Enclosure> known, const SurveyedPair& pair) {
  const std::vector<double>& shares = asked.options.percentiles;
  const std::vector<Enclosure> at =
      distances.percentiles({shares, asked.resolution(distances.reached()), known});
  std::vector<Threshold> beside;
  for (const Enclosure& p : at) {
    beside.push_back({p.lower + asked.beside(p), p.lower + asked.beside(p)});
    beside.push_back({p.upper - asked.beside(p), p.upper - asked.beside(p)});
  }
  const std::vector<Enclosure> between = distances.shares_within(beside);
  std::vector<Percentile> found;
  for (size_t i = 0; i < at.size(); ++i)
    found.push_back({shares[i], in_files(pair, at[i]),
                     asked.is_gap(at[i], between[2 * i], between[2 * i + 1])});
  return found;
}

}  // namespace

double StoredDistances::highest() {
  const std::vector<float> highest = store_.highest_of_faces();
  return static_cast<double>(*std::max_element(highest.begin(), highest.end()));
}

bool has_only_shares(const SurveyOptions& options) {
  const bool has_lengths =
      options.narrows_mean || options.narrows_rms || options.narrows_percentiles;
  return !options.bands.empty() && !has_lengths && !options.map && !options.normals_within &&
         !options.max_distance;
}

std::optional<Statistics> statistics_of(AreaDistances& distances, const Areas& areas,
                                        std::span<const Enclosure> known, const SurveyedPair& pair,
                                        const SurveyOptions& options) {
  if (!areas.is_positive()) return std::nullopt;
  FiguresAsked asked(options, pair);
  asked.largest = in_files(pair, {0, distances.highest()}).upper;
  const double area = areas.unit.length_up(areas.unit.length_up(areas.whole));
  if (!std::isfinite(asked.largest) || !std::isfinite(area)) return std::nullopt;
  const Moments moments = distances.moments();
  Statistics s;
  if (pair.a.are_points) {
    s.points = pair.a.faces.size();
  } else {
    s.area = area;
  }
  s.mean = in_files(pair, moments.mean);
  s.rms = in_files(pair, moments.rms);
  s.bands = within(distances, asked, options.bands);
  add_jumps(distances, asked, s.bands);
  s.percentiles = percentiles_of(distances, asked, known, pair);
  if (!has_only_shares(options)) s.curve = curve_of(distances, asked);
  return s;
}

void add_middles(bool only_shares, Statistics& s) {
  const auto put = [](Enclosure& e) {
    if (std::isfinite(e.upper)) e.estimate = e.lower + (e.upper - e.lower) / 2;
  };
  for (AreaWithin& band : s.bands) put(band.share);
  if (only_shares) return;
  for (Enclosure* figure : {&s.mean, &s.rms}) put(*figure);
  for (Percentile& p : s.percentiles) put(p.distance);
  for (AreaWithin& step : s.curve) put(step.share);
}

}  // namespace vkh
