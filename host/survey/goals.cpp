#include "host/survey/goals.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/survey/figures_asked.h"

namespace vkh {
namespace {

// A width in the frame: what plain floats leave of a cell's bounds, a few times over. Splits gain
// nothing below it.
constexpr double kFloor = 2e-6;

// The distance between a cell's bounds.
double spread(const gpu::CellBounds& b) {
  return static_cast<double>(b.highest) - static_cast<double>(lowest(b));
}

// Whether a band cuts what is known of a point.
bool is_cut(const gpu::CellBounds& b, const std::vector<Threshold>& bands) {
  return std::any_of(bands.begin(), bands.end(), [&](const Threshold& at) {
    return at.down < static_cast<double>(b.highest) && at.up >= static_cast<double>(lowest(b));
  });
}

// A point scores if it is not known as well as any figure asks, or if a band cuts what is known.
Scores score_points(const CellStore& store, const FiguresAsked& asked) {
  const std::vector<Threshold> bands = asked.bands();
  return scored(store, [&](size_t i) -> std::optional<double> {
    const gpu::CellBounds& b = store.bounds(i);
    const double wide = spread(b);
    const bool matters = wide > asked.least / 2 || (wide > 0 && is_cut(b, bands));
    if (!matters || !store.can_split(i)) return std::nullopt;
    return wide;
  });
}

double area_of(const CellStore& store, const Areas& areas, size_t i) {
  return store.share(i) * areas.of_face[store.face(i)];
}

// The share of a cell's area that is not known to be within a distance, or beyond it.
double undecided_share(const gpu::CellBounds& b, const Threshold& at) {
  const double perhaps = share_within(b.lower_a, b.lower_b, b.lower_c, at.up);
  const double surely = at.down >= static_cast<double>(b.highest)
                            ? 1.0
                            : share_within(b.upper_a, b.upper_b, b.upper_c, at.down);
  return std::max(perhaps - surely, 0.0);
}

}  // namespace

Scores score_undecided(const CellStore& store, const Areas& areas,
                       const std::vector<Threshold>& distances) {
  return scored(store, [&](size_t i) -> std::optional<double> {
    const gpu::CellBounds& b = store.bounds(i);
    if (spread(b) <= kFloor) return 0;
    double share = 0;
    for (const Threshold& at : distances) share += undecided_share(b, at);
    return share * area_of(store, areas, i);
  });
}

double least_width(const SurveyedPair& pair) {
  return std::max(1e-6 * pair.frame.to_frame(diagonal(bounding_box(pair.a))), 3 * kFloor);
}

Enclosure in_files(const SurveyedPair& pair, const Enclosure& lengths) {
  const FileInterval f =
      pair.frame.to_files(lengths.lower, lengths.upper, pair.displacement, pair.farthest);
  return {f.lower, f.upper};
}

std::vector<Goal> goals_of(const SurveyOptions& options, const SurveyedPair& pair) {
  std::vector<Goal> goals;
  const FiguresAsked asked(options, pair);
  if (options.statistics && pair.a.are_points)
    goals.emplace_back([asked](const CellStore& store) { return score_points(store, asked); });
  return goals;
}

}  // namespace vkh
