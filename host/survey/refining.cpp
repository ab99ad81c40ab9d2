#include "host/survey/refining.h"

#include <algorithm>
#include <limits>

#include "host/base/parallel.h"

namespace vkh {
namespace {

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

}  // namespace

template <class Work>
void Refining::in_batches(size_t count, const Work& work) {
  for (size_t first = 0; first < count && (meter_.bounded() == 0 || meter_.goes_on());) {
    std::vector<gpu::CellBounds> bounds(std::min(meter_.bounds().size(), count - first));
    const double start = meter_.ms();
    work(first, bounds);
    first += bounds.size();
    meter_.note_bounded(bounds.size());
    meter_.bounds().note(bounds.size(), meter_.ms() - start);
  }
}

// Halves cells, and bounds both halves: none is left that is split and not bounded.
void Refining::halve(CellStore& store, std::span<const size_t> which) {
  std::vector<gpu::Cell> asked;
  std::vector<size_t> parents;
  in_batches(2 * which.size(), [&](size_t first, std::span<gpu::CellBounds> bounds) {
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
    meter_.on_device([&] { pair_.bound({.cells = asked, .first = 0, .bounds = bounds}); });
    store.narrow(which_, bounds);
    meter_.spend(bounds.size());
  });
}

// Refines until the goal is met, or cannot be.
SurveyEnd Refining::refine_one(CellStore& store, const Goal& goal) {
  for (;;) {
    Scores scores = goal(store);
    if (scores.is_met) return SurveyEnd::kMet;
    if (scores.cells.empty()) return SurveyEnd::kBits;
    const size_t most =
        std::min(std::max(store.count() / 2, kFewestSplits), meter_.effort_left() / 2);
    if (most == 0) return SurveyEnd::kEffort;
    if (!meter_.goes_on()) return meter_.ended();
    halve(store, chosen_cells(store, scores, most));
  }
}

SurveyEnd Refining::refine(CellStore& store, const std::vector<Goal>& goals) {
  SurveyEnd ended = meter_.ended();  // before all faces are bounded, perhaps
  for (const Goal& goal : goals) ended = std::max(ended, refine_one(store, goal));
  return ended;
}

}  // namespace vkh
