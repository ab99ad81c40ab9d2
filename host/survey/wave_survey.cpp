#include "host/survey/wave_survey.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

namespace vkh {
namespace {

constexpr size_t kFewestParents = 512;  // for a wave, whose other steps look at all cells

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

// Bounds new cells in submissions, until time or the caller ends it: those that are left have what
// was known before. The first one is not asked for. The last one is submitted with the tally that
// follows, unless others showed how long it takes.
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

// Looks at all cells in submissions, until the caller ends it; returns whether it did not.
template <class Look>
bool WaveSurvey::look_at_cells(const Look& look) {
  for (size_t first = 0; first < cells_.count();) {
    if (!meter_.is_wanted()) return false;
    const size_t count = std::min(meter_.looks().size(), cells_.count() - first);
    const CellRange some{static_cast<uint32_t>(first), static_cast<uint32_t>(count)};
    meter_.looks().note(count, meter_.on_device([&] { look(some); }));
    first += count;
  }
  return true;
}

bool WaveSurvey::score(const gpu::SurveyPlan& plan) {
  counts_.assign(gpu::kScoreBins, 0);
  return look_at_cells([&](const CellRange& some) {
    const std::span<const uint32_t> counts = cells_.score(plan, some);
    std::transform(counts.begin(), counts.end(), counts_.begin(), counts_.begin(), std::plus<>());
  });
}

bool WaveSurvey::add_up(const gpu::SurveyPlan& plan) {
  table_ = {};
  return look_at_cells(
      [&](const CellRange& some) { add_table(cells_.tally(plan, unit_, some), table_); });
}

Tallied WaveSurvey::tally(const Tally& asked) {
  Tallied all = seen_;
  size_t first = 0;
  do {
    const size_t count = std::min<size_t>(asked.at.size() - first, gpu::kSurveyEdges);
    const std::span<const Threshold> some = asked.at.subspan(first, count);
    const TallyEdges at = edges_of(some);
    if (!add_up(plan_of(at, asked.moments))) break;
    const AreaTable table(table_, at, weights_, unit_);
    const std::vector<Enclosure> shares = table.shares();
    shares_.add(some, shares);
    all.shares.insert(all.shares.end(), shares.begin(), shares.end());
    if (asked.moments) seen_.moments = table.moments(*asked.moments);
    seen_.lowest = table.lowest();
    seen_.highest = table.highest();
    first += count;
  } while (first < asked.at.size());
  for (const Threshold& at : asked.at.subspan(first)) all.shares.push_back(shares_.within(at));
  all.moments = seen_.moments;
  all.lowest = seen_.lowest;
  all.highest = seen_.highest;
  return all;
}

// Splits the cells that matter most, and bounds their parts; otherwise says why not.
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
  if (bound_fresh(fresh)) return true;
  ended = meter_.ended();
  return false;
}

SurveyEnd WaveSurvey::refine(WaveGoals& goals, size_t effort) {
  SurveyEnd ended = SurveyEnd::kMet;
  const auto look = [&] {
    const std::vector<Threshold> at = goals.thresholds();
    const std::optional<Threshold> moments = goals.wanted_moments();
    return goals.look(!at.empty() || moments ? tally({at, moments}) : Tallied());
  };
  do {
    while (look()) {
    }
  } while (!goals.are_met() && split(goals, effort, ended));
  return std::max(ended, meter_.ended());
}

const std::vector<float>& WaveSurvey::faces() {
  if (faces_.empty()) meter_.on_device([&] { faces_ = cells_.faces(); });
  return faces_;
}

CellStore WaveSurvey::store() {
  std::vector<gpu::Cell> cells;
  std::vector<gpu::CellBounds> bounds;
  meter_.on_device([&] { cells_.read(cells, bounds); });
  std::vector<float> reached = faces();
  reached.resize(pair_.a.faces.size());
  return CellStore(pair_.a, std::move(cells), std::move(bounds), std::move(reached));
}

// Returns the largest of one of the faces' two distances.
double WaveSurvey::largest(size_t which) {
  const auto first = faces().begin() + static_cast<std::ptrdiff_t>(which * pair_.a.faces.size());
  return static_cast<double>(*std::max_element(first, first + std::ssize(pair_.a.faces)));
}

namespace {

// One end of a percentile between two distances: it is above the one and not above the other.
struct PercentileEnd {
  double share, low, likely, high;  // it was at the likely one before cells were split
  bool is_upper;

  static constexpr int kSections = 8;
  double width() const { return high - low; }
  double cut(int k) const {
    constexpr int kHalf = kSections / 2;
    return k <= kHalf ? low + (likely - low) * k / kHalf
                      : likely + (high - likely) * (k - kHalf) / kHalf;
  }
  bool is_reached(const Enclosure& within) const {
    return is_upper ? within.lower >= share : within.upper >= share;
  }
  void look(std::span<const Enclosure> at_cuts) {
    const PercentileEnd before = *this;
    for (int k = 1; k < kSections; ++k) {
      if (is_reached(at_cuts[static_cast<size_t>(k - 1)])) {
        high = std::min(high, before.cut(k));
      } else {
        low = std::max(low, before.cut(k));
      }
    }
    likely = low + (high - low) / 2;
  }
};

// Both ends of each percentile.
using PercentileEnds = std::vector<std::array<PercentileEnd, 2>>;

// The ends that are known worse than would do: nearer ones make no interval much narrower.
std::vector<PercentileEnd*> wide_ends(PercentileEnds& ends, double resolution) {
  constexpr double kOfWidth = 1.0 / 32;
  std::vector<PercentileEnd*> wide;
  for (auto& [lower, upper] : ends) {
    const double enough = std::max(resolution, kOfWidth * (upper.high - lower.low));
    for (PercentileEnd* end : {&lower, &upper}) {
      if (end->width() > enough) wide.push_back(end);
    }
  }
  return wide;
}

}  // namespace

// Each pass cuts what is left of the ends. No cell is split between two.
std::vector<Enclosure> WaveSurvey::percentiles(const PercentileSearch& search) {
  constexpr int kMostTallies = 20;
  PercentileEnds ends;
  for (const double share : search.shares) {
    const SharesSeen::Ends known =
        shares_.percentile(share, seen_.lowest, std::min(seen_.highest, highest()));
    ends.push_back({PercentileEnd{share, known.low, known.first, known.high, false},
                    {share, known.low, known.last, known.high, true}});
  }
  for (int pass = 0; pass < kMostTallies; ++pass) {
    const std::vector<PercentileEnd*> wide = wide_ends(ends, search.resolution);
    std::vector<Threshold> at;
    for (const PercentileEnd* end : wide) {
      for (int k = 1; k < PercentileEnd::kSections; ++k) at.push_back({end->cut(k), end->cut(k)});
    }
    if (at.empty()) break;
    const std::vector<Enclosure> shares = tally({at}).shares;
    constexpr size_t kCuts = PercentileEnd::kSections - 1;
    for (size_t i = 0; i < wide.size(); ++i)
      wide[i]->look(std::span(shares).subspan(kCuts * i, kCuts));
  }
  std::vector<Enclosure> all;
  for (const auto& [lower, upper] : ends) all.push_back({lower.low, upper.high});
  return all;
}

}  // namespace vkh
