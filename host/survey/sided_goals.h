// The goals of sides by waves: limits that differ by side, area without a side, signed figures.
#pragma once

#include <array>
#include <vector>

#include "host/survey/signed_distances.h"
#include "host/survey/wave_goals.h"

namespace vkh {

/// A cell scores if it may be beyond the limit of its side, or has none and may be beyond the
/// smaller one. The goal is also met as soon as some point is beyond.
class SidedLimitGoals : public WaveGoals {
 public:
  /// `options` ask for limits of sides.
  SidedLimitGoals(const SurveyOptions& options, const SurveyedPair& pair, WaveSurvey& waves);

  /// Cells that are nowhere farther need no side, in the frame.
  double least() const { return std::min(over_.down, under_.down); }

  bool look(const Tallied& tallied) override;
  bool are_met() const override { return are_met_; }
  gpu::SurveyPlan plan(double whole) const override;
  double part() const override { return kNearlyAll; }

 private:
  const Threshold over_, under_;
  WaveSurvey& waves_;
  bool are_met_ = false;
};

/// A cell without a side that may get one scores by its area, until at most a twentieth of A's area
/// has no side and is farther from B than a hundredth of the largest distance. The signed distance
/// of nearer points is known well enough without a side.
class UnsidedGoals : public WaveGoals {
 public:
  explicit UnsidedGoals(WaveSurvey& waves) : waves_(waves) {}

  bool look(const Tallied& tallied) override;
  bool are_met() const override { return are_met_; }
  gpu::SurveyPlan plan(double whole) const override;
  double part() const override { return kNearlyAll; }

 private:
  double near() const { return 0.01 * waves_.reached(); }

  WaveSurvey& waves_;
  bool are_met_ = false;
};

/// The signed mean and percentiles.
class SignedGoals : public WaveGoals {
 public:
  SignedGoals(const SurveyOptions& options, const SurveyedPair& pair, SignedDistances& distances);

  std::vector<Threshold> thresholds() const override;
  std::optional<Threshold> wanted_moments() const override;
  bool look(const Tallied& tallied) override;
  bool are_met() const override;
  gpu::SurveyPlan plan(double whole) const override;
  double part() const override { return kNearlyAll; }

 private:
  double enough(const Enclosure& figure) const;
  bool is_open(const Enclosure& figure) const {
    return figure.upper - figure.lower > enough(figure);
  }

  const SurveyOptions& options_;
  SignedDistances& distances_;
  const double least_;  // the width that is always enough, in the frame
  Enclosure mean_;
  std::vector<QuantileGoal> quantiles_;
};

}  // namespace vkh
