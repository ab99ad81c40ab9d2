// Normals by waves: the shares of A's area whose normals agree, and the mean cosine.
#pragma once

#include <vector>

#include "host/survey/wave_goals.h"
#include "host/survey/wave_survey.h"

namespace vkh {

/// A cell scores by its part of the widths of all figures of normals that are open.
class NormalGoals : public WaveGoals {
 public:
  NormalGoals(const SurveyOptions& options, const SurveyedPair& pair, WaveSurvey& waves);

  bool look(const Tallied& tallied) override;
  bool are_met() const override;
  gpu::SurveyPlan plan(double whole) const override;
  double part() const override;

  /// Encloses the mean over A's area of |cos| of the angle between the normals, and the share
  /// within each band whose normals agree; even if the survey was called off.
  Tallied figures() { return waves_.tally_anyway(asked()); }

 private:
  Tally asked() const;
  bool is_open_mean() const { return mean_ > options_.cosine_tolerance; }
  bool is_open(size_t band) const { return shares_[band] > options_.agreeing_tolerance; }

  const SurveyOptions& options_;
  WaveSurvey& waves_;
  const std::vector<Threshold> bands_;
  double mean_ = 1;             // widths: of the mean,
  std::vector<double> shares_;  // and of the shares
};

}  // namespace vkh
