// Surveys and metrics as rows of the table.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "host/answer/figures.h"
#include "host/base/decimal.h"
#include "vkhausdorff/answer.h"

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

// What a figure probably is, with the digits that matter beside `gap`, or as many as are inside.
std::string likely(const Enclosure& e, double gap) {
  const double value = e.estimate.value_or(e.lower);
  return decimal_inside(value, e.lower, e.upper, digits_that_matter(value, gap));
}

// A figure: what it probably is, and the interval that it is proven to lie in.
std::string figure(const Enclosure& e, const std::string& unit) {
  if (!e.estimate || !(e.lower < e.upper)) return enclosure(e, unit);
  return likely(e, e.upper - e.lower) + ", in " + enclosure(e, unit);
}

// Converts to percent, outward: 100 times a share is rounded, unless it is 0 or 1.
Enclosure in_percent(const Enclosure& share) {
  const double up = std::nextafter(100 * share.upper, 101.0);
  Enclosure percent{share.lower < 1 ? std::nextafter(100 * share.lower, 0.0) : 100,
                    share.upper > 0 && share.upper < 1 ? up : 100 * share.upper};
  if (share.estimate)
    percent.estimate = std::clamp(100 * *share.estimate, percent.lower, percent.upper);
  return percent;
}

bool is_of_b(const SurveyResult& survey, const Answer& answer) {
  return answer.survey_b && &*answer.survey_b == &survey;
}

bool is_of_points(const SurveyResult& survey, const Answer& answer) {
  return answer.inputs[is_of_b(survey, answer) ? 1 : 0].are_points;
}

std::string field_text(const SurveyResult& survey, const Answer& answer) {
  const FieldSummary summary = summary_of(answer, survey);
  const std::string faces = std::to_string(survey.field.face_count()) +
                            (is_of_points(survey, answer) ? " points" : " faces");
  if (!answer.max)
    return faces + " bounded to " + length_up(answer, summary.width, summary.width) + " or closer";
  return faces + ": " + std::to_string(summary.within) + " within the limit, " +
         std::to_string(summary.beyond) + " beyond, " + std::to_string(summary.undecided) +
         " undecided";
}

std::string percentiles_text(const std::vector<Percentile>& percentiles, const std::string& unit,
                             bool are_points) {
  std::string text;
  for (const Percentile& p : percentiles) {
    text += (text.empty() ? "p" : "; p") + shortest_decimal(100 * p.share) + " " +
            figure(p.distance, unit);
    if (p.jump)
      text +=
          std::string(" (a jump: nearly no ") + (are_points ? "point" : "area") + " lies between)";
  }
  return text;
}

std::string jump_text(const AreaWithin& band) {
  return band.jump ? " (a jump: the rest lies at this distance)" : "";
}

// Shares are known to 1e-12, which nobody wants to read: a hundredth of a percent is shown.
std::string share_text(const Enclosure& share) {
  const Enclosure percent = in_percent(share);
  constexpr double kShown = 0.01;
  return "[" + number(percent.lower, kShown, Rounding::kDown) + ", " +
         number(percent.upper, kShown, Rounding::kUp) + "] %";
}

// "61.2 % of A's area over B, 38.1 % under it", and why the rest has no side.
std::string area_of_sides(const SignedFigures::Areas& areas, bool are_points) {
  std::string text = share_text(areas.over) + " of the " + (are_points ? "points" : "area") +
                     " over, " + share_text(areas.under) + " under";
  for (size_t k = 1; k < kDoubts; ++k) {
    if (areas.doubts[k].upper > 0)
      text += ", " + share_text(areas.doubts[k]) + " unsigned (" +
              doubt_name(static_cast<Doubt>(k)) + ")";
  }
  return text;
}

std::string inside_in_words(const SignedFigures& sides) {
  if (sides.inside_out == InsideOut::kAll && sides.inside == Inside::kProven)
    return "it has an inside, which decides, and is inside out: over means inside it";
  switch (sides.inside) {
    case Inside::kProven:
      return "it has an inside, which decides";
    case Inside::kOpen:
      return "it is open at " + std::to_string(sides.edges.open) +
             " edges: the closest faces decide";
    case Inside::kCrossing:
      return "faces of it cross or lie on each other: the closest faces decide";
    case Inside::kWinding:
      return "its shells are in each other, or of both kinds: the closest faces decide";
    case Inside::kUndecided:
      return "whether it has an inside was not decided: the closest faces decide";
  }
  return "";
}

/// A mesh whose survey becomes rows.
struct Surveyed {
  const char* other;  ///< the mesh on whose sides it lies
  bool are_points;
};

void add_sides(const SignedFigures& sides, const std::string& unit, const Surveyed& of,
               std::vector<TableRow>& rows) {
  const bool are_points = of.are_points;
  rows.push_back({"sides", "farthest over " + enclosure(sides.over, unit) + ", under " +
                               enclosure(sides.under, unit)});
  if (sides.areas)
    rows.push_back(
        {are_points ? "sides of" : "side area", area_of_sides(*sides.areas, are_points)});
  if (sides.mean) {
    rows.push_back({"signed", "mean " + figure(*sides.mean, unit)});
    rows.push_back({"signed", percentiles_text(sides.percentiles, unit, are_points)});
  }
  rows.push_back({std::string("side of ") + of.other, inside_in_words(sides)});
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

namespace {

// Counts of points that are surely, and perhaps, so many: n times a share, rounded outward.
std::string counts_text(const Enclosure& share, uint64_t points) {
  const auto n = static_cast<double>(points);
  const double least = std::ceil(std::nextafter(n * share.lower, 0.0));
  const double most = std::floor(std::nextafter(n * share.upper, n + 1));
  std::string text = decimal(least, 12, Rounding::kDown);
  if (most > least) text += " to " + decimal(most, 12, Rounding::kUp);
  return text;
}

// Says what figures are of, and what they leave out.
std::string kept_text(const Statistics& s, const std::string& unit) {
  const std::string length = length_in_words({s.max_distance, s.max_distance});
  if (s.kept->upper == 0) return "none: nothing is within " + length;
  const std::string within = " within " + length + (unit.empty() ? "" : " " + unit);
  if (s.points > 0)
    return "of the " + counts_text(*s.kept, s.points) + " of " + std::to_string(s.points) +
           " points, each alike, that are" + within + ": " + share_text(*s.kept);
  return "of the " + share_text(*s.kept) + " of the area that are" + within;
}

void add_statistics(const Statistics& s, const std::string& unit, std::vector<TableRow>& rows) {
  const bool are_points = s.points > 0;
  if (s.kept) {
    rows.push_back({"figures", kept_text(s, unit)});
    if (s.kept->upper == 0) return;
  } else if (are_points) {
    rows.push_back({"figures", "of " + std::to_string(s.points) + " points, each alike"});
  }
  rows.push_back({"mean", figure(s.mean, unit) + "; root mean square " + figure(s.rms, unit)});
  for (const AreaWithin& band : s.bands)
    rows.push_back(
        {are_points ? "share" : "area", figure(in_percent(band.share), "%") + " within " +
                                            length_in_words({band.distance, band.distance}) +
                                            (unit.empty() ? "" : " " + unit) + jump_text(band)});
  if (!s.percentiles.empty())
    rows.push_back({"percentile", percentiles_text(s.percentiles, unit, are_points)});
}

}  // namespace

std::vector<TableRow> survey_rows(const Answer& answer, const SurveyResult& survey) {
  std::vector<TableRow> rows;
  const std::string& unit = answer.unit;
  const bool are_points = is_of_points(survey, answer);
  if (survey.faces) rows.push_back({are_points ? "points" : "faces", field_text(survey, answer)});
  if (survey.statistics) add_statistics(*survey.statistics, unit, rows);
  if (survey.sides)
    add_sides(*survey.sides, unit, {is_of_b(survey, answer) ? "A" : "B", are_points}, rows);
  std::string work = std::to_string(survey.bounded) + " cells bounded in " +
                     decimal(survey.ms / 1000, 3, Rounding::kUp) + " s";
  if (!survey.is_met()) work += end_text(survey);
  rows.push_back({"survey", work});
  return rows;
}

namespace {

constexpr double kShownPercent = 0.01;

// Three digits, or those that the interval leaves.
std::string likely_text(const Enclosure& e, double least_gap) {
  if (!std::isfinite(e.upper)) return "not known";
  return likely(e, std::max(e.upper - e.lower, least_gap));
}

std::string in_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

std::string goal_text(const AnswerFigure& figure) {
  if (figure.is_met) return "";
  return figure.jump ? "; a jump of the distribution: no --effort narrows it"
                     : "; wider than asked: more --effort narrows it";
}

std::string metric_text(const AnswerFigure& metric, const std::string& unit) {
  const Enclosure& e = metric.value;
  if (!std::isfinite(e.upper)) return "not known";
  return figure(e, unit) + goal_text(metric);
}

// `of`: what the share is of, before any remark.
std::string share_metric_text(const AnswerFigure& share, const std::string& of) {
  const Enclosure percent = in_percent(share.value);
  const std::string likely = likely_text(percent, kShownPercent) + " %";
  if (percent.lower == percent.upper) return likely + of;
  return likely + ", in " + share_text(share.value) + of + goal_text(share);
}

std::string angle_text(double degrees) { return " and " + shortest_decimal(degrees) + " degrees"; }

std::string distance_text(const Answer& answer, double distance) {
  return in_unit(length_in_words({distance, distance}), answer.unit);
}

/// The figures that the first line has where none is asked for by name.
bool is_told_first(const AnswerFigure& figure) {
  constexpr std::array<std::string_view, 4> kFirst{"hausdorff", "hd_p", "assd", "chamfer_l1"};
  if (figure.kind == FigureKind::kMetricShare) return figure.name == "f1";
  return std::find(kFirst.begin(), kFirst.end(), figure.column) != kFirst.end();
}

/// The name by which a figure is asked for.
std::string_view asked_name(const AnswerFigure& figure) {
  return figure.kind == FigureKind::kMetricShare ? figure.name : figure.column;
}

}  // namespace

std::string metrics_in_words(const Answer& answer) {
  const Metrics& m = *answer.metrics;
  std::string text;
  for (const AnswerFigure& figure : figures_of(answer)) {
    if (figure.kind < FigureKind::kMetric) continue;
    if (m.figures.empty() ? !is_told_first(figure) : !m.asks_for(asked_name(figure))) continue;
    const Enclosure& e = figure.value;
    text += (text.empty() ? "" : ", ") + figure.name + " ";
    text += figure.kind == FigureKind::kMetric
                ? in_unit(likely_text(e, 1e-3 * e.lower), unit_of(answer.unit, figure.power))
                : likely_text(in_percent(e), kShownPercent) + " % within " +
                      distance_text(answer, figure.at);
  }
  return text + (m.is_met() ? "" : "; not all are as narrow as asked");
}

std::vector<TableRow> metrics_rows(const Answer& answer) {
  const Metrics& m = *answer.metrics;
  std::vector<TableRow> rows;
  for (const AnswerFigure& figure : figures_of(answer)) {
    if (figure.kind < FigureKind::kMetric || !m.asks_for(asked_name(figure))) continue;
    rows.push_back(
        {figure.name,
         figure.kind == FigureKind::kMetric
             ? metric_text(figure, unit_of(answer.unit, figure.power))
             : share_metric_text(figure, " within " + distance_text(answer, figure.at) +
                                             (figure.of_normals ? angle_text(*m.normals) : ""))});
  }
  return rows;
}

}  // namespace vkh
