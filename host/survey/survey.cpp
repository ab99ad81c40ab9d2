#include "vkhausdorff/survey.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "host/base/parallel.h"
#include "host/survey/distribution.h"
#include "host/survey/goals.h"
#include "host/survey/map_goal.h"
#include "host/survey/normals.h"
#include "host/survey/point_distances.h"
#include "host/survey/pooled.h"
#include "host/survey/signed_figures.h"
#include "host/survey/survey_meter.h"
#include "host/survey/survey_with.h"
#include "host/survey/wave_survey.h"
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

// Bounds cells in batches, until time or the caller ends it. How large batches are decides neither
// the cells' numbers nor their bounds.
class Bounding {
 public:
  Bounding(const SurveyedPair& pair, SurveyMeter& meter) : pair_(pair), meter_(meter) {}

  // Bounds whole faces.
  void faces(CellStore& store) {
    all(store.count(), [&](size_t first, std::span<gpu::CellBounds> bounds) {
      bound({.cells = {}, .first = static_cast<uint32_t>(first), .bounds = bounds});
      which_.resize(bounds.size());
      std::iota(which_.begin(), which_.end(), first);
      store.narrow(which_, bounds);
    });
  }

  // Halves cells, and bounds both halves: none is left that is split and not bounded.
  void halves(CellStore& store, std::span<const size_t> which) {
    std::vector<gpu::Cell> asked;
    std::vector<size_t> parents;
    all(2 * which.size(), [&](size_t first, std::span<gpu::CellBounds> bounds) {
      parents.clear();
      which_.clear();
      for (size_t i = first / 2; i < (first + bounds.size()) / 2; ++i) {
        which_.push_back(which[i]);
        which_.push_back(store.count() + parents.size());
        parents.push_back(which[i]);
      }
      store.split(parents);
      asked.clear();
      for (const size_t i : which_) asked.push_back(store.cell(i));
      bound({.cells = asked, .first = 0, .bounds = bounds});
      store.narrow(which_, bounds);
      meter_.spend(bounds.size());
    });
  }

  // Measures points, each once and for ever. A point takes as much of the effort as a split.
  void points(CellStore& store, std::span<const size_t> which) {
    if (!distances_) distances_.emplace(pair_);
    all(which.size(), [&](size_t first, std::span<gpu::CellBounds> bounds) {
      const std::span<const size_t> some = which.subspan(first, bounds.size());
      for_each_range_of(kPointsOfThread, some.size(), [&](size_t, size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k)
          bounds[k] = distances_->narrowed(store.face(some[k]), store.bounds(some[k]));
      });
      store.narrow(some, bounds);
      store.close(some);
      meter_.spend(2 * some.size());
    });
  }
  bool are_points() const { return pair_.a.are_points; }

  SurveyMeter& meter() { return meter_; }

 private:
  void bound(const CellBatch& batch) {
    meter_.on_device([&] { pair_.bound(batch); });
  }

  template <class Work>
  void all(size_t count, const Work& work) {
    for (size_t first = 0; first < count && (meter_.bounded() == 0 || meter_.goes_on());) {
      std::vector<gpu::CellBounds> bounds(std::min(meter_.batch(), count - first));
      const double start = meter_.ms();
      work(first, bounds);
      first += bounds.size();
      meter_.note_bounded(bounds.size());
      meter_.note_batch(bounds.size(), meter_.ms() - start);
    }
  }

  static constexpr size_t kPointsOfThread = 256;
  const SurveyedPair& pair_;
  SurveyMeter& meter_;
  std::vector<size_t> which_;  // cells of a batch
  std::optional<PointDistances> distances_;
};

constexpr size_t kFewestSplits = 2048;  // for a pass: the host looks at all cells between two

// A score as an integer up to 2^31, so that the sum of 2^32 of them is the same in any order.
uint64_t weight(double score, double largest) {
  return static_cast<uint64_t>(score / largest * 0x1p31);
}

// Moves the cells that matter most to the front, those with `part` of all scores, and returns how
// many they are: `most` at most. Which they are follows from scores and numbers of cells alone,
// which are a total order.
size_t count_that_matter(std::vector<Scored>& scored, double part, size_t most) {
  double largest = 0;
  for (const Scored& s : scored) largest = std::max(largest, s.score);
  uint64_t whole = 0, chosen = 0;
  for (const Scored& s : scored) whole += weight(s.score, largest);
  most = std::min(most, scored.size());
  const auto wanted = static_cast<uint64_t>(part * static_cast<double>(whole));
  size_t count = 0;
  for (size_t next = kFewestSplits; count < most && chosen < wanted; next *= 2) {
    const size_t end = std::min(next, most);
    const auto at = [&](size_t i) { return scored.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(count), at(end - 1), scored.end());
    if (count > 0) std::sort(at(count), at(end));
    for (; count < end && (count < kFewestSplits || chosen < wanted); ++count)
      chosen += weight(scored[count].score, largest);
  }
  return count;
}

// The cells to split, by their numbers: the halves' numbers follow from this order. A cell whose
// halves would be chosen, too, is halved here at once, without bounds of them: with half the area
// and about half the width a half has a quarter of the score.
std::vector<size_t> chosen_cells(CellStore& store, Scores& scores, size_t most) {
  constexpr double kOfHalf = 0.25, kSmallest = 0x1p-30;  // of a face: bits may run out below
  const size_t count = count_that_matter(scores.cells, scores.part, most);
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < count; ++i) least = std::min(least, scores.cells[i].score);
  std::vector<uint8_t> times(store.count());
  for (size_t i = 0; i < count; ++i) {
    const bool is_twice = count < most && kOfHalf * scores.cells[i].score >= least &&
                          store.share(scores.cells[i].cell) >= kSmallest;
    times[scores.cells[i].cell] = is_twice ? 2 : 1;
    most -= is_twice ? 1 : 0;
  }
  std::vector<size_t> cells, halved;
  for (size_t i = 0; i < times.size(); ++i) {
    if (times[i] > 0) cells.push_back(i);
    if (times[i] == 2) halved.push_back(i);
  }
  const size_t first = store.count();
  store.split(halved);
  for (size_t k = 0; k < halved.size(); ++k) cells.push_back(first + k);
  std::erase_if(cells, [&](size_t i) { return !store.can_split(i); });
  return cells;
}

// The points to measure, by their numbers.
std::vector<size_t> chosen_points(Scores& scores, size_t most) {
  const size_t count = count_that_matter(scores.cells, Scores::kNearlyAll, most);
  std::vector<size_t> points;
  points.reserve(count);
  for (size_t i = 0; i < count; ++i) points.push_back(scores.cells[i].cell);
  std::sort(points.begin(), points.end());
  return points;
}

// The number of cells that may still be halved.
size_t splits_left(const SurveyMeter& meter) { return meter.effort_left() / 2; }

// Refines until the goal is met, or cannot be, by splits of `budget` cells.
SurveyEnd refine(CellStore& store, Bounding& bounding, const Goal& goal, size_t budget) {
  SurveyMeter& meter = bounding.meter();
  const size_t kept = splits_left(meter) - budget;
  for (;;) {
    Scores scores = goal(store);
    if (scores.is_met) return SurveyEnd::kMet;
    if (scores.cells.empty()) return SurveyEnd::kBits;
    const size_t most =
        std::min(std::max(store.count() / 2, kFewestSplits), splits_left(meter) - kept);
    if (most == 0) return SurveyEnd::kEffort;
    if (!meter.goes_on()) return meter.ended();
    if (bounding.are_points()) {
      bounding.points(store, chosen_points(scores, most));
    } else {
      bounding.halves(store, chosen_cells(store, scores, most));
    }
  }
}

// Refines for one goal after the other.
SurveyEnd refine_all(CellStore& store, Bounding& bounding, const std::vector<Goal>& goals) {
  SurveyEnd ended = bounding.meter().ended();  // before all faces are bounded, perhaps
  for (const Goal& goal : goals)
    ended = std::max(ended, refine(store, bounding, goal, splits_left(bounding.meter())));
  return ended;
}

// A picture may take half of the effort before figures, and what they leave after them.
SurveyEnd refine_map(CellStore& store, Bounding& bounding, const std::optional<Goal>& map,
                     bool is_last) {
  if (!map) return bounding.meter().ended();
  return refine(store, bounding, *map, splits_left(bounding.meter()) / (is_last ? 1 : 2));
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

// Returns nothing unless sides are asked for.
std::optional<SidedCells> sided_cells(const SurveyedPair& pair, const SurveyOptions& options,
                                      SurveyMeter& meter) {
  if (!finds_sides(options)) return {};
  refuse_any_triangulation(pair.a, pair.b, "sides");
  refuse_conflicts(pair.b);
  return std::optional<SidedCells>(std::in_place, pair, [&] { return meter.sides_go_on(); });
}

}  // namespace

const char* survey_end_name(SurveyEnd end) {
  switch (end) {
    case SurveyEnd::kMet:
      return "met";
    case SurveyEnd::kBits:
      return "bits";
    case SurveyEnd::kEffort:
      return "effort";
    case SurveyEnd::kTime:
      return "time";
    case SurveyEnd::kCancelled:
      return "cancelled";
    case SurveyEnd::kMemory:
      return "memory";
  }
  return "";
}

size_t default_effort(bool on_cpu) { return on_cpu ? 4'000'000 : 10'000'000; }

FieldSummary summary_of(const Field& field, const Limit& limit) {
  FieldSummary summary{.faces = field.face_count()};
  for (size_t f = 0; f < field.face_count(); ++f) {
    summary.width = std::max(summary.width, field.upper[f] - field.lower[f]);
    const Verdict verdict = verdict_of(field, f, limit);
    ++(verdict == Verdict::kWithin   ? summary.within
       : verdict == Verdict::kBeyond ? summary.beyond
                                     : summary.undecided);
  }
  return summary;
}

Verdict verdict_of(const Enclosure& over, const Enclosure& under, const SidedLimits& limits) {
  const Verdict of_over = verdict_of(over.lower, over.upper, limits.over);
  const Verdict of_under = verdict_of(under.lower, under.upper, limits.under);
  if (of_over == Verdict::kBeyond || of_under == Verdict::kBeyond) return Verdict::kBeyond;
  return of_over == Verdict::kWithin ? of_under : of_over;
}

FieldSummary summary_of(const Field& field, const SignedFigures& sides, const SidedLimits& limits) {
  FieldSummary summary = summary_of(field, limits.larger());
  summary.within = summary.beyond = summary.undecided = 0;
  for (size_t f = 0; f < sides.over_of_faces.face_count(); ++f) {
    const Verdict verdict =
        verdict_of(sides.over_of_faces.of(f), sides.under_of_faces.of(f), limits);
    ++(verdict == Verdict::kWithin   ? summary.within
       : verdict == Verdict::kBeyond ? summary.beyond
                                     : summary.undecided);
  }
  return summary;
}

Field field_within(size_t face_count, double upper) {
  return {std::vector<double>(face_count, 0.0), std::vector<double>(face_count, upper)};
}

SurveyResult survey_mesh(Solver& solver, const PairView& pair, const SurveyOptions& options,
                         const SolveOptions& run) {
  SurveyResult result;
  hold_pair(solver, pair, run, survey_with(options, result));
  return result;
}

namespace {

// Whether something besides the figures of a surface is asked for, which cells are split for, too.
bool has_other_goals(const SurveyOptions& options) {
  return options.faces || options.map || options.normals_within || finds_sides(options);
}

// Whether the host must hold the cells.
bool needs_store(const SurveyOptions& options) {
  return has_other_goals(options) || options.max_distance || options.keeps_distribution;
}

// One survey: the figures of a surface by waves, and the rest on cells that the host holds.
class Surveying {
 public:
  Surveying(const SurveyedPair& pair, const SurveyOptions& options)
      : pair_(pair),
        options_(options),
        has_cheap_sides_(may_have_cheap_sides(options, pair)),
        meter_(options, pair.on_cpu, finds_sides(options) || has_cheap_sides_),
        bounding_(pair, meter_),
        areas_(areas_of(pair.a)) {}

  void run(SurveyResult& result) {
    std::optional<SidedCells> sided = sided_cells(pair_, options_, meter_);
    result.faces = options_.faces;
    if (goes_by_waves()) {
      WaveSurvey waves(pair_, areas_, meter_, farthest());
      const size_t effort = meter_.effort() / (has_other_goals(options_) ? 2 : 1);
      result.ended = waves.refine(options_, effort);
      known_ = waves.known();
      if (needs_store(options_)) {
        go_on(waves.store(), sided, result);
      } else {
        add_figures(waves, result);
      }
    } else {
      result.ended = SurveyEnd::kMet;
      go_on(first_store(), sided, result);
    }
    if (options_.statistics && !result.statistics)
      result.ended = std::max(result.ended, SurveyEnd::kBits);
    result.effort = meter_.effort();
    result.bounded = meter_.bounded();
    result.device_ms = meter_.device_ms();
    result.ms = meter_.ms();
  }

 private:
  bool goes_by_waves() const {
    return pair_.cells != nullptr && options_.statistics && !pair_.a.are_points &&
           !options_.pooled && areas_.is_positive();
  }

  // No distance is above it, in the frame.
  float farthest() const {
    const double most = pair_.frame.to_frame(pair_.farthest) * (1 + 1e-6) + pair_.displacement;
    return static_cast<float>(std::min(most * (1 + 1e-6), 1e38));
  }

  CellStore first_store() {
    if (options_.pooled) return options_.pooled->cells->take_cells();
    CellStore store(pair_.a, farthest());
    bounding_.faces(store);
    return store;
  }

  void add_figures(WaveSurvey& waves, SurveyResult& result) {
    const std::span<const float> faces = waves.faces();
    const size_t count = faces.size() / 2;
    result.field = field_of(faces.first(count), faces.last(count), pair_);
    result.cells = waves.count();
    result.statistics = statistics_of(waves, areas_, known_, pair_, options_);
    if (result.statistics) add_middles(has_only_shares(options_), *result.statistics);
  }

  void go_on(CellStore store, std::optional<SidedCells>& sided, SurveyResult& result) {
    std::vector<Goal> goals = options_.pooled
                                  ? std::vector<Goal>{pooled_goal(*options_.pooled, pair_, areas_)}
                                  : goals_of(options_, pair_);
    if (sided) add_signed_goals(*sided, options_, areas_, goals);
    std::optional<NormalCells> normals;
    if (options_.normals_within && options_.statistics && !pair_.a.are_points &&
        !pair_.b.are_points)
      normals.emplace(pair_, options_, areas_, [&] { return meter_.goes_on(); });
    if (normals && areas_.is_positive() && !options_.pooled) normals->add_goals(goals);
    const std::optional<Goal> map = map_goal(options_, pair_, areas_);
    refine_map(store, bounding_, map, false);
    result.ended = std::max(result.ended, refine_all(store, bounding_, goals));
    result.ended = std::max(result.ended, refine_map(store, bounding_, map, true));
    result.field = field_of(store.reached_of_faces(), store.highest_of_faces(), pair_);
    if (sided) result.sides = sided->figures({store, areas_, known_}, options_);
    result.ended = std::max(result.ended, meter_.ended());
    result.cells = store.count();
    if ((options_.statistics || options_.map) && areas_.is_positive())
      add_figures(std::move(store), sided, normals, result);
  }

  void add_figures(CellStore store, std::optional<SidedCells>& sided,
                   std::optional<NormalCells>& normals, SurveyResult& result) {
    const double largest = largest_upper(store, pair_);
    const auto whole = std::make_shared<Distribution>(pair_, std::move(store), areas_, largest);
    const CellStore& cells = whole->cells();
    const SurveyedArea surface{cells, areas_, known_};
    std::optional<Estimates> estimates;
    if (options_.map || normals)
      estimates.emplace(pair_, cells, [&] { return meter_.is_wanted(); });
    result.ended = std::max(result.ended, meter_.ended());
    if (options_.statistics) {
      StoredDistances distances(cells, areas_);
      result.statistics = statistics_of(distances, areas_, known_, pair_, options_);
    }
    if (result.statistics) {
      if (options_.max_distance) keep_within(surface, pair_, options_, *result.statistics);
      add_middles(has_only_shares(options_), *result.statistics);
      if (normals) normals->add_figures(cells, *estimates, *result.statistics);
    }
    if (options_.map) result.map = map_of(surface, pair_, options_, *estimates);
    if (result.map && sided) add_sides(sided->of(cells), *result.map);
    if (result.map && has_cheap_sides_)
      add_cheap_sides(
          pair_, cells, [&] { return meter_.sides_go_on(); }, *result.map);
    if (options_.keeps_distribution && result.statistics) result.distribution = whole;
  }

  const SurveyedPair& pair_;
  const SurveyOptions& options_;
  const bool has_cheap_sides_;
  SurveyMeter meter_;
  Bounding bounding_;
  const Areas areas_;
  std::vector<Enclosure> known_;  // of the percentiles, in the frame
};

}  // namespace

UsePair survey_with(const SurveyOptions& options, SurveyResult& result) {
  return [&options, &result](const SurveyedPair& on_device) {
    if (options.statistics)
      refuse_any_triangulation(on_device.a, on_device.b, "statistics of an area");
    check_shares(options.percentiles);
    SurveyedPair pair = on_device;
    pair.farthest = std::min(pair.farthest, options.upper);
    Surveying(pair, options).run(result);
  };
}

}  // namespace vkh
