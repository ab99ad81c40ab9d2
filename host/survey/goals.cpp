#include "host/survey/goals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "host/base/parallel.h"
#include "vkhausdorff/metrics.h"

namespace vkh {
namespace {

// A width in the frame: what plain floats leave of a cell's bounds, a few times over. Splits gain
// nothing below it.
constexpr double kFloor = 2e-6;

double width(const Enclosure& e) { return e.upper - e.lower; }

struct Asked {
  SurveyOptions options;
  double displacement;
  Frame frame;
  double least;  // the width in the frame that is always enough
  double largest = std::numeric_limits<double>::infinity();  // no distance is above it
};

// The width that is enough for one figure.
double enough(const Enclosure& figure, const Asked& asked) {
  return std::max(asked.options.mean_tolerance * figure.lower, asked.least);
}

Threshold in_frame(const Asked& asked, double distance) {
  return threshold_at(asked.frame, asked.displacement, distance);
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
  return scored(store, [&](size_t i) -> std::optional<double> {
    const double above = static_cast<double>(store.bounds(i).highest) -
                         static_cast<double>(store.reached(store.face(i)));
    if (above <= tolerance) return std::nullopt;
    return above > kFloor ? above : 0;
  });
}

// A cell scores if it is too far for the limit, on a face that is not known to be beyond it.
Scores score_verdicts(const CellStore& store, const Asked& asked) {
  const double within = in_frame(asked, asked.options.limit.within).down;
  const double beyond = in_frame(asked, asked.options.limit.beyond).up;
  return scored(store, [&](size_t i) -> std::optional<double> {
    const gpu::CellBounds& b = store.bounds(i);
    const double above = static_cast<double>(b.highest) - within;
    const auto reached = static_cast<double>(store.reached(store.face(i)));
    if (above <= 0 || reached > beyond) return std::nullopt;
    return spread(b) > kFloor ? above : 0;
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

namespace {

std::vector<Threshold> bands_of(const Asked& asked) {
  std::vector<Threshold> at;
  for (const double band : asked.options.bands) at.push_back(in_frame(asked, band));
  return at;
}

// How far a share is to be narrowed: its own width, or that of its harmonic mean with the other
// surface's share where that is larger.
double width_of_share(const Enclosure& share, size_t band, const SurveyOptions& options) {
  if (band >= options.other_shares.size()) return width(share);
  return std::max(width(share), width(harmonic_mean(share, options.other_shares[band])));
}

bool is_enough(const Enclosure& share, size_t band, const SurveyOptions& options) {
  if (!options.enough) return width_of_share(share, band, options) <= options.area_tolerance;
  return share.lower >= *options.enough || share.upper < *options.enough;
}

// Percentiles are sought to so much of the largest distance.
double resolution_of(const CellStore& store, const Asked& asked) {
  return std::max(0x1p-17 * static_cast<double>(store.reached()), asked.least / 16);
}

// The most area, as a share, that may lie at distances above `from` and up to `to`.
double most_between(const Enclosure& at_from, const Enclosure& at_to) {
  return at_to.upper - at_from.lower;
}

// Whether each percentile that is too wide is so for ever: nearly no area lies between its ends,
// but for two fifths of the width that would be enough beside each, which is more than kFloor.
std::vector<bool> jumps_of(const CellStore& store, const Areas& areas, const Asked& asked,
                           const std::vector<Enclosure>& known) {
  constexpr double kNearlyNone = 1e-5;
  std::vector<Threshold> at;
  for (const Enclosure& p : known) {
    const double beside = 0.4 * enough(p, asked);
    at.push_back({p.lower + beside, p.lower + beside});
    at.push_back({p.upper - beside, p.upper - beside});
  }
  const std::vector<Enclosure> shares = shares_within(store, areas, at);
  std::vector<bool> jumps;
  for (size_t i = 0; i < known.size(); ++i) {
    const bool is_wide = width(known[i]) > enough(known[i], asked);
    jumps.push_back(is_wide && most_between(shares[2 * i], shares[2 * i + 1]) <= kNearlyNone);
  }
  return jumps;
}

struct Bands {
  std::vector<Enclosure> shares;
  std::vector<bool> jumps;
};

// The shares, and whether each that is undecided is so for ever: but for what is enough, the
// undecided area is proven to lie at that distance, as well as floats tell.
Bands shares_of(const CellStore& store, const Areas& areas, const Asked& asked,
                const std::vector<Threshold>& bands) {
  std::vector<Threshold> at;
  for (const Threshold& band : bands) {
    at.push_back(band);
    at.push_back({band.down - asked.least, band.down - asked.least});
    at.push_back({band.up + asked.least, band.up + asked.least});
  }
  const std::vector<Enclosure> all = shares_within(store, areas, at);
  Bands found;
  for (size_t i = 0; i < bands.size(); ++i) {
    const Enclosure &share = all[3 * i], &before = all[3 * i + 1], &behind = all[3 * i + 2];
    const double there = behind.lower - before.upper;
    const double tolerance = asked.options.area_tolerance;
    found.shares.push_back(share);
    found.jumps.push_back(width(share) > tolerance && width(share) - there <= tolerance);
  }
  return found;
}

// Scores a cell by the area that is undecided in shares that are too wide.
Scores score_shares(const CellStore& store, const Areas& areas, const Asked& asked) {
  const std::vector<Threshold> bands = bands_of(asked);
  const auto [shares, atoms] = shares_of(store, areas, asked, bands);
  std::vector<Threshold> open;
  double part = 0;
  for (size_t i = 0; i < bands.size(); ++i) {
    const bool is_left_so = atoms[i] && !asked.options.enough;
    if (is_enough(shares[i], i, asked.options) || is_left_so) continue;
    open.push_back(bands[i]);
    part = std::max(part, part_to_split(width_of_share(shares[i], i, asked.options),
                                        asked.options.area_tolerance));
  }
  if (open.empty()) return {{}, true};
  Scores scores = score_undecided(store, areas, open);
  scores.part = asked.options.enough ? Scores::kNearlyAll : part;
  return scores;
}

// A percentile's own width differs from its distribution's: at both ends of it there may be area
// that is undecided.
Scores score_percentiles(const CellStore& store, const Areas& areas, const Asked& asked,
                         std::vector<Enclosure>& known) {
  std::vector<Threshold> open;
  known =
      percentiles(store, areas, {asked.options.percentiles, resolution_of(store, asked), known});
  const std::vector<bool> gaps = jumps_of(store, areas, asked, known);
  for (size_t i = 0; i < known.size(); ++i) {
    if (width(known[i]) <= enough(known[i], asked) || gaps[i]) continue;
    open.push_back({known[i].lower, known[i].lower});
    open.push_back({known[i].upper, known[i].upper});
  }
  if (open.empty()) return {{}, true};
  return score_undecided(store, areas, open);
}

// Scores a cell by its part of the width of the mean, and then of its square's: of those that have
// a goal.
Scores score_moments(const CellStore& store, const Areas& areas, const Asked& asked) {
  const Moments moments = moments_of(store, areas);
  const auto is_open = [&](const Enclosure& e) { return width(e) > enough(e, asked); };
  const bool by_mean = asked.options.narrows_mean && is_open(moments.mean);
  if (!by_mean && !(asked.options.narrows_rms && is_open(moments.rms))) return {{}, true};
  const Enclosure& open = by_mean ? moments.mean : moments.rms;
  Scores scores = scored(store, [&](size_t i) -> std::optional<double> {
    const gpu::CellBounds& b = store.bounds(i);
    if (spread(b) <= kFloor) return 0;
    const double down = mean_lower(b), up = static_cast<double>(b.mean_upper);
    const double squares = static_cast<double>(b.square_upper) - down * down;
    return area_of(store, areas, i) * (by_mean ? up - down : squares);
  });
  scores.part = part_to_split(width(open), enough(open, asked));
  return scores;
}

}  // namespace

double largest_upper(const CellStore& store, const SurveyedPair& pair) {
  const std::vector<float> highest = store.highest_of_faces();
  const float most = *std::max_element(highest.begin(), highest.end());
  return in_files(pair, {0, static_cast<double>(most)}).upper;
}

double least_width(const SurveyedPair& pair) {
  return std::max(1e-6 * pair.frame.to_frame(diagonal(bounding_box(pair.a))), 3 * kFloor);
}

Enclosure in_files(const SurveyedPair& pair, const Enclosure& lengths) {
  const FileInterval f =
      pair.frame.to_files(lengths.lower, lengths.upper, pair.displacement, pair.farthest);
  return {f.lower, f.upper};
}

std::vector<Threshold> only_shares_of(const SurveyOptions& options, const SurveyedPair& pair) {
  const bool has_lengths =
      options.narrows_mean || options.narrows_rms || options.narrows_percentiles;
  if (has_lengths || options.map || options.normals_within || options.max_distance) return {};
  return bands_of({options, pair.displacement, pair.frame, least_width(pair)});
}

std::vector<Goal> goals_of(const SurveyOptions& options, const SurveyedPair& pair,
                           const Areas& areas, std::vector<Enclosure>& known) {
  std::vector<Goal> goals;
  Asked asked{options, pair.displacement, pair.frame, least_width(pair)};
  // The share that is kept is sought as narrowly as any share.
  if (options.max_distance) asked.options.bands.push_back(options.max_distance->within);
  if (options.faces && options.limit.within > 0)
    goals.emplace_back([asked](const CellStore& store) { return score_verdicts(store, asked); });
  if (options.faces)
    goals.emplace_back([asked](const CellStore& store) { return score_faces(store, asked); });
  if (!options.statistics || !areas.is_positive()) return goals;
  if (!asked.options.bands.empty()) {
    goals.emplace_back(
        [&areas, asked](const CellStore& store) { return score_shares(store, areas, asked); });
  }
  if (options.narrows_mean || options.narrows_rms) {
    goals.emplace_back(
        [&areas, asked](const CellStore& store) { return score_moments(store, areas, asked); });
  }
  if (options.narrows_percentiles) {
    goals.emplace_back([&areas, &known, asked](const CellStore& store) {
      return score_percentiles(store, areas, asked, known);
    });
  }
  return goals;
}

namespace {

constexpr int kCurveSteps = 100;

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

void add_jumps(const CellStore& store, const Areas& areas, const Asked& asked,
               std::vector<AreaWithin>& bands) {
  const std::vector<bool> jumps = shares_of(store, areas, asked, bands_of(asked)).jumps;
  // All area is within a band that no distance exceeds, whatever its threshold says.
  for (size_t i = 0; i < bands.size(); ++i)
    bands[i].jump = jumps[i] && width(bands[i].share) > asked.options.area_tolerance;
}

std::vector<AreaWithin> curve_of(const CellStore& store, const Areas& areas, const Asked& asked) {
  std::vector<double> steps;
  for (int k = 0; k <= kCurveSteps; ++k) steps.push_back(asked.largest * k / kCurveSteps);
  return within(store, areas, asked, steps);
}

}  // namespace

std::optional<Statistics> statistics_of(const SurveyedArea& surface, const SurveyedPair& pair,
                                        const SurveyOptions& options, const Estimates& estimates) {
  const auto& [store, areas, known] = surface;
  if (!areas.is_positive()) return std::nullopt;
  const double last = largest_upper(store, pair);
  const double area = areas.unit.length_up(areas.unit.length_up(areas.whole));
  if (!std::isfinite(last) || !std::isfinite(area)) return std::nullopt;
  const Asked asked{options, pair.displacement, pair.frame, least_width(pair), last};
  const Moments moments = moments_of(store, areas);
  Statistics s;
  if (pair.a.are_points) {
    s.points = pair.a.faces.size();
  } else {
    s.area = area;
  }
  s.mean = in_files(pair, moments.mean);
  s.rms = in_files(pair, moments.rms);
  s.bands = within(store, areas, asked, options.bands);
  add_jumps(store, areas, asked, s.bands);
  const std::vector<Enclosure> at =
      percentiles(store, areas, {options.percentiles, resolution_of(store, asked), known});
  const std::vector<bool> gaps = jumps_of(store, areas, asked, at);
  for (size_t i = 0; i < at.size(); ++i)
    s.percentiles.push_back({options.percentiles[i], in_files(pair, at[i]), gaps[i]});
  if (estimates.serve_all()) s.curve = curve_of(store, areas, asked);
  add_estimates(estimates, pair, at, s);
  if (options.max_distance) keep_within({store, areas, known}, pair, options, s);
  return s;
}

}  // namespace vkh
