// The figures of A's area, from any source of the distribution of its distances.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/survey/figures_asked.h"
#include "host/survey/statistics.h"

namespace vkh {

inline constexpr double kAnyDistance = 3e38;  ///< a float: none is farther

/// Asks for the share of A's area within each threshold. Also asks for moments if it has a distance
/// beyond which distances count as 0.
struct Tally {
  std::span<const Threshold> at;
  std::optional<Threshold> moments = {};
  uint32_t classes = gpu::kAllClasses;           ///< of the cells that count
  float far = static_cast<float>(kAnyDistance);  ///< the first cell that reaches it is wanted
  /// The share is of the area within the threshold whose normals agree, and the mean is of their
  /// cosines.
  bool of_normals = false;
};

/// Returns what cells prove about the distances over A, in the frame.
class AreaDistances {
 public:
  virtual ~AreaDistances() = default;
  virtual Tallied tally(const Tally& asked) = 0;
  /// The least distance that each share of A's area is within.
  virtual std::vector<Enclosure> percentiles(const PercentileSearch& search) = 0;
  virtual double reached() = 0;  ///< some point is this far,
  virtual double highest() = 0;  ///< and none is farther
};

/// Whether a survey has goals only for shares within bands, and draws nothing else: then other
/// figures have no estimate, and there is no curve.
bool has_only_shares(const SurveyOptions& options);

/// Returns the figures of A, or of its part within options.max_distance; nothing if A has no area.
std::optional<Statistics> statistics_of(AreaDistances& distances, const Areas& areas,
                                        const SurveyedPair& pair, const SurveyOptions& options);

/// Makes the middle of each figure's interval its estimate: where a goal is met, that is within
/// half of what it allows.
void add_middles(bool only_shares, Statistics& statistics);

}  // namespace vkh
