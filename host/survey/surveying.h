// One survey of a pair that lies on the device.
#pragma once

#include <optional>
#include <vector>

#include "host/survey/distribution.h"
#include "host/survey/pooled.h"
#include "host/survey/sides.h"
#include "host/survey/signed_distances.h"
#include "host/survey/wave_survey.h"

namespace vkh {

/// Its cells stay on the device for more to be asked of them. The host takes a copy for a map.
class Surveying {
 public:
  /// `pair` lies on the device as long as it. Both outlive it. Throws what survey_mesh() names.
  Surveying(const SurveyedPair& pair, const SurveyOptions& options);
  Surveying(const Surveying&) = delete;
  Surveying& operator=(const Surveying&) = delete;

  /// Surveys the pair and writes `result`. It is called once.
  void run(SurveyResult& result);

  /// The distribution of A's distances by the cells as they are. A run with statistics came before,
  /// and found some.
  Distribution distribution() { return {*waves_, areas_, pair_}; }
  /// Goes on for the pooled percentile, for so long at most, and adds to the result what that took;
  /// all its figures stay. Returns whether more is known of some cells.
  bool narrow(const PooledSearch& search, double time_limit_s, SurveyResult& result);

 private:
  float farthest() const;
  SurveyEnd measure_points();
  void refine(SurveyResult& result);
  SurveyEnd refine_faces(size_t effort);
  SurveyEnd refine_or_look(WaveGoals& goals, AreaDistances& distances);
  SurveyEnd refine_sides();
  void add_figures(SurveyResult& result);
  void add_sides_of_all(SurveyResult& result);
  void add_normals(SurveyResult& result);
  void add_map(SurveyResult& result);
  void add_cheap_sides(CellMap& map);
  void add_counts(SurveyResult& result) const;

  SurveyedPair pair_;
  const SurveyOptions& options_;
  const bool has_cheap_sides_;
  SurveyMeter meter_;
  const Areas areas_;
  std::optional<Sides> sides_;
  std::optional<WaveSurvey> waves_;
  std::optional<SignedDistances> signed_;
};

}  // namespace vkh
