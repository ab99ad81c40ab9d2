// The figures that a survey was asked for, in the frame, and the width that each has to reach.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "host/survey/statistics.h"
#include "vkhausdorff/survey.h"

namespace vkh {

/// The answer of a tally for its thresholds, in the frame.
struct Tallied {
  std::vector<Enclosure> shares;     ///< of A's area within each
  Moments moments;                   ///< if they were asked for
  double lowest = 0, highest = 0;    ///< no distance is less, or more
  float reached = 0;                 ///< some point of a cell that counts is this far
  bool is_empty = false;             ///< no cell counts
  std::optional<uint32_t> far = {};  ///< the first cell that reaches Tally::far
};

struct FiguresAsked {
  FiguresAsked(const SurveyOptions& asked, const SurveyedPair& pair);

  SurveyOptions options;
  double displacement;
  Frame frame;
  double least;                                              ///< the width that is always enough
  double largest = std::numeric_limits<double>::infinity();  ///< no distance is above it

  static constexpr double kNearlyNone = 1e-5;  ///< of A's area

  static double width(const Enclosure& e) { return e.upper - e.lower; }
  /// The width that is enough for a length.
  double enough(const Enclosure& figure) const {
    return std::max(options.mean_tolerance * figure.lower, least);
  }
  bool is_open(const Enclosure& length) const { return width(length) > enough(length); }
  Threshold threshold(double distance) const { return threshold_at(frame, displacement, distance); }
  /// A distance of at most `down` is within the limit, and one of more than `up` is not.
  Threshold threshold(const Limit& limit) const {
    return {threshold(limit.within).down, threshold(limit.beyond).up};
  }
  std::vector<Threshold> bands() const;
  static constexpr size_t kOfBand = 3;
  /// The thresholds for a band: the band itself, and one a least width before and behind it.
  std::array<Threshold, kOfBand> around(const Threshold& band) const;
  /// The distance beyond which distances count as 0 in moments.
  Threshold most() const;
  /// The width of a share that counts for its goal: its own, or that of its harmonic mean with the
  /// other surface's share, whichever is larger.
  double width_of_share(const Enclosure& share, size_t band) const;
  bool is_enough(const Enclosure& share, size_t band) const;
  /// Whether an undecided share can never be decided, by the shares around the band: all of the
  /// undecided area except what the goal allows is proven to lie at that distance, as far as floats
  /// resolve.
  bool is_atom(std::span<const Enclosure> around) const;
  /// The margin at the ends of a percentile that jumps, outside of which nearly no area may lie:
  /// two fifths of the width that would be enough.
  double beside(const Enclosure& percentile) const { return 0.4 * enough(percentile); }
  /// Whether a percentile can never be narrow: nearly no area lies between its ends, except beside
  /// them.
  bool is_gap(const Enclosure& percentile, const Enclosure& at_from, const Enclosure& at_to) const;
  /// The resolution to which percentiles are sought, if some point is `reached` far.
  double resolution(double reached) const { return std::max(0x1p-17 * reached, least / 16); }
};

}  // namespace vkh
