#include "host/survey/surveying.h"

#include <algorithm>
#include <utility>

#include "host/survey/face_goals.h"
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

// Whether the host goes on with the cells.
bool has_host_goals(const SurveyOptions& options) {
  return options.normals_within || finds_sides(options);
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
  if (goes_by_waves()) {
    waves_.emplace(pair_, areas_, meter_, farthest());
    distances_ = &*waves_;
    refine_by_waves(result);
  }
  if (waves_ && !has_host_goals(options_)) {
    add_field(result);
    add_figures(result);
  } else {
    refine_store(result);
  }
  if (options_.map && areas_.is_positive()) add_map(result);
  result.ended = std::max(result.ended, meter_.ended());
  if (options_.statistics && !result.statistics)
    result.ended = std::max(result.ended, SurveyEnd::kBits);
  add_counts(result);
}

bool Surveying::goes_by_waves() const { return pair_.cells != nullptr && !pair_.a.are_points; }

// No distance is above it, in the frame.
float Surveying::farthest() const {
  const double most = pair_.frame.to_frame(pair_.farthest) * (1 + 1e-6) + pair_.displacement;
  return static_cast<float>(std::min(most * (1 + 1e-6), 1e38));
}

// A picture may take half of the effort before figures, and what they leave after them; all of it
// may take half where there are goals of faces, or the host goes on.
void Surveying::refine_by_waves(SurveyResult& result) {
  const bool has_more = options_.faces || has_host_goals(options_);
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

// The host takes the cells over, and goes on.
void Surveying::refine_store(SurveyResult& result) {
  take_cells();
  std::vector<Goal> goals = goals_of(options_, pair_);
  if (sided_) add_signed_goals(*sided_, options_, areas_, goals);
  if (options_.normals_within && options_.statistics && !pair_.a.are_points && !pair_.b.are_points)
    normals_.emplace(pair_, options_, areas_, [this] { return meter_.goes_on(); });
  if (normals_ && areas_.is_positive()) normals_->add_goals(goals);
  result.ended = std::max(result.ended, refining_.refine(*store_, goals));
  result.field = field_of(store_->reached_of_faces(), store_->highest_of_faces(), pair_);
  if (sided_) result.sides = sided_->figures({*store_, areas_}, options_);
  result.ended = std::max(result.ended, meter_.ended());
  stored_ = std::make_unique<StoredDistances>(*store_, areas_);
  distances_ = stored_.get();
  add_figures(result);
  if (result.statistics && normals_) add_normals(*result.statistics);
}

void Surveying::take_cells() {
  if (waves_) {
    store_.emplace(waves_->store());
    waves_.reset();
  } else {
    store_.emplace(pair_.a, farthest());
    refining_.bound_faces(*store_);
  }
}

void Surveying::add_field(SurveyResult& result) {
  const std::span<const float> faces = waves_->faces();
  const size_t count = faces.size() / 2;
  result.field = field_of(faces.first(count), faces.last(count), pair_);
}

void Surveying::add_figures(SurveyResult& result) {
  if (options_.statistics) result.statistics = statistics_of(*distances_, areas_, pair_, options_);
  if (result.statistics) add_middles(has_only_shares(options_), *result.statistics);
}

void Surveying::add_normals(Statistics& statistics) {
  const Estimates estimates(pair_, *store_, [this] { return meter_.is_wanted(); });
  normals_->add_figures(*store_, estimates, statistics);
}

// Figures may be asked for afterwards where the cells are.
void Surveying::add_map(SurveyResult& result) {
  if (!store_) store_.emplace(waves_->store());
  CellMap map = map_of({*store_, areas_}, pair_, options_);
  if (sided_) add_sides(sided_->of(*store_), map);
  if (has_cheap_sides_)
    add_cheap_sides(
        pair_, *store_, [this] { return meter_.sides_go_on(); }, map);
  result.map = std::make_shared<const CellMap>(std::move(map));
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
