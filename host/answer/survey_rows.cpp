// A survey as rows of the table.
#include <algorithm>
#include <cmath>

#include "host/answer/answer.h"
#include "host/base/decimal.h"

namespace vkh {
namespace {

std::string number(double x, double gap, Rounding rounding) {
  return decimal(x, digits_that_matter(x, gap), rounding);
}

std::string enclosure(const Enclosure& e, const std::string& unit) {
  const double gap = e.upper - e.lower;
  std::string text = "[";
  text += number(e.lower, gap, Rounding::kDown);
  text += ", ";
  text += number(e.upper, gap, Rounding::kUp);
  text += unit.empty() ? "]" : "] " + unit;
  return text;
}

// Converts to percent, outward: 100 times a share is rounded, unless it is 0 or 1.
Enclosure in_percent(const Enclosure& share) {
  const double up = std::nextafter(100 * share.upper, 101.0);
  return {share.lower < 1 ? std::nextafter(100 * share.lower, 0.0) : 100,
          share.upper > 0 && share.upper < 1 ? up : 100 * share.upper};
}

std::string field_text(const Field& field, const Answer& answer) {
  const FieldSummary summary = summary_of(field, answer.max ? answer.max->limit : Limit{});
  const std::string faces = std::to_string(field.face_count()) + " faces";
  if (!answer.max)
    return faces + " bounded to " + length_up(answer, summary.width, summary.width) + " or closer";
  return faces + ": " + std::to_string(summary.within) + " within the limit, " +
         std::to_string(summary.beyond) + " beyond, " + std::to_string(summary.undecided) +
         " undecided";
}

std::string percentiles_text(const std::vector<Percentile>& percentiles, const std::string& unit) {
  std::string text;
  for (const Percentile& p : percentiles)
    text += (text.empty() ? "p" : ", p") + shortest_decimal(100 * p.share) + " " +
            enclosure(p.distance, unit);
  return text;
}

const char* reason_of(SurveyEnd end) {
  switch (end) {
    case SurveyEnd::kEffort:
      return "its effort was used";
    case SurveyEnd::kTime:
      return "its time ended";
    case SurveyEnd::kCancelled:
      return "it was interrupted";
    case SurveyEnd::kMemory:
      return "there was no memory for it";
    default:
      return "no split narrows it more";
  }
}

std::string end_text(const SurveyResult& survey) {
  return std::string(": ") + reason_of(survey.ended) +
         " before all that was asked was met, and all is true as it is";
}

}  // namespace

std::vector<TableRow> survey_rows(const Answer& answer, const SurveyResult& survey) {
  std::vector<TableRow> rows;
  const std::string& unit = answer.unit;
  if (survey.faces) rows.push_back({"faces", field_text(survey.field, answer)});
  if (survey.statistics) {
    const Statistics& s = *survey.statistics;
    rows.push_back(
        {"mean", enclosure(s.mean, unit) + ", root mean square " + enclosure(s.rms, unit)});
    for (const AreaWithin& band : s.bands)
      rows.push_back({"area", enclosure(in_percent(band.share), "%") + " within " +
                                  length_in_words({band.distance, band.distance}) +
                                  (unit.empty() ? "" : " " + unit)});
    if (!s.percentiles.empty())
      rows.push_back({"percentile", percentiles_text(s.percentiles, unit)});
  }
  std::string work = std::to_string(survey.bounded) + " cells bounded in " +
                     decimal(survey.ms / 1000, 3, Rounding::kUp) + " s";
  if (!survey.is_met()) work += end_text(survey);
  rows.push_back({"survey", work});
  return rows;
}

}  // namespace vkh
