#include "host/survey/surveying.h"

#include <algorithm>
#include <utility>

#include "host/survey/map_goal.h"
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

// Whether something besides the figures of a surface is asked for, which cells are split for, too.
bool has_other_goals(const SurveyOptions& options) {
  return options.faces || options.normals_within || finds_sides(options);
}

// Whether the host must hold the cells.
bool needs_store(const SurveyOptions& options) {
  return has_other_goals(options) || options.max_distance || options.map;
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
      refining_(pair_, meter_),
      areas_(areas_of(pair.a)) {
  if (options.statistics) refuse_any_triangulation(pair.a, pair.b, "statistics of an area");
  check_shares(options.percentiles);
  if (!finds_sides(options)) return;
  refuse_any_triangulation(pair.a, pair.b, "sides");
  refuse_conflicts(pair.b);
  sided_.emplace(pair_, [this] { return meter_.sides_go_on(); });
}

void Surveying::run(SurveyResult& result) {
  result.faces = options_.faces;
  result.ended = SurveyEnd::kMet;
  if (goes_by_waves()) run_by_waves(result);
  if (distances_ == nullptr) run_on_store(result);
  if (options_.statistics && !result.statistics)
    result.ended = std::max(result.ended, SurveyEnd::kBits);
  add_counts(result);
}

bool Surveying::goes_by_waves() const {
  return pair_.cells != nullptr && (options_.statistics || options_.map) && !pair_.a.are_points &&
         areas_.is_positive();
}

// No distance is above it, in the frame.
float Surveying::farthest() const {
  const double most = pair_.frame.to_frame(pair_.farthest) * (1 + 1e-6) + pair_.displacement;
  return static_cast<float>(std::min(most * (1 + 1e-6), 1e38));
}

// A picture may take half of the effort before figures, and what they leave after them. If the host
// must hold the cells, it takes over.
void Surveying::run_by_waves(SurveyResult& result) {
  waves_.emplace(pair_, areas_, meter_, farthest());
  const size_t effort = meter_.effort() / (has_other_goals(options_) ? 2 : 1);
  std::optional<MapGoals> map;
  if (options_.map) map.emplace(options_, pair_, areas_, waves_->farthest());
  const auto refine_map = [&](size_t most) {
    map->begin_coarse();
    waves_->refine(*map, most);
    map->begin_fine();
    return waves_->refine(*map, most);
  };
  if (map) refine_map(effort / 2);
  if (options_.statistics) {
    FigureGoals goals(options_, pair_, waves_->farthest());
    result.ended = std::max(result.ended, waves_->refine(goals, effort));
    known_ = goals.percentiles();
  }
  if (map) result.ended = std::max(result.ended, refine_map(effort));
  if (needs_store(options_)) {
    store_.emplace(waves_->store());
    return waves_.reset();
  }
  distances_ = &*waves_;
  const std::span<const float> faces = waves_->faces();
  const size_t count = faces.size() / 2;
  result.field = field_of(faces.first(count), faces.last(count), pair_);
  result.statistics = statistics_of(*distances_, areas_, known_, pair_, options_);
  if (result.statistics) add_middles(has_only_shares(options_), *result.statistics);
}

void Surveying::run_on_store(SurveyResult& result) {
  if (!store_) {
    store_.emplace(pair_.a, farthest());
    refining_.bound_faces(*store_);
  }
  std::vector<Goal> goals = goals_of(options_, pair_);
  if (sided_) add_signed_goals(*sided_, options_, areas_, goals);
  if (options_.normals_within && options_.statistics && !pair_.a.are_points && !pair_.b.are_points)
    normals_.emplace(pair_, options_, areas_, [this] { return meter_.goes_on(); });
  if (normals_ && areas_.is_positive()) normals_->add_goals(goals);
  result.ended = std::max(result.ended, refining_.refine(*store_, goals));
  result.field = field_of(store_->reached_of_faces(), store_->highest_of_faces(), pair_);
  if (sided_) result.sides = sided_->figures({*store_, areas_, known_}, options_);
  result.ended = std::max(result.ended, meter_.ended());
  stored_ = std::make_unique<StoredDistances>(*store_, areas_);
  distances_ = stored_.get();
  if ((options_.statistics || options_.map) && areas_.is_positive()) add_figures(result);
  result.ended = std::max(result.ended, meter_.ended());
}

void Surveying::add_figures(SurveyResult& result) {
  if (options_.statistics)
    result.statistics = statistics_of(*distances_, areas_, known_, pair_, options_);
  if (result.statistics) {
    const SurveyedArea surface{*store_, areas_, known_};
    if (options_.max_distance) keep_within(surface, pair_, options_, *result.statistics);
    add_middles(has_only_shares(options_), *result.statistics);
    if (normals_) add_normals(*result.statistics);
  }
  if (options_.map) add_map(result);
}

void Surveying::add_normals(Statistics& statistics) {
  const Estimates estimates(pair_, *store_, [this] { return meter_.is_wanted(); });
  normals_->add_figures(*store_, estimates, statistics);
}

void Surveying::add_map(SurveyResult& result) {
  result.map = map_of({*store_, areas_, known_}, pair_, options_);
  if (sided_) add_sides(sided_->of(*store_), *result.map);
  if (has_cheap_sides_)
    add_cheap_sides(
        pair_, *store_, [this] { return meter_.sides_go_on(); }, *result.map);
}

void Surveying::add_counts(SurveyResult& result) const {
  result.cells = waves_ ? waves_->count() : store_->count();
  result.effort = meter_.effort();
  result.bounded = meter_.bounded();
  result.device_ms = meter_.device_ms();
  result.ms = meter_.ms();
}

bool Surveying::narrow(const PooledSearch& search, double time_limit_s, SurveyResult& result) {
  const size_t before = result.cells;
  meter_.go_on(time_limit_s);
  if (waves_) {
    const Distribution own = distribution();
    PooledGoals goals(search, own, pair_);
    waves_->refine(goals, meter_.effort());
  } else {
    refining_.refine(*store_, {pooled_goal(search, pair_, areas_)});
  }
  add_counts(result);
  return result.cells > before;
}

}  // namespace vkh
