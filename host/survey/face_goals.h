// The goals of faces by waves: each is proven within a limit or beyond it, or its bounds are
// narrow.
#pragma once

#include "host/survey/area_figures.h"
#include "host/survey/wave_goals.h"

namespace vkh {

/// A cell scores if it keeps its face open: the face may be farther there than it is known to
/// reach, by more than is allowed.
class FaceGoals : public WaveGoals {
 public:
  /// All arguments outlive it.
  FaceGoals(const SurveyOptions& options, const SurveyedPair& pair, AreaDistances& distances)
      : asked_(options, pair), distances_(distances) {}

  /// Asks for verdicts by the options' limit alone.
  void begin_verdicts() { is_by_verdict_ = true; }
  /// Asks for narrow bounds.
  void begin_widths() { is_by_verdict_ = false; }

  bool look(const Tallied& /*tallied*/) override { return false; }
  bool are_met() const override { return false; }
  SurveyEnd at_rest(bool is_stuck) const override {
    return is_stuck ? SurveyEnd::kBits : SurveyEnd::kMet;
  }
  gpu::SurveyPlan plan(double whole) const override;
  double part() const override { return kNearlyAll; }

 private:
  double tolerance() const;

  const FiguresAsked asked_;
  AreaDistances& distances_;
  bool is_by_verdict_ = false;
};

}  // namespace vkh
