#include "host/survey/wave_survey.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "host/survey/percentile_search.h"

namespace vkh {
namespace {

constexpr size_t kFewestParents =
    512;  // for a wave: its other steps look at all cells, so fewer would not pay

// The score in the middle of a bin.
double score_of(size_t bin) {
  const auto bits = static_cast<uint32_t>(bin) << 20 | 1u << 19;
  return static_cast<double>(std::bit_cast<float>(bits));
}

double sum_of_scores(std::span<const uint32_t> counts) {
  double sum = 0;
  for (size_t bin = 1; bin < counts.size(); ++bin) {
    if (counts[bin] > 0) sum += counts[bin] * score_of(bin);
  }
  return sum;
}

}  // namespace

SurveyChoice choose_cells(std::span<const uint32_t> counts, double part, size_t most) {
  const double wanted = part * sum_of_scores(counts);
  double chosen = 0;
  SurveyChoice choice;
  for (size_t bin = counts.size() - 1; bin > 0; --bin) {
    const size_t taken = choice.count();
    if (taken >= most || (chosen >= wanted && taken >= kFewestParents)) break;
    if (counts[bin] == 0) continue;
    choice.bin = static_cast<uint32_t>(bin);
    choice.above = static_cast<uint32_t>(taken);
    choice.ties = static_cast<uint32_t>(std::min<size_t>(counts[bin], most - taken));
    chosen += choice.ties * score_of(bin);
  }
  return choice;
}

WaveSurvey::WaveSurvey(const SurveyedPair& pair, const Areas& areas, SurveyMeter& meter,
                       float farthest)
    : pair_(pair),
      cells_(*pair.cells),
      weights_(weights_of(areas)),
      meter_(meter),
      unit_(tally_unit(farthest)) {
  seen_.highest = static_cast<double>(farthest);
  seen_.moments = {{0, seen_.highest}, {0, seen_.highest}};
  cells_.begin(weights_.of_face, farthest);
  bound_fresh(cells_.count());
}

// Bounds new cells in submissions, until time or the caller ends it; the cells that are left keep
// the bounds of their parents. If nothing is bounded yet, the first submission is made without
// asking the caller. A single submission is not waited for, so that the tally that follows goes
// with it.
bool WaveSurvey::bound_fresh(size_t count) {
  for (size_t first = 0; first < count;) {
    if (meter_.bounded() > 0 && !meter_.goes_on()) return false;
    const size_t size = std::min(meter_.bounds().size(), count - first);
    const bool is_last = first + size == count;
    const bool waits = !is_last || first > 0;
    const double ms = meter_.on_device([&] { cells_.bound(first, size, waits); });
    first += size;
    meter_.note_bounded(size);
    if (waits) meter_.bounds().note(size, ms);
  }
  return true;
}

// Visits all cells in submissions of this size, as long as `goes_on` returns true; returns whether
// it saw all of them.
template <class GoesOn, class Look>
bool WaveSurvey::go_over_cells(BatchSize& size, const GoesOn& goes_on, const Look& look) {
  for (size_t first = 0; first < cells_.count();) {
    if (!goes_on()) return false;
    const size_t count = std::min(size.size(), cells_.count() - first);
    const CellRange some{static_cast<uint32_t>(first), static_cast<uint32_t>(count)};
    size.note(count, meter_.on_device([&] { look(some); }));
    first += count;
  }
  return true;
}

// Looks at all cells, unless the caller ends it, if that is allowed. Returns whether it was not
// ended.
template <class Look>
bool WaveSurvey::look_at_cells(bool may_end, const Look& look) {
  return go_over_cells(
      meter_.looks(), [&] { return !may_end || meter_.is_wanted(); }, look);
}

bool WaveSurvey::score(const gpu::SurveyPlan& plan) {
  counts_.assign(gpu::kScoreBins, 0);
  return look_at_cells(true, [&](const CellRange& some) {
    const std::span<const uint32_t> counts = cells_.score(plan, some);
    std::transform(counts.begin(), counts.end(), counts_.begin(), counts_.begin(), std::plus<>());
  });
}

bool WaveSurvey::add_up(const gpu::SurveyPlan& plan, int unit, bool may_end) {
  table_ = {};
  return look_at_cells(
      may_end, [&](const CellRange& some) { add_table(cells_.tally(plan, unit, some), table_); });
}

std::optional<Tallied> WaveSurvey::tally_now(const Tally& asked) { return tally_now(asked, true); }

Tallied WaveSurvey::tally_anyway(const Tally& asked) { return *tally_now(asked, false); }

std::optional<Tallied> WaveSurvey::tally_now(const Tally& asked, bool may_end) {
  Tallied all;
  size_t first = 0;
  do {
    const size_t count = std::min<size_t>(asked.at.size() - first, gpu::kSurveyEdges);
    const TallyEdges at = edges_of(asked.at.subspan(first, count));
    const int unit = asked.of_normals ? kCosineUnit : unit_;
    if (!add_up(plan_of(at, asked), unit, may_end)) return {};
    AreaTable(table_, at, weights_, unit).answer(asked, all);
    first += count;
  } while (first < asked.at.size());
  return all;
}

Tallied WaveSurvey::tally(const Tally& asked) {
  std::optional<Tallied> found = tally_now(asked);
  if (!found) {
    Tallied all = seen_;
    for (const Threshold& at : asked.at) all.shares.push_back(shares_.within(at));
    return all;
  }
  shares_.add(asked.at, found->shares);
  if (!asked.moments) found->moments = seen_.moments;
  seen_ = *found;
  seen_.shares.clear();
  return *found;
}

bool WaveSurvey::find_sides(const SideSearch& search, double above) {
  sides_ = search;
  sides_above_ = static_cast<float>(above);
  return find_fresh_sides();
}

bool WaveSurvey::find_normals(const NormalSearch& search) {
  cells_.begin_normals(search);
  has_normals_ = true;
  return find_fresh_normals();
}

// Cells that have a side are left at once.
bool WaveSurvey::find_fresh_sides() {
  if (!sides_) return true;
  const double before = meter_.device_ms();
  const bool are_all = go_over_cells(
      meter_.sides(), [&] { return meter_.sides_go_on(); },
      [&](const CellRange& some) { cells_.find_sides(*sides_, sides_above_, some); });
  meter_.note_sides(meter_.device_ms() - before);
  return are_all;
}

// The same for normals, which take about as long as sides.
bool WaveSurvey::find_fresh_normals() {
  return !has_normals_ || go_over_cells(
                              meter_.sides(), [&] { return meter_.goes_on(); },
                              [&](const CellRange& some) { cells_.find_normals(some); });
}

// Splits the cells that matter most, and bounds their parts. If it does not, `ended` says why.
bool WaveSurvey::split(WaveGoals& goals, size_t effort, SurveyEnd& ended) {
  const gpu::SurveyPlan plan = goals.plan(weights_.whole);
  if (!score(plan)) {
    ended = meter_.ended();
    return false;
  }
  const size_t parts = goals.parts();
  const size_t room = (cells_.most() - cells_.count()) / (parts - 1);
  const size_t left = (effort - std::min(spent_, effort)) / parts;
  const size_t most = std::min({std::max(cells_.count() / parts, kFewestParents), left, room});
  SurveyChoice choice = choose_cells(counts_, goals.part(), most);
  choice.parts = static_cast<uint32_t>(parts);
  if (choice.count() == 0 || !goals.is_worth(choice.count(), cells_.count())) {
    const bool is_any = choice.count() == 0 && sum_of_scores(counts_) > 0;
    ended = !is_any     ? goals.at_rest(counts_[0] > 0)
            : left == 0 ? SurveyEnd::kEffort
                        : SurveyEnd::kMemory;
    return false;
  }
  if (!meter_.goes_on()) {
    ended = meter_.ended();
    return false;
  }
  if (!cells_.split(choice)) {
    ended = SurveyEnd::kMemory;
    return false;
  }
  faces_.clear();
  const size_t fresh = parts * choice.count();
  spent_ += fresh;
  meter_.spend(fresh);
  if (bound_fresh(fresh) && find_fresh_sides() && find_fresh_normals()) return true;
  ended = meter_.ended();
  return false;
}

void WaveSurvey::look(WaveGoals& goals, AreaDistances& distances) {
  for (bool may_be_closer = true; may_be_closer;) {
    const std::vector<Threshold> at = goals.thresholds();
    const std::optional<Threshold> moments = goals.wanted_moments();
    may_be_closer = goals.look(!at.empty() || moments ? distances.tally({at, moments}) : Tallied());
  }
}

SurveyEnd WaveSurvey::refine(WaveGoals& goals, size_t effort, AreaDistances& distances) {
  SurveyEnd ended = SurveyEnd::kMet;
  do {
    look(goals, distances);
  } while (!goals.are_met() && split(goals, effort, ended));
  return std::max(ended, meter_.ended());
}

std::vector<float> WaveSurvey::faces(uint32_t reached_classes, uint32_t highest_classes) {
  std::vector<float> faces;
  meter_.on_device([&] { faces = cells_.faces(reached_classes, highest_classes); });
  return faces;
}

const std::vector<float>& WaveSurvey::faces() {
  if (faces_.empty()) faces_ = faces(gpu::kAllClasses, gpu::kAllClasses);
  return faces_;
}

CellsRead WaveSurvey::read(const CellRange& some) {
  CellsRead cells;
  meter_.on_device([&] { cells = cells_.read(some); });
  return cells;
}

// A submission has as many points as a submission that looks at cells, since their bounds are
// copied back and forth.
PointDistances::Measured WaveSurvey::measure(const PointDistances::Asked& asked, size_t most) {
  if (!distances_) distances_.emplace(pair_);
  PointDistances::Measured all;
  for (size_t first = 0; first < cells_.count() && all.are_all && meter_.goes_on();) {
    const size_t count = std::min(meter_.looks().size(), cells_.count() - first);
    const CellRange some{static_cast<uint32_t>(first), static_cast<uint32_t>(count)};
    const CellsRead points = read(some);
    std::vector<gpu::CellBounds> bounds(points.bounds.begin(), points.bounds.end());
    const auto [measured, are_all] =
        distances_->narrow(points.cells, bounds, asked, most - all.count);
    if (measured > 0) meter_.on_device([&] { cells_.write(some, bounds); });
    all = {all.count + measured, are_all};
    first += count;
  }
  faces_.clear();
  meter_.note_bounded(all.count);
  meter_.spend(2 * all.count);
  return all;
}

// Returns the largest of one of the faces' two distances.
double WaveSurvey::largest(size_t which) {
  const auto first = faces().begin() + static_cast<std::ptrdiff_t>(which * pair_.a.faces.size());
  return static_cast<double>(*std::max_element(first, first + std::ssize(pair_.a.faces)));
}

std::vector<Enclosure> WaveSurvey::percentiles(const PercentileSearch& search) {
  const double most = std::min(seen_.highest, highest());
  return percentiles_by(
      search, [&](double share) { return shares_.percentile(share, seen_.lowest, most); }, *this);
}

}  // namespace vkh
