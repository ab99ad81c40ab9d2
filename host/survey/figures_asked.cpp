#include "host/survey/figures_asked.h"

#include "host/survey/lengths.h"
#include "vkhausdorff/metrics.h"

namespace vkh {
namespace {

// The most area, as a share, that may lie at distances above `from` and up to `to`.
double most_between(const Enclosure& at_from, const Enclosure& at_to) {
  return at_to.upper - at_from.lower;
}

}  // namespace

FiguresAsked::FiguresAsked(const SurveyOptions& asked, const SurveyedPair& pair)
    : options(asked),
      displacement(pair.displacement),
      frame(pair.frame),
      least(least_width(pair)) {}

std::vector<Threshold> FiguresAsked::bands() const {
  std::vector<Threshold> at;
  for (const double band : options.bands) at.push_back(threshold(band));
  return at;
}

// Converts a distance of the files to the frame, with bounds of what it is on the stored meshes.
Threshold FiguresAsked::most() const {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  if (!options.max_distance) return {kAny, kAny};
  return threshold(*options.max_distance);
}

double FiguresAsked::width_of_share(const Enclosure& share, size_t band) const {
  if (band >= options.other_shares.size()) return width(share);
  return std::max(width(share), width(harmonic_mean(share, options.other_shares[band])));
}

bool FiguresAsked::is_enough(const Enclosure& share, size_t band) const {
  if (!options.enough) return width_of_share(share, band) <= options.area_tolerance;
  return share.lower >= *options.enough || share.upper < *options.enough;
}

std::array<Threshold, FiguresAsked::kOfBand> FiguresAsked::around(const Threshold& band) const {
  return {
      band, Threshold{band.down - least, band.down - least}, {band.up + least, band.up + least}};
}

bool FiguresAsked::is_atom(std::span<const Enclosure> around) const {
  const Enclosure &share = around[0], &before = around[1], &behind = around[2];
  const double there = behind.lower - before.upper, tolerance = options.area_tolerance;
  return width(share) > tolerance && width(share) - there <= tolerance;
}

bool FiguresAsked::is_gap(const Enclosure& percentile, const Enclosure& at_from,
                          const Enclosure& at_to) const {
  return is_open(percentile) && most_between(at_from, at_to) <= kNearlyNone;
}

}  // namespace vkh
