// What is to be known of all of A besides its distance, before its meshes are.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/answer/answer.h"
#include "host/mesh/mesh.h"
#include "host/solve/solver.h"

namespace vkh {

struct SurveyWish {
  bool faces = false;  ///< bounds of each: for a picture, or a file
  std::optional<Length> face_tolerance;
  bool statistics = false;
  std::vector<Length> bands;
  std::optional<double> area;  ///< gate: the share of A's area that is to be within the limit
  std::string area_requested;  ///< as typed

  bool is_any() const { return faces || statistics || area; }
};

/// What one needs.
struct SurveyJob {
  const SurveyWish& wish;
  const Mesh& a;
  const Mesh& b;
  std::function<double()> left_s;    ///< of the time for it; infinite: no limit
  std::function<bool()> goes_on;     ///< false: it is to end
  std::function<void(size_t)> show;  ///< how many cells have been bounded
};

/// Of A, and of B where the answer has a way back; each in a run of its own, after what the answer
/// says now. `options`: of that. Narrows the answer's intervals by what it finds.
void survey_all(const SurveyJob& job, Solver& solver, const SolveOptions& options, Answer& answer);

/// Asks for nothing.
inline void no_survey(const SurveyedPair&, const BoundCells&) {}

}  // namespace vkh
