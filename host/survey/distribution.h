// The certified distribution of d(x, B) over A: the cells of a survey that has ended.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "host/survey/cell_store.h"
#include "host/survey/statistics.h"

namespace vkh {

/// Keeps the cells: 88 bytes for each. It refers to the mesh A of the pair, which must outlive
/// it.
class Distribution {
 public:
  /// A has an area. `largest`: no distance is above it, in the files' units.
  Distribution(const SurveyedPair& pair, CellStore cells, Areas areas, double largest);
  Distribution(const Distribution&) = delete;
  Distribution& operator=(const Distribution&) = delete;

  const CellStore& cells() const { return cells_; }
  /// Gives the cells to a survey that goes on with them: this is of no use any more.
  CellStore take_cells() { return std::move(cells_); }
  const Areas& areas() const { return areas_; }

  /// Returns the share of A's area within each of some distances, which are in the files' units and
  /// ascend. Each has its middle as an estimate.
  std::vector<Enclosure> shares_within(std::span<const double> ascending) const;
  /// Returns the area that is undecided at both ends of an interval, in the files' units.
  double undecided_area(const Enclosure& at) const;
  /// Encloses A's area, in the files' units.
  Enclosure area() const;
  /// Returns the width, in the files' units, that is enough for any length: a millionth of A's
  /// diagonal, or what floats leave, and what storing the coordinates adds.
  double least_width() const { return least_width_; }
  /// Returns how much wider a length is for the coordinates as given, in the files' units.
  double rounding() const { return rounding_; }

 private:
  CellStore cells_;
  const Areas areas_;
  const Frame frame_;
  const double displacement_;  // in the frame
  const double largest_;
  const double rounding_, least_width_;
};

}  // namespace vkh
