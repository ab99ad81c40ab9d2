#include "host/survey/survey.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "host/survey/goals.h"

namespace vkh {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// A submission takes about so long, so that Ctrl-C takes effect.
constexpr double kSubmissionMs = 50;

// Bounds cells in batches, until the budget ends.
class Bounding {
 public:
  Bounding(const SurveyedPair& pair, const BoundCells& bound, const SurveyOptions& options)
      : bound_(bound), options_(options), batch_(pair.on_cpu ? 1024 : 65536) {}

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
  void halves(CellStore& store, std::span<const Scored> which) {
    std::vector<gpu::Cell> asked;
    std::vector<size_t> parents;
    all(2 * which.size(), [&](size_t first, std::span<gpu::CellBounds> bounds) {
      parents.clear();
      which_.clear();
      for (size_t i = first / 2; i < (first + bounds.size()) / 2; ++i) {
        which_.push_back(which[i].cell);
        which_.push_back(store.count() + parents.size());
        parents.push_back(which[i].cell);
      }
      store.split(parents);
      asked.clear();
      for (const size_t i : which_) asked.push_back(store.cell(i));
      bound({.cells = asked, .first = 0, .bounds = bounds});
      store.narrow(which_, bounds);
    });
  }

  bool goes_on() {
    ended_ = ended_ || ms() > 1000 * options_.time_limit_s ||
             (options_.goes_on && !options_.goes_on(bounded_));
    return !ended_;
  }
  double ms() const { return ms_since(start_); }
  size_t bounded() const { return bounded_; }
  double device_ms() const { return device_ms_; }

 private:
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
      const auto fits = static_cast<size_t>(kSubmissionMs / per_cell) / 2 * 2;
      batch_ = std::clamp(fits, kLeastBatch, std::min(4 * batch_, kMostBatch));
    }
  }

  static constexpr size_t kLeastBatch = 64,  // even, as all are: halves come in twos
      kMostBatch = size_t{1} << 20;
  const BoundCells& bound_;
  const SurveyOptions& options_;
  const Clock::time_point start_ = Clock::now();
  size_t batch_;
  size_t bounded_ = 0;
  double device_ms_ = 0;
  std::vector<size_t> which_;  // cells of a batch
  bool ended_ = false;
};

constexpr size_t kFewestSplits = 2048;  // for a pass: the host looks at all cells between two
// The chosen cells have nearly all of the score: a few that are wide often matter more than all
// others together.
constexpr double kNearlyAll = 0.9;

// Keeps the cells that matter most, `most` of them at most.
void choose_some(const CellStore& store, std::vector<Scored>& scored, size_t most) {
  std::erase_if(scored, [&](const Scored& s) { return !store.can_split(s.cell); });
  double whole = 0, chosen = 0;
  for (const Scored& s : scored) whole += s.score;
  size_t count = 0;
  for (size_t next = kFewestSplits; count < std::min(most, scored.size()); next *= 2) {
    const size_t end = std::min({next, most, scored.size()});
    const auto at = [&](size_t i) { return scored.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(count), at(end - 1), scored.end());
    for (size_t i = count; i < end; ++i) chosen += scored[i].score;
    count = end;
    if (chosen >= kNearlyAll * whole) break;
  }
  scored.resize(count);
}

// Refines until the goal is met, or cannot be; returns whether it was met.
bool refine(CellStore& store, Bounding& bounding, const SurveyOptions& options, const Goal& goal) {
  for (;;) {
    Scores scores = goal(store);
    std::vector<Scored>& scored = scores.cells;
    if (scored.empty() || scores.is_met) return scores.is_met;
    const size_t room = options.cell_limit - std::min(options.cell_limit, store.count());
    choose_some(store, scored, std::min(std::max(store.count() / 2, kFewestSplits), room));
    if (scored.empty() || !bounding.goes_on()) return false;
    bounding.halves(store, scored);
  }
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

}  // namespace

FieldSummary summary_of(const Field& field, const Limit& limit) {
  FieldSummary summary;
  for (size_t f = 0; f < field.face_count(); ++f) {
    summary.width = std::max(summary.width, field.upper[f] - field.lower[f]);
    const Verdict verdict = verdict_of(field, f, limit);
    ++(verdict == Verdict::kWithin   ? summary.within
       : verdict == Verdict::kBeyond ? summary.beyond
                                     : summary.undecided);
  }
  return summary;
}

Field field_within(size_t face_count, double upper) {
  return {std::vector<double>(face_count, 0.0), std::vector<double>(face_count, upper)};
}

Survey survey_with(const SurveyOptions& options, SurveyResult& result) {
  return [&options, &result](const SurveyedPair& on_device, const BoundCells& bound) {
    if (options.statistics)
      refuse_any_triangulation(on_device.a, on_device.b, "statistics of an area");
    SurveyedPair pair = on_device;
    pair.farthest = std::min(pair.farthest, options.upper);
    const double farthest = pair.frame.to_frame(pair.farthest) * (1 + 1e-6) + pair.displacement;
    CellStore store(pair.a, static_cast<float>(std::min(farthest * (1 + 1e-6), 1e38)));
    Bounding bounding(pair, bound, options);
    bounding.faces(store);
    const Areas areas = areas_of(pair.a);
    bool is_met = bounding.goes_on();
    for (const Goal& goal : goals_of(options, pair, areas)) {
      if (!refine(store, bounding, options, goal)) is_met = false;
    }
    result.field = field_of(store, pair);
    result.faces = options.faces;
    if (options.statistics) result.statistics = statistics_of(store, areas, pair, options);
    result.is_met = is_met && options.statistics == result.statistics.has_value();
    result.cells = store.count();
    result.bounded = bounding.bounded();
    result.device_ms = bounding.device_ms();
    result.ms = bounding.ms();
  };
}

}  // namespace vkh
