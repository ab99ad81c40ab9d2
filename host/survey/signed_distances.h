// The distribution of the signed distance over A: positive over B, negative under B, and of either
// sign where there is no side.
#pragma once

#include <array>

#include "host/survey/area_figures.h"
#include "host/survey/shares_seen.h"
#include "host/survey/wave_survey.h"

namespace vkh {

/// Cells by their classes: over B, under it, and without a side.
inline constexpr uint32_t kOverB = 1u << gpu::kClassOver, kUnderB = 1u << gpu::kClassUnder,
                          kWithoutSide = gpu::kAllClasses & ~(kOverB | kUnderB);
/// Cells without a side whose parts may have one: segments and points of B, faces on each other and
/// too many faces remain a reason however small a cell is.
inline constexpr uint32_t kMayGetSide = 1u << gpu::kClassMeets | 1u << gpu::kClassEdge;

class SignedDistances : public AreaDistances {
 public:
  /// The cells of `waves` have their sides. It outlives this.
  explicit SignedDistances(WaveSurvey& waves) : waves_(waves) {}

  /// Returns shares within thresholds of either sign, and the mean. Moments have no rms.
  Tallied tally(const Tally& asked) override;
  std::vector<Enclosure> percentiles(const PercentileSearch& search) override;
  double reached() override { return waves_.reached(); }
  double highest() override { return waves_.highest(); }

  WaveSurvey& cells() { return waves_; }
  /// A lower bound of the mean distance without its sign, from the last moments.
  double plain_mean() const { return plain_mean_; }

 private:
  std::optional<Tallied> tally_side(const Tally& asked, uint32_t classes);
  Tallied last_answer(const Tally& asked);

  WaveSurvey& waves_;
  SharesSeen shares_;
  Enclosure mean_{-kAnyDistance, kAnyDistance};
  double plain_mean_ = 0;
};

}  // namespace vkh
