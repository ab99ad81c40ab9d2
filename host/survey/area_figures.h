// The figures of A's area, from whatever knows the distribution of its distances.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/survey/figures_asked.h"
#include "host/survey/goals.h"
#include "host/survey/statistics.h"

namespace vkh {

/// Asks for the share of A's area within each threshold, and for moments, if a distance is given
/// beyond which one counts as 0.
struct Tally {
  std::span<const Threshold> at;
  std::optional<Threshold> moments = {};
};

/// Tells what cells prove of the distances over A, in the frame.
class AreaDistances {
 public:
  virtual ~AreaDistances() = default;
  virtual Tallied tally(const Tally& asked) = 0;
  /// The least distance that each share of A's area is within.
  virtual std::vector<Enclosure> percentiles(const PercentileSearch& search) = 0;
  virtual double reached() = 0;  ///< some point is so far,
  virtual double highest() = 0;  ///< and none is farther
};

/// Takes them from cells that the host holds. Both outlive it.
class StoredDistances : public AreaDistances {
 public:
  StoredDistances(const CellStore& store, const Areas& areas) : store_(store), areas_(areas) {}
  Tallied tally(const Tally& asked) override;
  std::vector<Enclosure> percentiles(const PercentileSearch& search) override {
    return vkh::percentiles(store_, areas_, search);
  }
  double reached() override { return static_cast<double>(store_.reached()); }
  double highest() override;

 private:
  const CellStore& store_;
  const Areas& areas_;
};

/// Whether shares within bands are all that a survey has goals for, and all that it draws: other
/// figures then have no estimate, and there is no curve.
bool has_only_shares(const SurveyOptions& options);

/// Returns the figures of A, or of its part within options.max_distance; nothing if A has no area.
std::optional<Statistics> statistics_of(AreaDistances& distances, const Areas& areas,
                                        const SurveyedPair& pair, const SurveyOptions& options);

/// Makes the middle of each figure's interval its estimate: where a goal is met, that is within
/// half of what it allows.
void add_middles(bool only_shares, Statistics& statistics);

}  // namespace vkh
