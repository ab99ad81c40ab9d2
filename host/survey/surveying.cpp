#include "host/survey/surveying.h"

#include <algorithm>
#include <utility>

#include "host/survey/face_goals.h"
#include "host/survey/map_goal.h"
#include "host/survey/normal_goals.h"
#include "host/survey/normals.h"
#include "host/survey/sided_goals.h"
#include "host/survey/signed_figures.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

void check_shares(const std::vector<double>& shares) {
  for (const double share : shares) {
    if (!(share >= 0 && share <= 1))
      throw UsageError("percentile " + std::to_string(share) +
                       ": a share of the area from 0 to 1 is expected, such as 0.95");
  }
}

bool finds_sides(const SurveyOptions& options) { return options.is_signed || options.sided; }

bool has_normals(const SurveyOptions& options, const SurveyedPair& pair) {
  return options.normals_within && options.statistics && !pair.a.are_points && !pair.b.are_points;
}

SurveyedPair with_upper(SurveyedPair pair, double upper) {
  pair.farthest = std::min(pair.farthest, upper);
  return pair;
}

// `reached` and `highest`: of each face, in the frame.
Field field_of(std::span<const float> reached, std::span<const float> highest,
               const SurveyedPair& pair) {
  Field field;
  for (size_t f = 0; f < highest.size(); ++f) {
    const Enclosure e =
        in_files(pair, {static_cast<double>(reached[f]), static_cast<double>(highest[f])});
    field.lower.push_back(std::min(e.lower, e.upper));
    field.upper.push_back(e.upper);
  }
  return field;
}

}  // namespace

Surveying::Surveying(const SurveyedPair& pair, const SurveyOptions& options)
    : pair_(with_upper(pair, options.upper)),
      options_(options),
      has_cheap_sides_(may_have_cheap_sides(options, pair_)),
      meter_(options, pair.on_cpu, finds_sides(options) || has_cheap_sides_),
      areas_(areas_of(pair.a)) {
  if (options.statistics) refuse_any_triangulation(pair.a, pair.b, "statistics of an area");
  check_shares(options.percentiles);
  if (!finds_sides(options)) return;
  refuse_any_triangulation(pair.a, pair.b, "sides");
  refuse_conflicts(pair.b);
  const double start = meter_.ms();
  sides_.emplace(pair_, [this] { return meter_.sides_go_on(); });
  meter_.note_sides(meter_.ms() - start);
}

void Surveying::run(SurveyResult& result) {
  result.faces = options_.faces;
  result.ended = SurveyEnd::kMet;
  waves_.emplace(pair_, areas_, meter_, farthest());
  if (pair_.a.are_points) {
    result.ended = measure_points();
  } else {
    refine(result);
  }
  if (sides_) result.ended = std::max(result.ended, refine_sides());
  const std::span<const float> faces = waves_->faces();
  result.field = field_of(faces.first(faces.size() / 2), faces.last(faces.size() / 2), pair_);
  if (options_.statistics) add_figures(result);
  if (sides_) add_sides_of_all(result);
  if (options_.map && areas_.is_positive()) add_map(result);
  waves_->end_sides();
  if (has_normals(options_, pair_) && result.statistics) add_normals(result);
  if (result.statistics) add_middles(has_only_shares(options_), *result.statistics);
  result.ended = std::max(result.ended, meter_.ended());
  if (options_.statistics && !result.statistics)
    result.ended = std::max(result.ended, SurveyEnd::kBits);
  add_counts(result);
}

// An upper bound of all distances, in the frame.
float Surveying::farthest() const {
  const double most = pair_.frame.to_frame(pair_.farthest) * (1 + 1e-6) + pair_.displacement;
  return static_cast<float>(std::min(most * (1 + 1e-6), 1e38));
}

// A point takes as much of the effort as a split.
SurveyEnd Surveying::measure_points() {
  if (!options_.statistics && !sides_) return SurveyEnd::kMet;
  const FiguresAsked asked(options_, pair_);
  std::vector<Threshold> cuts = asked.bands();
  if (options_.sided) {
    for (const Limit& limit : {options_.sided->over, options_.sided->under})
      cuts.push_back(asked.threshold(limit));
  }
  const bool are_all = waves_->measure({cuts, asked.least / 2}, meter_.effort() / 2).are_all;
  return are_all ? SurveyEnd::kMet : SurveyEnd::kEffort;
}

// A picture may take half of the effort before figures, and what they leave after them; all of it
// may take half where there are goals of faces or sides, or the host goes on.
void Surveying::refine(SurveyResult& result) {
  const bool has_more = options_.faces || sides_ || has_normals(options_, pair_);
  const size_t effort = meter_.effort() / (has_more ? 2 : 1);
  std::optional<MapGoals> map;
  if (options_.map && areas_.is_positive())
    map.emplace(options_, pair_, areas_, waves_->farthest());
  const auto refine_map = [&](size_t most) {
    map->begin_coarse();
    waves_->refine(*map, most);
    map->begin_fine();
    return waves_->refine(*map, most);
  };
  if (map) refine_map(effort / 2);
  if (options_.statistics && areas_.is_positive()) {
    if (map) find_cheap_sides(map->bar());  // cells that are split hand them on
    FigureGoals goals(options_, pair_, waves_->farthest());
    result.ended = std::max(result.ended, waves_->refine(goals, effort));
  }
  if (map) result.ended = std::max(result.ended, refine_map(effort));
  if (options_.faces) result.ended = std::max(result.ended, refine_faces(meter_.effort()));
}

// Verdicts first.
SurveyEnd Surveying::refine_faces(size_t effort) {
  FaceGoals goals(options_, pair_, *waves_);
  SurveyEnd ended = SurveyEnd::kMet;
  if (options_.limit.within > 0) {
    goals.begin_verdicts();
    ended = waves_->refine(goals, effort);
  }
  goals.begin_widths();
  return std::max(ended, waves_->refine(goals, effort));
}

// Splitting a point gains nothing.
SurveyEnd Surveying::refine_or_look(WaveGoals& goals, AreaDistances& distances) {
  if (!pair_.a.are_points) return waves_->refine(goals, meter_.effort(), distances);
  waves_->look(goals, distances);
  return goals.are_met() ? SurveyEnd::kMet : SurveyEnd::kBits;
}

// Limits first: they need sides only where something may be beyond them.
SurveyEnd Surveying::refine_sides() {
  SurveyEnd ended = SurveyEnd::kMet;
  if (options_.sided) {
    SidedLimitGoals limits(options_, pair_, *waves_);
    waves_->find_sides(sides_->search(), limits.least());
    ended = refine_or_look(limits, *waves_);
  }
  waves_->find_sides(sides_->search(), -1);
  signed_.emplace(*waves_);
  if (!options_.is_signed || !areas_.is_positive()) return ended;
  if (!options_.sided) {
    UnsidedGoals area(*waves_);
    ended = std::max(ended, refine_or_look(area, *waves_));
  }
  if (!options_.statistics) return ended;
  SignedGoals goals(options_, pair_, *signed_);
  return std::max(ended, refine_or_look(goals, *signed_));
}

void Surveying::add_figures(SurveyResult& result) {
  result.statistics = statistics_of(*waves_, areas_, pair_, options_);
}

void Surveying::add_sides_of_all(SurveyResult& result) {
  result.sides = signed_figures(pair_, areas_, options_, *sides_, *signed_);
  result.sides->ms = meter_.sides_ms();
}

void Surveying::add_normals(SurveyResult& result) {
  const Normals normals(pair_, *options_.normals_within);
  waves_->find_normals(normals.search());
  NormalGoals goals(options_, pair_, *waves_);
  result.ended = std::max(result.ended, waves_->refine(goals, meter_.effort()));
  waves_->end_normals();
  Statistics& s = *result.statistics;
  const Tallied found = goals.figures();
  s.normal_cosine = found.moments.mean;
  for (size_t i = 0; i < s.bands.size(); ++i) s.bands[i].agreeing = found.shares[i];
}

void Surveying::add_map(SurveyResult& result) {
  CellMap map = map_of(*waves_, areas_, pair_, options_);
  map.has_sides = sides_.has_value();
  if (find_cheap_sides(pair_.frame.to_frame(map.bar))) {
    add_sides(*waves_, map);
    map.inside_out = cheap_sides_->shells().inside_out();
  }
  result.map = std::make_shared<const CellMap>(std::move(map));
}

// Finds sides, if B bounds a solid, of the cells that have none and are farther than what looks
// like 0 beside a bar of that length, in the frame. Returns whether time was left for all of them.
bool Surveying::find_cheap_sides(double bar) {
  if (!has_cheap_sides_) return false;
  if (!cheap_sides_) cheap_sides_.emplace(pair_, [this] { return meter_.sides_go_on(); });
  if (!cheap_sides_->is_solid()) return false;
  SideSearch search = cheap_sides_->search();
  const double near = near_zero(bar, waves_->reached());
  search.near = static_cast<float>(near);
  return waves_->find_sides(search, near);
}

void Surveying::add_counts(SurveyResult& result) const {
  result.cells = waves_->count();
  result.effort = meter_.effort();
  result.bounded = meter_.bounded();
  result.device_ms = meter_.device_ms();
  result.ms = meter_.ms();
}

bool Surveying::narrow(const PooledSearch& search, double time_limit_s, SurveyResult& result) {
  const size_t before = result.cells;
  meter_.go_on(time_limit_s);
  const Distribution own = distribution();
  PooledGoals goals(search, own, pair_);
  size_t measured = 0;
  if (pair_.a.are_points) {
    goals.look({});
    if (!goals.are_met()) {
      const std::vector<Threshold> ends = goals.ends();
      measured = waves_->measure({ends, kAnyDistance}, meter_.effort_left() / 2).count;
    }
  } else {
    waves_->refine(goals, meter_.effort());
  }
  add_counts(result);
  return result.cells > before || measured > 0;
}

}  // namespace vkh
