#include "host/answer/survey_wish.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "host/base/error.h"
#include "host/base/note.h"

namespace vkh {
namespace {

constexpr double kPartOfTime = 0.85;  // adding up and the outputs need the rest

Limit resolved(const Length& length, const char* option, const Answer& answer) {
  return in_files(length, option, answer.unit, answer.a_to_b.diagonal_a);
}

// Returns each band as two: rounded down, and up.
std::vector<Limit> bands_of(const SurveyWish& wish, const Answer& answer) {
  std::vector<Limit> bands;
  if (answer.max && (wish.area || wish.statistics)) bands.push_back(answer.max->limit);
  for (const Length& band : wish.bands) {
    bands.push_back(limit_in_files(band, "--bands", answer.unit, answer.a_to_b.diagonal_a));
  }
  return bands;
}

SurveyOptions options_of(const SurveyJob& job, const Answer& answer, size_t left) {
  const SurveyWish& wish = job.wish;
  SurveyOptions options;
  options.faces = wish.faces;
  if (wish.face_tolerance)
    options.field_tolerance = resolved(*wish.face_tolerance, "--field-tol", answer).within;
  if (answer.max) options.limit = answer.max->limit;
  options.statistics = wish.statistics || wish.area;
  for (const Limit& band : bands_of(wish, answer))
    options.bands.insert(options.bands.end(), {band.within, band.beyond});
  options.enough = wish.area;
  if (!wish.statistics) options.percentiles.clear();
  if (!wish.statistics) options.mean_tolerance = 1;  // a share of area is all that is asked
  const double time = job.left_s();
  if (std::isfinite(time))
    options.time_limit_s = kPartOfTime * std::max(time, 0.0) / static_cast<double>(left);
  if (wish.effort) options.effort = *wish.effort;
  options.goes_on = [&job](size_t cells) {
    job.show(cells);
    return job.goes_on();
  };
  return options;
}

// Joins both: a share that holds from a length rounded down up to it rounded up holds for it.
void join_bands(Statistics& s) {
  std::vector<AreaWithin> bands;
  for (size_t i = 0; i + 1 < s.bands.size(); i += 2) {
    const AreaWithin &down = s.bands[i], &up = s.bands[i + 1];
    bands.push_back(
        {typed_length({down.distance, up.distance}), {down.share.lower, up.share.upper}});
  }
  s.bands = std::move(bands);
}

// Narrows the report, since a run that only decides a limit leaves a wide interval: no distance is
// above the largest bound of a face. A run that ended before its survey began has one bound for all
// faces.
void join(Report& report, SurveyResult& survey, size_t face_count) {
  Field& field = survey.field;
  if (field.face_count() != face_count) field = field_within(face_count, report.upper);
  report.upper = std::min(report.upper, *std::max_element(field.upper.begin(), field.upper.end()));
  if (survey.statistics) join_bands(*survey.statistics);
}

struct SurveyedSide {
  const Mesh& from;
  const Mesh& to;
  const char* name;
};

SurveyResult survey_one(const SurveyJob& job, const SurveyedSide& side, const SurveyOptions& asked,
                        Solver& solver, SolveOptions options) {
  SurveyResult result;
  options.limit = {};
  options.known_lower = 0;
  options.coverage = false;
  options.wave_limit = 1;
  options.time_limit_s = std::numeric_limits<double>::infinity();
  options.progress = [&job](const Progress&) { return job.goes_on(); };
  options.survey = survey_with(asked, result);
  if (job.goes_on()) solver.distance(side.from, side.to, options);
  return result;
}

}  // namespace

void survey_all(const SurveyJob& job, Solver& solver, const SolveOptions& options, Answer& answer) {
  const auto one = [&](const SurveyedSide& side, Report& report, size_t left) {
    SurveyOptions asked = options_of(job, answer, left);
    asked.upper = report.upper;
    SurveyResult result;
    try {
      result = survey_one(job, side, asked, solver, options);
      if (result.ended == SurveyEnd::kCancelled && job.left_s() <= 0)
        result.ended = SurveyEnd::kTime;
    } catch (const std::bad_alloc&) {
      result.ended = SurveyEnd::kMemory;
      answer.notes.push_back(
          note_of(NoteCode::kSurvey, std::string("there was no memory to survey ") + side.name));
    } catch (const MemoryError&) {
      result.ended = SurveyEnd::kMemory;
      answer.notes.push_back(note_of(
          NoteCode::kSurvey, std::string("the device had no memory to survey ") + side.name));
    }
    join(report, result, side.from.faces.size());
    if (asked.statistics && !result.statistics)
      answer.notes.push_back(
          note_of(NoteCode::kSurvey, std::string("there are no statistics of ") + side.name));
    return result;
  };
  const size_t count = answer.b_to_a ? 2 : 1;
  answer.survey_a = one({job.a, job.b, "A"}, answer.a_to_b, count);
  if (answer.b_to_a) answer.survey_b = one({job.b, job.a, "B"}, *answer.b_to_a, 1);
}

}  // namespace vkh
