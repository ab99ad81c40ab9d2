// One survey of a pair that lies on the device.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "host/survey/distribution.h"
#include "host/survey/normals.h"
#include "host/survey/pooled.h"
#include "host/survey/refining.h"
#include "host/survey/signed_figures.h"
#include "host/survey/wave_survey.h"

namespace vkh {

/// Its cells stay where they are for more to be asked of them: on the device, where the figures of
/// a surface are all that is asked for, and else in the host's memory.
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
  Distribution distribution() { return {*distances_, areas_, pair_}; }
  /// Goes on for the pooled percentile, for so long at most, and adds to the result what that took;
  /// all its figures stay. Returns whether cells were split.
  bool narrow(const PooledSearch& search, double time_limit_s, SurveyResult& result);

 private:
  bool goes_by_waves() const;
  float farthest() const;
  void refine_by_waves(SurveyResult& result);
  SurveyEnd refine_faces(size_t effort);
  void refine_store(SurveyResult& result);
  void take_cells();
  void add_field(SurveyResult& result);
  void add_figures(SurveyResult& result);
  void add_normals(Statistics& statistics);
  void add_map(SurveyResult& result);
  void add_counts(SurveyResult& result) const;

  SurveyedPair pair_;
  const SurveyOptions& options_;
  const bool has_cheap_sides_;
  SurveyMeter meter_;
  Refining refining_;
  const Areas areas_;
  std::optional<WaveSurvey> waves_;
  std::optional<CellStore> store_;
  std::unique_ptr<AreaDistances> stored_;
  AreaDistances* distances_ = nullptr;  // of waves_, or stored_
  std::optional<SidedCells> sided_;
  std::optional<NormalCells> normals_;
};

}  // namespace vkh
