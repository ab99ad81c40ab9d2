#include "host/survey/goals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/parallel.h"

namespace vkh {
namespace {

template <class F>
void each_cell(const CellStore& store, const F& work) {
  for_each_block(store.count(), [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) work(i);
  });
}

// A width in the frame: what plain floats leave of a cell's bounds, a few times over. Splits gain
// nothing below it.
constexpr double kFloor = 2e-6;

double width(const Enclosure& e) { return e.upper - e.lower; }

struct Asked {
  SurveyOptions options;
  double displacement;
  Frame frame;
  double largest = std::numeric_limits<double>::infinity();  // no distance is above it
};

// A distance of the files in the frame, from below and above what it is on the stored meshes.
Threshold in_frame(const Asked& asked, double distance) {
  const double d = asked.frame.to_frame(distance);
  return {d * (1 - 1e-15) - asked.displacement, d * (1 + 1e-15) + asked.displacement};
}

// The distance between a cell's bounds.
double spread(const gpu::CellBounds& b) {
  return static_cast<double>(b.highest) - static_cast<double>(lowest(b));
}

// A cell scores if it lifts its face's highest too far above what the face reaches.
Scores score_faces(const CellStore& store, const Asked& asked) {
  const SurveyOptions& options = asked.options;
  const double wanted = options.field_tolerance > 0
                            ? asked.frame.to_frame(options.field_tolerance)
                            : options.face_tolerance * static_cast<double>(store.reached());
  const double tolerance = wanted - 2 * asked.displacement;
  Scores scores{{}, true};
  for (size_t i = 0; i < store.count(); ++i) {
    const double above = static_cast<double>(store.bounds(i).highest) -
                         static_cast<double>(store.reached(store.face(i)));
    if (above <= tolerance) continue;
    scores.is_met = false;
    if (above > kFloor) scores.cells.push_back({above, i});
  }
  return scores;
}

// A cell scores if it is too far for the limit, on a face that is not known to be beyond it.
Scores score_verdicts(const CellStore& store, const Asked& asked) {
  const double within = in_frame(asked, asked.options.limit.within).down;
  const double beyond = in_frame(asked, asked.options.limit.beyond).up;
  Scores scores{{}, true};
  for (size_t i = 0; i < store.count(); ++i) {
    const gpu::CellBounds& b = store.bounds(i);
    const double above = static_cast<double>(b.highest) - within;
    const auto reached = static_cast<double>(store.reached(store.face(i)));
    if (above <= 0 || reached > beyond) continue;
    scores.is_met = false;
    if (spread(b) > kFloor) scores.cells.push_back({above, i});
  }
  return scores;
}

double area_of(const CellStore& store, const Areas& areas, size_t i) {
  return store.share(i) * areas.of_face[store.face(i)];
}

// Adds the part of a cell's area that is not known to be within a distance, or beyond it.
void score_undecided(const CellStore& store, const Areas& areas, const Threshold& at,
                     std::vector<double>& scores) {
  each_cell(store, [&](size_t i) {
    const gpu::CellBounds& b = store.bounds(i);
    const double perhaps = share_within(b.lower_a, b.lower_b, b.lower_c, at.up);
    const double surely = at.down >= static_cast<double>(b.highest)
                              ? 1.0
                              : share_within(b.upper_a, b.upper_b, b.upper_c, at.down);
    if (perhaps > surely && spread(b) > kFloor)
      scores[i] += (perhaps - surely) * area_of(store, areas, i);
  });
}

std::vector<Scored> positive(const std::vector<double>& scores) {
  std::vector<Scored> scored;
  for (size_t i = 0; i < scores.size(); ++i) {
    if (scores[i] > 0) scored.push_back({scores[i], i});
  }
  return scored;
}

std::vector<Threshold> bands_of(const Asked& asked) {
  std::vector<Threshold> at;
  for (const double band : asked.options.bands) at.push_back(in_frame(asked, band));
  return at;
}

bool is_enough(const Enclosure& share, const SurveyOptions& options) {
  if (!options.enough) return width(share) <= options.area_tolerance;
  return share.lower >= *options.enough || share.upper < *options.enough;
}

// A percentile's own width differs from its distribution's: at both ends of it there may be area
// that is undecided.
Scores score_distribution(const CellStore& store, const Areas& areas, const Asked& asked) {
  const auto reached = static_cast<double>(store.reached());
  const std::vector<Threshold> bands = bands_of(asked);
  const std::vector<Enclosure> shares = shares_within(store, areas, bands);
  std::vector<double> scores(store.count(), 0.0);
  bool is_met = true;
  for (size_t i = 0; i < bands.size(); ++i) {
    if (is_enough(shares[i], asked.options)) continue;
    is_met = false;
    score_undecided(store, areas, bands[i], scores);
  }
  for (const Enclosure& p : percentiles(store, areas, asked.options.percentiles)) {
    if (width(p) <= asked.options.mean_tolerance * reached) continue;
    is_met = false;
    score_undecided(store, areas, {p.lower, p.lower}, scores);
    score_undecided(store, areas, {p.upper, p.upper}, scores);
  }
  return {positive(scores), is_met};
}

// Scores a cell by its part of the width of the mean, and then of its square's.
Scores score_moments(const CellStore& store, const Areas& areas, const Asked& asked) {
  const Moments moments = moments_of(store, areas);
  const double tolerance = asked.options.mean_tolerance * static_cast<double>(store.reached());
  const bool by_mean = width(moments.mean) > tolerance;
  if (!by_mean && width(moments.rms) <= tolerance) return {{}, true};
  std::vector<double> scores(store.count());
  each_cell(store, [&](size_t i) {
    const gpu::CellBounds& b = store.bounds(i);
    const double down = mean_lower(b), up = static_cast<double>(b.mean_upper);
    const double squares = static_cast<double>(b.square_upper) - down * down;
    if (spread(b) > kFloor) scores[i] = area_of(store, areas, i) * (by_mean ? up - down : squares);
  });
  return {positive(scores), false};
}

}  // namespace

Enclosure in_files(const SurveyedPair& pair, const Enclosure& lengths) {
  const FileInterval f =
      pair.frame.to_files(lengths.lower, lengths.upper, pair.displacement, pair.farthest);
  return {f.lower, f.upper};
}

std::vector<Goal> goals_of(const SurveyOptions& options, const SurveyedPair& pair,
                           const Areas& areas) {
  std::vector<Goal> goals;
  const Asked asked{options, pair.displacement, pair.frame};
  if (options.faces && options.limit.within > 0)
    goals.emplace_back([asked](const CellStore& store) { return score_verdicts(store, asked); });
  if (options.faces)
    goals.emplace_back([asked](const CellStore& store) { return score_faces(store, asked); });
  if (!options.statistics || !areas.is_positive()) return goals;
  goals.emplace_back(
      [&areas, asked](const CellStore& store) { return score_moments(store, areas, asked); });
  goals.emplace_back(
      [&areas, asked](const CellStore& store) { return score_distribution(store, areas, asked); });
  return goals;
}

namespace {

constexpr int kCurveSteps = 100;

double largest_upper(const CellStore& store, const SurveyedPair& pair) {
  const std::vector<float> highest = store.highest_of_faces();
  const float most = *std::max_element(highest.begin(), highest.end());
  return in_files(pair, {0, static_cast<double>(most)}).upper;
}

std::vector<AreaWithin> within(const CellStore& store, const Areas& areas, const Asked& asked,
                               const std::vector<double>& distances) {
  std::vector<Threshold> at;
  at.reserve(distances.size());
  for (const double d : distances) at.push_back(in_frame(asked, d));
  const std::vector<Enclosure> shares = shares_within(store, areas, at);
  std::vector<AreaWithin> all;
  for (size_t i = 0; i < at.size(); ++i) {
    // All area is within a distance that none exceeds: by the threshold, which displacement moves,
    // only nearly all may be.
    const bool is_all = distances[i] >= asked.largest;
    all.push_back({distances[i], is_all ? Enclosure{1, 1} : shares[i]});
  }
  return all;
}

}  // namespace

std::optional<Statistics> statistics_of(const CellStore& store, const Areas& areas,
                                        const SurveyedPair& pair, const SurveyOptions& options) {
  if (!areas.is_positive()) return std::nullopt;
  const double last = largest_upper(store, pair);
  const double area = areas.unit.length_up(areas.unit.length_up(areas.whole));
  if (!std::isfinite(last) || !std::isfinite(area)) return std::nullopt;
  const Asked asked{options, pair.displacement, pair.frame, last};
  const Moments moments = moments_of(store, areas);
  Statistics s;
  s.area = area;
  s.mean = in_files(pair, moments.mean);
  s.rms = in_files(pair, moments.rms);
  s.bands = within(store, areas, asked, options.bands);
  const std::vector<Enclosure> at = percentiles(store, areas, options.percentiles);
  for (size_t i = 0; i < at.size(); ++i)
    s.percentiles.push_back({options.percentiles[i], in_files(pair, at[i])});
  std::vector<double> steps;
  for (int k = 0; k <= kCurveSteps; ++k) steps.push_back(last * k / kCurveSteps);
  s.curve = within(store, areas, asked, steps);
  return s;
}

}  // namespace vkh
