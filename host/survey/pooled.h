// Two surfaces as one: the share of their area within a distance is w F_A + (1 - w) F_B, with
// w = a_A / (a_A + a_B).
#pragma once

#include <vector>

#include "host/survey/distribution.h"
#include "host/survey/wave_goals.h"

namespace vkh {

/// The least distance that `share` of both surfaces' area is within. `known` encloses it.
Enclosure pooled_percentile(const Distribution& a, const Distribution& b, double share,
                            const Enclosure& known);

/// Whether an enclosure of that percentile that is wider than `enough` stays so at any effort:
/// nearly no area lies between its ends.
bool is_pooled_jump(const Distribution& a, const Distribution& b, const Enclosure& e,
                    double enough);

/// The search for that percentile, by the cells of one surface.
struct PooledSearch {
  const Distribution* other;  ///< of the other one
  double share = 0;
  Enclosure known = {};  ///< encloses it, in the files' units
};

/// The goal of one surface's cells. It is given up at a jump, and when the other surface's cells
/// matter more. All arguments outlive it.
class PooledGoals : public WaveGoals {
 public:
  PooledGoals(const PooledSearch& search, const Distribution& own, const SurveyedPair& pair)
      : search_(search), own_(own), pair_(pair), known_(search.known) {}

  bool look(const Tallied& tallied) override;
  bool are_met() const override { return !is_open_; }
  gpu::SurveyPlan plan(double whole) const override;
  double part() const override { return kNearlyAll; }
  const Enclosure& known() const { return known_; }
  /// Both ends of the percentile, in the frame.
  std::vector<Threshold> ends() const;

 private:
  bool is_worth_splits() const;

  const PooledSearch& search_;
  const Distribution& own_;
  const SurveyedPair& pair_;
  Enclosure known_;
  bool is_open_ = true;
};

}  // namespace vkh
