// The goals of a survey by waves: the state of each figure, the thresholds of the next tally, and
// the scores of the next wave's cells.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "host/survey/figures_asked.h"
#include "host/survey/quantile_goal.h"

namespace vkh {

/// The part of all scores that is split in one pass, the largest first: nine tenths, since a few
/// wide cells often matter more than all others together.
inline constexpr double kNearlyAll = 0.9;
/// The part of the scores to split so that a figure becomes as narrow as `enough`: the halves of a
/// cell have together about half of its width, so splitting twice the excess is enough.
inline double part_to_split(double width, double enough) {
  return std::clamp(2 * (width - enough) / width, 0.05, kNearlyAll);
}

/// A reason to split cells.
class WaveGoals {
 public:
  virtual ~WaveGoals() = default;
  /// The thresholds for the next tally. They follow from what is known.
  virtual std::vector<Threshold> thresholds() const { return {}; }
  /// Set if the next tally has to have moments, too: distances beyond it count as 0.
  virtual std::optional<Threshold> wanted_moments() const { return {}; }
  /// Uses a tally at these thresholds. Returns whether another tally would narrow a percentile
  /// without a split, since the thresholds were farther apart than the cells' bounds.
  virtual bool look(const Tallied& tallied) = 0;
  /// Whether splits would gain nothing.
  virtual bool are_met() const = 0;
  /// The end of a survey if no cell scores and the goals are not met. `is_stuck`: some cell keeps
  /// its face open, and no split helps.
  virtual SurveyEnd at_rest(bool /*is_stuck*/) const { return SurveyEnd::kBits; }
  /// Scores a cell by its part of the widths of all figures that are open.
  virtual gpu::SurveyPlan plan(double whole) const = 0;
  /// The part of all scores that a wave should split.
  virtual double part() const = 0;
  /// Whether a wave pays: the cells that it would split, and all cells.
  virtual bool is_worth(size_t, size_t) const { return true; }
  /// The parts that a cell is split into.
  virtual uint32_t parts() const { return 4; }
};

/// Scores cells of some classes by their undecided area at a threshold. A plan has room for some of
/// them; the others wait for later waves.
void add_open(const Threshold& at, double weight, gpu::SurveyPlan& plan,
              uint32_t classes = gpu::kAllClasses);

/// The weight with which a figure's whole width scores 1. The width is not 0 while the figure is
/// open, except for shares of percentiles, whose ends are only known by thresholds.
double weight_of_width(double width);

/// The figures that options ask for.
class FigureGoals : public WaveGoals {
 public:
  /// No distance is above `farthest`, in the frame.
  FigureGoals(const SurveyOptions& options, const SurveyedPair& pair, double farthest);

  std::vector<Threshold> thresholds() const override;
  std::optional<Threshold> wanted_moments() const override;
  bool look(const Tallied& tallied) override;
  bool are_met() const override;
  gpu::SurveyPlan plan(double whole) const override;
  double part() const override;

 private:
  struct Band {
    Threshold at;
    Enclosure share = {0, 1};
    bool is_atom = false;
  };
  bool is_open(size_t band) const;
  bool is_open(const QuantileGoal& p) const;
  bool is_open_mean() const;
  bool is_open_rms() const;

  static constexpr double kUnknown = std::numeric_limits<double>::infinity();
  FiguresAsked asked_;
  std::vector<Band> bands_;
  std::vector<QuantileGoal> quantiles_;
  Moments moments_{{0, kUnknown}, {0, kUnknown}};
};

}  // namespace vkh
