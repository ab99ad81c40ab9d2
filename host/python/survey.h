// The questions of Python about all of A besides its distance, and their results.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/base/float_environment.h"
#include "host/base/length.h"
#include "host/python/answer.h"
#include "host/python/arguments.h"
#include "host/survey/survey.h"

namespace vkh::python {

/// Reads a string such as '0.1%' or '0.01abs'. Arrays have no known unit: '0.1mm' is refused.
Length length_from(const char* name, const char* expected, pybind11::handle given,
                   PlainNumber plain);

/// A distance as the caller gave it, and where among SurveyOptions::bands it is: its `text`, or the
/// number itself. The value of a text lies from the first of them to the last.
struct Band {
  std::string text;
  size_t first, last;
};

struct SurveyAsked {
  SurveyOptions options;
  bool is_any = false;
  std::vector<Band> bands;
  std::optional<double> area;
};

/// Reads the keywords field, statistics, bands, effort and survey_time, in terms of A's own
/// diagonal, as `tol` is.
SurveyAsked read_survey(const Arguments& given, const Mesh& a);
/// Reads those of gate(), whose limit is `max`: it is a band, too, of the text it was given as.
void read_area(const Arguments& given, const Limit& limit, SurveyAsked& asked);

struct Surveyed {
  SurveyResult result;
  double upper = 0;  ///< no distance of the mesh is above it
};

/// The survey of A, and of B in the reverse direction.
struct Surveys {
  Surveyed a, b;
};

/// Surrounds the runs of a call, within Session::use. Without a limit the surveys are in the run
/// that looks for the distance; beside one that only decides a limit they have runs of their own.
class SurveyRun {
 public:
  SurveyRun(const SurveyAsked& asked, const SolveOptions& options, const Mesh& a, Surveys& found,
            bool is_apart = false);
  SurveyRun(const SurveyRun&) = delete;
  SurveyRun& operator=(const SurveyRun&) = delete;

  /// The options to run with.
  const SolveOptions& options() const { return options_; }
  /// Called after it: runs of one wave, one for each direction, if surveys are apart.
  void beside(const std::function<void(const SolveOptions&)>& run);

 private:
  void hook();
  SurveyOptions survey_;
  SolveOptions options_;
  const Mesh& a_;
  Surveys& found_;
  std::optional<FloatEnvironment> ours_;  // so that handlers of signals run in the caller's
  bool is_any_, is_apart_, is_cancelled_ = false;
};

/// Narrows the bounds: no distance is above any face's. If a run ended before its survey could
/// begin, no face's is above the distance.
void narrow(const SurveyAsked& asked, Report& report, Surveyed& survey);

/// Adds the surveys, and the verdict on a share of area, to the answer, with the GIL. `b`: null in
/// a directed run.
void add_surveys(const SurveyAsked& asked, const Surveyed& a, const Surveyed* b, Answer& answer);

}  // namespace vkh::python
