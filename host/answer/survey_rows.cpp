// Surveys and metrics as rows of the table.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "host/answer/end_words.h"
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
  return with_unit(text + "]", unit);
}

// A figure's probable value, with the digits that matter at a width of `gap`, or as many as it
// takes to lie in the enclosure.
std::string likely(const Enclosure& e, double gap) {
  const double value = e.estimate.value_or(e.lower);
  return decimal_inside(value, e.lower, e.upper, digits_that_matter(value, gap));
}

// A figure: its probable value, and the interval in which it provably lies.
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

// Shares are known to 1e-12, but a hundredth of a percent is enough for people.
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

std::string end_text(const SurveyResult& survey) {
  return std::string(": ") + end_words(survey.ended).reason +
         " before all that was asked was met, and all is true as it is";
}

// The certain and the possible number of points: n times a share, rounded outward.
std::string counts_text(const Enclosure& share, uint64_t points) {
  const auto n = static_cast<double>(points);
  const double least = std::ceil(std::nextafter(n * share.lower, 0.0));
  const double most = std::floor(std::nextafter(n * share.upper, n + 1));
  std::string text = decimal(least, 12, Rounding::kDown);
  if (most > least) text += " to " + decimal(most, 12, Rounding::kUp);
  return text;
}

// Says which part of the mesh figures are of, and what they leave out.
std::string kept_text(const Statistics& s, const std::string& unit) {
  const std::string length = length_in_words({s.max_distance, s.max_distance});
  if (s.kept->upper == 0) return "none: nothing is within " + length;
  const std::string within = " within " + with_unit(length, unit);
  if (s.points > 0)
    return "of the " + counts_text(*s.kept, s.points) + " of " + std::to_string(s.points) +
           " points, each alike, that are" + within + ": " + share_text(*s.kept);
  return "of the " + share_text(*s.kept) + " of the area that are" + within;
}

std::string within_text(const AnswerFigure& band, const std::string& unit) {
  return figure(in_percent(band.value), "%") + " within " +
         with_unit(length_in_words({band.at, band.at}), unit);
}

/// Why no effort narrows it.
std::string jump_text(const AnswerFigure& figure, bool are_points) {
  if (!figure.jump) return "";
  if (figure.kind == FigureKind::kBand) return " (a jump: the rest lies at this distance)";
  return std::string(" (a jump: nearly no ") + (are_points ? "point" : "area") + " lies between)";
}

/// The rows of one direction's survey, in which figures of a kind follow each other.
class SurveyRows {
 public:
  SurveyRows(const Answer& answer, bool of_b)
      : unit_(answer.unit), are_points_(answer.inputs[of_b ? 1 : 0].are_points) {
    for (AnswerFigure& figure : figures_of(answer)) {
      if (figure.of_b == of_b) figures_.push_back(std::move(figure));
    }
  }
  bool are_points() const { return are_points_; }
  const std::string& unit() const { return unit_; }

  void add(std::string label, std::string text) {
    rows_.push_back({std::move(label), std::move(text)});
  }
  /// All figures of these kinds in one row.
  void add_joined(std::initializer_list<FigureKind> kinds, const char* label, const char* between) {
    std::string text;
    for (const AnswerFigure& one : figures_) {
      if (std::find(kinds.begin(), kinds.end(), one.kind) != kinds.end())
        text += (text.empty() ? "" : between) + said(one);
    }
    if (!text.empty()) add(label, text);
  }
  /// A row for each figure of this kind; `label` empty: its name.
  void add_each(FigureKind kind, const char* label) {
    for (const AnswerFigure& one : figures_) {
      if (one.kind == kind) add(*label == '\0' ? one.name : label, said(one));
    }
  }
  std::vector<TableRow> rows() && { return std::move(rows_); }

 private:
  std::string said(const AnswerFigure& one) const {
    const std::string jump = jump_text(one, are_points_);
    switch (one.kind) {
      case FigureKind::kOver:
        return "farthest over " + enclosure(one.value, unit_);
      case FigureKind::kUnder:
        return "under " + enclosure(one.value, unit_);
      case FigureKind::kSignedMean:
        return "mean " + figure(one.value, unit_);
      case FigureKind::kRms:
        return "root mean square " + figure(one.value, unit_);
      case FigureKind::kSignedPercentile:
      case FigureKind::kPercentile:
        return "p" + shortest_decimal(100 * one.at) + " " + figure(one.value, unit_) + jump;
      case FigureKind::kBand:
        return within_text(one, unit_) + jump;
      default:
        return (one.power == 0 ? figure(in_percent(one.value), "%") : figure(one.value, unit_)) +
               jump;
    }
  }

  std::string unit_;
  bool are_points_;
  std::vector<AnswerFigure> figures_;
  std::vector<TableRow> rows_;
};

/// First says which part of the mesh the figures are of.
void add_statistics(const Statistics& s, SurveyRows& rows) {
  if (s.kept) {
    rows.add("figures", kept_text(s, rows.unit()));
    if (s.kept->upper == 0) return;
  } else if (s.points > 0) {
    rows.add("figures", "of " + std::to_string(s.points) + " points, each alike");
  }
  rows.add_joined({FigureKind::kMean, FigureKind::kRms}, "mean", "; ");
  rows.add_each(FigureKind::kBand, s.points > 0 ? "share" : "area");
  rows.add_joined({FigureKind::kPercentile}, "percentile", "; ");
}

void add_sides(const SignedFigures& sides, const char* other, SurveyRows& rows) {
  rows.add_joined({FigureKind::kOver, FigureKind::kUnder}, "sides", ", ");
  if (sides.areas)
    rows.add(rows.are_points() ? "sides of" : "side area",
             area_of_sides(*sides.areas, rows.are_points()));
  rows.add_joined({FigureKind::kSignedMean}, "signed", "; ");
  rows.add_joined({FigureKind::kSignedPercentile}, "signed", "; ");
  rows.add(std::string("side of ") + other, inside_in_words(sides));
}

}  // namespace

std::vector<TableRow> survey_rows(const Answer& answer, const SurveyResult& survey) {
  const bool of_b = is_of_b(survey, answer);
  SurveyRows rows(answer, of_b);
  if (survey.faces) rows.add(rows.are_points() ? "points" : "faces", field_text(survey, answer));
  if (survey.statistics) add_statistics(*survey.statistics, rows);
  if (survey.sides) add_sides(*survey.sides, of_b ? "A" : "B", rows);
  rows.add_each(FigureKind::kOther, "");
  std::string work = std::to_string(survey.bounded) + " cells bounded in " +
                     decimal(survey.ms / 1000, 3, Rounding::kUp) + " s";
  if (!survey.is_met()) work += end_text(survey);
  rows.add("survey", work);
  return std::move(rows).rows();
}

namespace {

constexpr double kShownPercent = 0.01;

// Nothing is known of a share that may be anything from 0 to 1.
bool is_known(const AnswerFigure& figure) {
  const Enclosure& e = figure.value;
  return figure.power == 0 ? e.lower > 0 || e.upper < 1 : std::isfinite(e.upper);
}

// Three digits, or fewer if the interval leaves fewer.
std::string likely_text(const Enclosure& e, double least_gap) {
  return likely(e, std::max(e.upper - e.lower, least_gap));
}

std::string likely_text(const AnswerFigure& figure, const std::string& unit) {
  if (!is_known(figure)) return "not known";
  if (figure.kind == FigureKind::kMetricShare)
    return likely_text(in_percent(figure.value), kShownPercent) + " %";
  return with_unit(likely_text(figure.value, 1e-3 * figure.value.lower), unit);
}

std::string goal_text(const AnswerFigure& figure) {
  if (figure.is_met) return "";
  return figure.jump ? "; a jump of the distribution: no --effort narrows it"
                     : "; wider than asked: more --effort narrows it";
}

std::string metric_text(const AnswerFigure& metric, const std::string& unit) {
  if (!is_known(metric)) return "not known";
  return figure(metric.value, unit) + goal_text(metric);
}

// `of`: what the share is of, before any remark.
std::string share_metric_text(const AnswerFigure& share, const std::string& of) {
  const std::string likely = likely_text(share, "");
  if (!is_known(share)) return likely + of + (share.jump ? goal_text(share) : "");
  if (share.value.lower == share.value.upper) return likely + of;
  return likely + ", in " + share_text(share.value) + of + goal_text(share);
}

std::string angle_text(double degrees) { return " and " + shortest_decimal(degrees) + " degrees"; }

std::string distance_text(const Answer& answer, double distance) {
  return with_unit(length_in_words({distance, distance}), answer.unit);
}

/// Whether the first line has the figure if none is asked for by name.
bool is_default_figure(const AnswerFigure& figure) {
  constexpr std::array<std::string_view, 4> kFirst{"hausdorff", "hd_p", "assd", "chamfer_l1"};
  if (figure.kind == FigureKind::kMetricShare) return figure.name == "f1";
  return std::find(kFirst.begin(), kFirst.end(), figure.key) != kFirst.end();
}

/// The name by which a figure is asked for.
std::string_view asked_name(const AnswerFigure& figure) {
  return figure.kind == FigureKind::kMetricShare ? figure.name : figure.key;
}

}  // namespace

std::string metrics_in_words(const Answer& answer) {
  const Metrics& m = *answer.metrics;
  std::string text;
  for (const AnswerFigure& figure : figures_of(answer)) {
    if (figure.kind < FigureKind::kMetric) continue;
    if (m.figures.empty() ? !is_default_figure(figure) : !m.asks_for(asked_name(figure))) continue;
    text += (text.empty() ? "" : ", ") + figure.name + " " +
            likely_text(figure, unit_of(answer.unit, figure.power));
    if (figure.kind == FigureKind::kMetricShare)
      text += " within " + distance_text(answer, figure.at);
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
