// The wishes for all of A besides its distance, before its meshes are read.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/answer/answer.h"
#include "host/mesh/mesh.h"
#include "host/solve/solver.h"

namespace vkh {

struct SurveyWish {
  bool faces = false;  ///< bounds of each face: for a picture, or a file
  std::optional<Length> face_tolerance;
  bool statistics = false;
  std::vector<Length> bands;
  std::optional<double> area;      ///< gate: the share of A's area that is to be within the limit
  std::string area_requested;      ///< the share as the user typed it
  std::optional<uint64_t> effort;  ///< SurveyOptions::effort

  bool is_any() const { return faces || statistics || area; }
};

/// The inputs of one survey.
struct SurveyJob {
  const SurveyWish& wish;
  const Mesh& a;
  const Mesh& b;
  std::function<double()> left_s;    ///< the time left for it; infinite: no limit
  std::function<bool()> goes_on;     ///< false: the survey is to end
  std::function<void(size_t)> show;  ///< how many cells have been bounded
};

/// Surveys A, and B if the answer has a reverse direction; each in a run of its own, after the run
/// of the answer, which had `options`. Narrows the answer's intervals by what it finds.
void survey_all(const SurveyJob& job, Solver& solver, const SolveOptions& options, Answer& answer);

/// Asks for nothing.
inline void no_survey(const SurveyedPair&, const BoundCells&) {}

}  // namespace vkh
