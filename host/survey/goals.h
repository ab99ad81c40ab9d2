// The goals of a survey: which cells are in the way of what was asked, and how much.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "host/base/parallel.h"
#include "host/survey/cell_store.h"
#include "host/survey/statistics.h"
#include "vkhausdorff/survey.h"

namespace vkh {

/// Larger scores come first; of equal ones the first cell, so that a survey repeats.
struct Scored {
  double score;
  size_t cell;
  bool operator<(const Scored& other) const {
    return score > other.score || (score == other.score && cell < other.cell);
  }
};
/// The cells to split, by their numbers; none if no split would bring the goal nearer.
struct Scores {
  std::vector<Scored> cells;
  bool is_met = false;
  /// So much of the scores is split in one pass, the largest first: nine tenths, since a few cells
  /// that are wide often matter more than all others together.
  static constexpr double kNearlyAll = 0.9;
  double part = kNearlyAll;
};
/// The part of the scores to split where a figure is to be so narrow: halves have together about
/// half of the width of a cell, so that twice what is too much is enough.
inline double part_to_split(double width, double enough) {
  return std::clamp(2 * (width - enough) / width, 0.05, Scores::kNearlyAll);
}
using Goal = std::function<Scores(const CellStore&)>;

/// Scores all cells that can be split. `score` of a cell returns nothing if the cell is not in the
/// goal's way, and 0 if it is and a split would gain nothing.
template <class Score>
Scores scored(const CellStore& store, const Score& score) {
  struct Block {
    std::vector<Scored> cells;
    bool is_met = true;
  };
  std::vector<Block> blocks(block_count(store.count()));
  for_each_block(store.count(), [&](size_t block, size_t begin, size_t end) {
    Block mine;
    for (size_t i = begin; i < end; ++i) {
      const std::optional<double> of_cell = score(i);
      if (!of_cell) continue;
      mine.is_met = false;
      if (*of_cell > 0 && store.can_split(i)) mine.cells.push_back({*of_cell, i});
    }
    blocks[block] = std::move(mine);
  });
  Scores all{{}, true};
  for (const Block& block : blocks) {
    all.cells.insert(all.cells.end(), block.cells.begin(), block.cells.end());
    all.is_met = all.is_met && block.is_met;
  }
  return all;
}

/// Scores a cell by its undecided area, added up over some distances.
Scores score_undecided(const CellStore& store, const Areas& areas,
                       const std::vector<Threshold>& distances);

/// Converts lengths in the frame, on the stored meshes, to the files' units.
Enclosure in_files(const SurveyedPair& pair, const Enclosure& lengths);

/// The width in the frame that is enough for any figure: a millionth of A's diagonal, or what
/// floats leave.
double least_width(const SurveyedPair& pair);

/// The goals of points of A, each of which is measured where a figure needs it. Those of a surface
/// are sought by waves: wave_survey.h.
std::vector<Goal> goals_of(const SurveyOptions& options, const SurveyedPair& pair);

/// The surface that figures are of.
struct SurveyedArea {
  const CellStore& store;
  const Areas& areas;
};

}  // namespace vkh
