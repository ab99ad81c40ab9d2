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

/// Its cells stay on the device for further questions. The host reads a copy of them for a map.
class Surveying {
 public:
  /// `pair` is on the device as long as this lives. Both arguments outlive it. Throws what
  /// survey_mesh() names.
  Surveying(const SurveyedPair& pair, const SurveyOptions& options);
  Surveying(const Surveying&) = delete;
  Surveying& operator=(const Surveying&) = delete;

  /// Surveys the pair and writes `result`. It is called once.
  void run(SurveyResult& result);

  /// The distribution of A's distances, by the present cells. Call it after a run that returned
  /// statistics.
  Distribution distribution() { return {*waves_, areas_, pair_}; }
  /// Goes on for the pooled percentile, for at most `time_limit_s`, and adds the cost to the
  /// result, whose figures stay. Returns whether some cells are better known.
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
  bool find_cheap_sides(double bar);
  void add_counts(SurveyResult& result) const;

  SurveyedPair pair_;
  const SurveyOptions& options_;
  const bool has_cheap_sides_;
  SurveyMeter meter_;
  const Areas areas_;
  std::optional<Sides> sides_, cheap_sides_;  // those asked for; those of a map
  std::optional<WaveSurvey> waves_;
  std::optional<SignedDistances> signed_;
};

}  // namespace vkh
