// The goals of a map, and the map from a survey's cells.
#pragma once

#include <cmath>
#include <optional>

#include "host/survey/lengths.h"
#include "host/survey/wave_goals.h"
#include "host/survey/wave_survey.h"

namespace vkh {

/// A cell scores if it is unresolved, not left out, and larger than an eighth of a pixel or longer
/// than two.
class MapGoals : public WaveGoals {
 public:
  /// `options` ask for a map. A has an area, and no distance is above `farthest`, in the frame.
  MapGoals(const SurveyOptions& options, const SurveyedPair& pair, const Areas& areas,
           double farthest);

  std::vector<Threshold> thresholds() const override;
  bool look(const Tallied& tallied) override;
  bool are_met() const override { return false; }
  SurveyEnd at_rest(bool /*is_stuck*/) const override { return SurveyEnd::kMet; }
  gpu::SurveyPlan plan(double whole) const override;
  double part() const override { return 1; }  // each cell that scores has to be split
  bool is_worth(size_t split, size_t cells) const override {
    return is_nearly_met_ || 50 * split >= cells;
  }
  uint32_t parts() const override { return is_nearly_met_ ? 2 : 4; }
  /// The end of the colours, in the frame, as far as it is known.
  double bar() const { return bar_; }
  /// First splits into four the cells that are too wide by a factor of two, and then into two the
  /// cells that are still too wide: halves have about half of a cell's width and area. The bar's
  /// end moves little by then, and is found once more.
  void begin_coarse() { begin(false); }
  void begin_fine() { begin(true); }

 private:
  void begin(bool fine) {
    is_nearly_met_ = fine;
    is_known_ = !is_sought_;
  }
  double least_bar() const { return std::ldexp(farthest_, -kOctaves); }
  static constexpr int kOctaves = 20, kCuts = 12;
  static constexpr double kNarrow =
      1.5;  // the factor by which the bar's end may move between two looks
  static constexpr double kPixels = 2;  // two make no round cell of an eighth of a pixel longer
  const double most_, open_, least_, longest_, floor_;
  const bool is_sought_;  // the bar's end,
  bool is_known_;         // for as long as cells are split as they are
  double bar_;            // in the frame
  const double farthest_;
  double from_, to_;  // where it is sought
  bool is_nearly_met_ = false;
};

/// The map of all cells, which `options` ask for, with the sides that were found. A has an area, or
/// is points.
CellMap map_of(WaveSurvey& waves, const Areas& areas, const SurveyedPair& pair,
               const SurveyOptions& options);
/// Adds sides that were found after the map was made.
void add_sides(WaveSurvey& waves, CellMap& map);

/// Whether MapOptions::sides_if_cheap asks for sides of this B: it is small, has no open edge, and
/// neither mesh stands for any triangulation of its polygons.
bool may_have_cheap_sides(const SurveyOptions& options, const SurveyedPair& pair);
/// The distance, in the frame, up to which a cell has the colour of 0, so that it needs no side,
/// beside a bar of that length. `reached`: some point is this far.
double near_zero(double bar, double reached);

}  // namespace vkh
