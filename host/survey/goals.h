// Goals of cells that the host holds: which cells are in the way of what was asked, and how much.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "host/base/parallel.h"
#include "host/survey/cell_store.h"
#include "host/survey/statistics.h"
#include "host/survey/wave_goals.h"
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
  /// So much of the scores is split in one pass, the largest first.
  double part = kNearlyAll;
};
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

}  // namespace vkh
