// The certified distribution of d(x, B) over A, in the files' units.
#pragma once

#include <span>
#include <vector>

#include "host/survey/area_figures.h"

namespace vkh {

class Distribution {
 public:
  /// Uses the cells as they are at each call. A has an area. All arguments outlive it.
  Distribution(AreaDistances& distances, const Areas& areas, const SurveyedPair& pair)
      : distances_(distances), areas_(areas), pair_(pair) {}

  /// Returns the share of A's area within each of some distances, which ascend. Each has its middle
  /// as an estimate.
  std::vector<Enclosure> shares_within(std::span<const double> ascending) const;
  /// Returns the area that is undecided at both ends of an interval.
  double undecided_area(const Enclosure& at) const;
  /// Encloses A's area.
  Enclosure area() const;
  /// Returns how much wider a length is for the coordinates as given.
  double rounding() const;
  /// Returns the width that is enough for any length: a millionth of A's diagonal, or what floats
  /// leave, and what storing the coordinates adds.
  double least_width() const;

 private:
  AreaDistances& distances_;
  const Areas& areas_;
  const SurveyedPair& pair_;
};

}  // namespace vkh
