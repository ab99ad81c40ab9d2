// Figures of the part K of A that is within a distance D: those of all of A, divided by the share
// of K. The moments of d over K are those over A of what is d on K and 0 elsewhere.
#include <algorithm>
#include <cmath>

#include "host/survey/goals.h"
#include "host/survey/statistics.h"
#include "vkhausdorff/length.h"

namespace vkh {
namespace {

constexpr double kDown = 1 - 0x1p-50, kUp = 1 + 0x1p-50;  // a quotient or root and more

// A distance of the files in the frame, from below and above what it is on the stored meshes.
Threshold threshold_of(const SurveyedPair& pair, const Limit& limit) {
  return {pair.frame.to_frame(limit.within) * (1 - 1e-15) - pair.displacement,
          pair.frame.to_frame(limit.beyond) * (1 + 1e-15) + pair.displacement};
}

// A figure of all of A by the share that is kept. No distance that is kept exceeds `most`.
Enclosure over(const Enclosure& figure, const Enclosure& kept, double most) {
  Enclosure e{kept.upper > 0 ? figure.lower / kept.upper * kDown : 0, most};
  if (kept.lower > 0) e.upper = std::min(most, figure.upper / kept.lower * kUp);
  e.lower = std::min(e.lower, e.upper);
  return e;
}

Enclosure root_of(const Enclosure& e) {
  return {std::sqrt(e.lower) * kDown, std::sqrt(e.upper) * kUp};
}

Enclosure square_of(const Enclosure& e) {
  return {e.lower * e.lower * kDown, e.upper * e.upper * kUp};
}

void keep(const Enclosure& kept, double most, std::vector<AreaWithin>& shares) {
  for (AreaWithin& one : shares) {
    one.share = one.distance >= most ? Enclosure{1, 1} : over(one.share, kept, 1);
    one.jump = false;
  }
}

// The share p of K is first reached where p times the share of K is, of A.
void keep_percentiles(const SurveyedArea& surface, const SurveyedPair& pair, const Enclosure& kept,
                      double most, std::vector<Percentile>& percentiles) {
  std::vector<double> shares;
  for (const Percentile& p : percentiles) {
    shares.push_back(p.share * kept.lower * kDown);
    shares.push_back(std::min(p.share * kept.upper * kUp, 1.0));
  }
  const double resolution =
      std::max(0x1p-17 * static_cast<double>(surface.store.reached()), least_width(pair) / 16);
  const std::vector<Enclosure> at =
      vkh::percentiles(surface.store, surface.areas, {shares, resolution});
  for (size_t i = 0; i < percentiles.size(); ++i) {
    const Enclosure e = in_files(pair, {at[2 * i].lower, at[2 * i + 1].upper});
    percentiles[i].distance = {std::min(e.lower, most), std::min(e.upper, most)};
    percentiles[i].jump = false;
  }
}

}  // namespace

void keep_within(const SurveyedArea& surface, const SurveyedPair& pair,
                 const SurveyOptions& options, Statistics& s) {
  const auto& [store, areas, known] = surface;
  const Threshold at = threshold_of(pair, *options.max_distance);
  const double most = options.max_distance->beyond;
  const Enclosure kept = shares_within(store, areas, std::span(&at, 1)).front();
  s.kept = kept;
  s.max_distance = typed_length(*options.max_distance);
  const Moments moments = moments_of(store, areas, at);
  const double cap = std::max(at.up, 0.0);
  const Enclosure mean = over(moments.mean, kept, cap);
  const Enclosure rms = root_of(over(square_of(moments.rms), kept, cap * cap * kUp));
  for (const auto& [figure, to] : {std::pair{mean, &s.mean}, {rms, &s.rms}}) {
    *to = in_files(pair, figure);
    *to = {std::min(to->lower, most), std::min(to->upper, most)};
  }
  keep(kept, most, s.bands);
  keep(kept, most, s.curve);
  keep_percentiles(surface, pair, kept, most, s.percentiles);
}

}  // namespace vkh
