#include "vkhausdorff/survey.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

#include "host/base/parallel.h"
#include "host/survey/distribution.h"
#include "host/survey/goals.h"
#include "host/survey/map_goal.h"
#include "host/survey/normals.h"
#include "host/survey/point_distances.h"
#include "host/survey/pooled.h"
#include "host/survey/signed_figures.h"
#include "host/survey/survey_with.h"
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

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

bool finds_sides(const SurveyOptions& options) { return options.is_signed || options.sided; }

// Bounds cells in batches, until time or the caller ends it. How large batches are decides neither
// the cells' numbers nor their bounds.
class Bounding {
 public:
  Bounding(const SurveyedPair& pair, const BoundCells& bound, const SurveyOptions& options,
           bool keeps_time_for_sides)
      : pair_(pair),
        bound_(bound),
        options_(options),
        ms_of_cells_(1000 * options.time_limit_s * (keeps_time_for_sides ? kPartOfCells : 1)),
        effort_(options.effort.value_or(default_effort(pair.on_cpu))),
        batch_(pair.on_cpu ? 1024 : 65536) {}

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
      spent_ += bounds.size();
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
      spent_ += 2 * some.size();
    });
  }
  bool are_points() const { return pair_.a.are_points; }

  // Whether the caller lets the survey go on, however long it took.
  bool is_wanted() {
    if (ended_ != SurveyEnd::kCancelled && options_.goes_on && !options_.goes_on(bounded_))
      ended_ = SurveyEnd::kCancelled;
    return ended_ != SurveyEnd::kCancelled;
  }
  // The number of cells that may still be split.
  size_t splits_left() const { return (effort_ - spent_) / 2; }
  size_t effort() const { return effort_; }

  // Asks the caller first: a survey that was cancelled is none that time ended.
  bool goes_on() { return goes_on(ended_, ms_of_cells_); }
  // The same for the work on sides, which has some time of its own.
  bool sides_go_on() { return goes_on(sides_ended_, 1000 * options_.time_limit_s); }
  // The reason why `goes_on` was false; before it was, kMet.
  SurveyEnd ended() const { return std::max(ended_, sides_ended_); }
  double ms() const { return ms_since(start_); }
  size_t bounded() const { return bounded_; }
  double device_ms() const { return device_ms_; }

 private:
  bool goes_on(SurveyEnd& ended, double limit_ms) {
    if (ended != SurveyEnd::kMet) return false;
    if (!is_wanted()) {
      ended = SurveyEnd::kCancelled;
    } else if (ms() > limit_ms) {
      ended = SurveyEnd::kTime;
    }
    return ended == SurveyEnd::kMet;
  }

  void bound(const CellBatch& batch) {
    const Clock::time_point start = Clock::now();
    bound_(batch);
    device_ms_ += ms_since(start);
  }

  template <class Bound>
  void all(size_t count, const Bound& bound) {
    for (size_t first = 0; first < count && (bounded_ == 0 || goes_on());) {
      std::vector<gpu::CellBounds> bounds(std::min(batch_, count - first));
      const Clock::time_point start = Clock::now();
      bound(first, bounds);
      first += bounds.size();
      bounded_ += bounds.size();
      const double per_cell = ms_since(start) / static_cast<double>(bounds.size());
      const auto fits = static_cast<size_t>(options_.submission_ms / per_cell) / 2 * 2;
      batch_ = std::clamp(fits, kLeastBatch, std::min(4 * batch_, kMostBatch));
    }
  }

  static constexpr double kPartOfCells = 0.7;
  static constexpr size_t kLeastBatch = 64,  // even, as all are: halves come in twos
      kMostBatch = size_t{1} << 20, kPointsOfThread = 256;
  const SurveyedPair& pair_;
  const BoundCells& bound_;
  const SurveyOptions& options_;
  const Clock::time_point start_ = Clock::now();
  const double ms_of_cells_;
  const size_t effort_;
  size_t spent_ = 0;
  size_t batch_;
  size_t bounded_ = 0;
  double device_ms_ = 0;
  std::vector<size_t> which_;  // cells of a batch
  std::optional<PointDistances> distances_;
  SurveyEnd ended_ = SurveyEnd::kMet, sides_ended_ = SurveyEnd::kMet;
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

// Refines until the goal is met, or cannot be, by splits of `budget` cells.
SurveyEnd refine(CellStore& store, Bounding& bounding, const Goal& goal, size_t budget) {
  const size_t kept = bounding.splits_left() - budget;
  for (;;) {
    Scores scores = goal(store);
    if (scores.is_met) return SurveyEnd::kMet;
    if (scores.cells.empty()) return SurveyEnd::kBits;
    const size_t most =
        std::min(std::max(store.count() / 2, kFewestSplits), bounding.splits_left() - kept);
    if (most == 0) return SurveyEnd::kEffort;
    if (!bounding.goes_on()) return bounding.ended();
    if (bounding.are_points()) {
      bounding.points(store, chosen_points(scores, most));
    } else {
      bounding.halves(store, chosen_cells(store, scores, most));
    }
  }
}

// Refines for one goal after the other.
SurveyEnd refine_all(CellStore& store, Bounding& bounding, const std::vector<Goal>& goals) {
  SurveyEnd ended = bounding.ended();  // before all faces are bounded, perhaps
  for (const Goal& goal : goals)
    ended = std::max(ended, refine(store, bounding, goal, bounding.splits_left()));
  return ended;
}

// A picture may take half of the effort before figures, and what they leave after them.
SurveyEnd refine_map(CellStore& store, Bounding& bounding, const std::optional<Goal>& map,
                     bool is_last) {
  if (!map) return bounding.ended();
  return refine(store, bounding, *map, bounding.splits_left() / (is_last ? 1 : 2));
}

Field field_of(const CellStore& store, const SurveyedPair& pair) {
  const std::vector<float> highest = store.highest_of_faces();
  Field field;
  for (size_t f = 0; f < highest.size(); ++f) {
    const auto reached = static_cast<double>(store.reached(static_cast<uint32_t>(f)));
    const Enclosure e = in_files(pair, {reached, static_cast<double>(highest[f])});
    field.lower.push_back(std::min(e.lower, e.upper));
    field.upper.push_back(e.upper);
  }
  return field;
}

// Returns nothing unless sides are asked for.
std::optional<SidedCells> sided_cells(const SurveyedPair& pair, const SurveyOptions& options,
                                      Bounding& bounding) {
  if (!finds_sides(options)) return {};
  refuse_any_triangulation(pair.a, pair.b, "sides");
  refuse_conflicts(pair.b);
  return std::optional<SidedCells>(std::in_place, pair, [&] { return bounding.sides_go_on(); });
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
  with_cells(solver, pair, run, survey_with(options, result));
  return result;
}

Survey survey_with(const SurveyOptions& options, SurveyResult& result) {
  return [&options, &result](const SurveyedPair& on_device, const BoundCells& bound) {
    if (options.statistics)
      refuse_any_triangulation(on_device.a, on_device.b, "statistics of an area");
    check_shares(options.percentiles);
    SurveyedPair pair = on_device;
    pair.farthest = std::min(pair.farthest, options.upper);
    const bool is_cheap = may_have_cheap_sides(options, pair);
    Bounding bounding(pair, bound, options, finds_sides(options) || is_cheap);
    std::optional<SidedCells> sided = sided_cells(pair, options, bounding);
    const double farthest = pair.frame.to_frame(pair.farthest) * (1 + 1e-6) + pair.displacement;
    CellStore store =
        options.pooled
            ? options.pooled->cells->take_cells()
            : CellStore(pair.a, static_cast<float>(std::min(farthest * (1 + 1e-6), 1e38)));
    if (!options.pooled) bounding.faces(store);
    Areas areas = areas_of(pair.a);
    std::vector<Enclosure> percentiles;
    std::vector<Goal> goals = options.pooled
                                  ? std::vector<Goal>{pooled_goal(*options.pooled, pair, areas)}
                                  : goals_of(options, pair, areas, percentiles);
    if (sided) add_signed_goals(*sided, options, areas, goals);
    std::optional<NormalCells> normals;
    if (options.normals_within && options.statistics && !pair.a.are_points && !pair.b.are_points)
      normals.emplace(pair, options, areas, [&] { return bounding.goes_on(); });
    if (normals && areas.is_positive() && !options.pooled) normals->add_goals(goals);
    const std::optional<Goal> map = map_goal(options, pair, areas);
    refine_map(store, bounding, map, false);
    result.ended = refine_all(store, bounding, goals);
    result.ended = std::max(result.ended, refine_map(store, bounding, map, true));
    result.field = field_of(store, pair);
    result.faces = options.faces;
    if (sided) result.sides = sided->figures({store, areas, percentiles}, options);
    result.ended = std::max(result.ended, bounding.ended());
    result.cells = store.count();
    if ((options.statistics || options.map) && areas.is_positive()) {
      const double largest = largest_upper(store, pair);
      const auto whole = std::make_shared<Distribution>(pair, std::move(store), areas, largest,
                                                        only_shares_of(options, pair),
                                                        [&] { return bounding.is_wanted(); });
      result.ended = std::max(result.ended, bounding.ended());
      const SurveyedArea surface{whole->cells(), whole->areas(), percentiles};
      if (options.statistics)
        result.statistics = statistics_of(surface, pair, options, whole->estimates());
      if (normals && result.statistics)
        normals->add_figures(whole->cells(), whole->estimates(), *result.statistics);
      if (options.map) result.map = map_of(surface, pair, options, whole->estimates());
      if (result.map && sided) add_sides(sided->of(whole->cells()), *result.map);
      if (result.map && is_cheap)
        add_cheap_sides(
            pair, whole->cells(), [&] { return bounding.sides_go_on(); }, *result.map);
      if (options.keeps_distribution && result.statistics) result.distribution = whole;
    }
    if (options.statistics && !result.statistics)
      result.ended = std::max(result.ended, SurveyEnd::kBits);
    result.effort = bounding.effort();
    result.bounded = bounding.bounded();
    result.device_ms = bounding.device_ms();
    result.ms = bounding.ms();
  };
}

}  // namespace vkh
