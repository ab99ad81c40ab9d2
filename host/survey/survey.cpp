#include "vkhausdorff/survey.h"

#include <algorithm>

#include "host/survey/survey_with.h"
#include "host/survey/surveying.h"

namespace vkh {

const char* survey_end_name(SurveyEnd end) {
  switch (end) {
    case SurveyEnd::kMet:
      return "met";
    case SurveyEnd::kBits:
      return "bits";
    case SurveyEnd::kEffort:
      return "effort";
    case SurveyEnd::kTime:
      return "time";
    case SurveyEnd::kCancelled:
      return "cancelled";
    case SurveyEnd::kMemory:
      return "memory";
  }
  return "";
}

size_t default_effort(bool on_cpu) { return on_cpu ? 4'000'000 : 10'000'000; }

FieldSummary summary_of(const Field& field, const Limit& limit) {
  FieldSummary summary{.faces = field.face_count()};
  for (size_t f = 0; f < field.face_count(); ++f) {
    summary.width = std::max(summary.width, field.upper[f] - field.lower[f]);
    const Verdict verdict = verdict_of(field, f, limit);
    ++(verdict == Verdict::kWithin   ? summary.within
       : verdict == Verdict::kBeyond ? summary.beyond
                                     : summary.undecided);
  }
  return summary;
}

Verdict verdict_of(const Enclosure& over, const Enclosure& under, const SidedLimits& limits) {
  const Verdict of_over = verdict_of(over.lower, over.upper, limits.over);
  const Verdict of_under = verdict_of(under.lower, under.upper, limits.under);
  if (of_over == Verdict::kBeyond || of_under == Verdict::kBeyond) return Verdict::kBeyond;
  return of_over == Verdict::kWithin ? of_under : of_over;
}

FieldSummary summary_of(const Field& field, const SignedFigures& sides, const SidedLimits& limits) {
  FieldSummary summary = summary_of(field, limits.larger());
  summary.within = summary.beyond = summary.undecided = 0;
  for (size_t f = 0; f < sides.over_of_faces.face_count(); ++f) {
    const Verdict verdict =
        verdict_of(sides.over_of_faces.of(f), sides.under_of_faces.of(f), limits);
    ++(verdict == Verdict::kWithin   ? summary.within
       : verdict == Verdict::kBeyond ? summary.beyond
                                     : summary.undecided);
  }
  return summary;
}

Field field_within(size_t face_count, double upper) {
  return {std::vector<double>(face_count, 0.0), std::vector<double>(face_count, upper)};
}

UsePair survey_with(const SurveyOptions& options, SurveyResult& result) {
  return [&options, &result](const SurveyedPair& pair) { Surveying(pair, options).run(result); };
}

SurveyResult survey_mesh(Solver& solver, const PairView& pair, const SurveyOptions& options,
                         const SolveOptions& run) {
  SurveyResult result;
  hold_pair(solver, pair, run, survey_with(options, result));
  return result;
}

}  // namespace vkh
