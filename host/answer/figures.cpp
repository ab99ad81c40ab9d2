#include "host/answer/figures.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "host/base/decimal.h"

namespace vkh {
namespace {

/// A figure of a survey that is one number.
struct SurveyFigure {
  FigureKind kind;
  const char *name, *key, *title;
  int power;
  bool in_batch, in_report;
  std::optional<Enclosure> (*value)(const SurveyResult&);
};

template <Enclosure SignedFigures::*figure>
std::optional<Enclosure> of_sides(const SurveyResult& survey) {
  return survey.sides ? std::optional((*survey.sides).*figure) : std::nullopt;
}

template <Enclosure Statistics::*figure>
std::optional<Enclosure> of_statistics(const SurveyResult& survey) {
  return survey.statistics ? std::optional((*survey.statistics).*figure) : std::nullopt;
}

std::optional<Enclosure> signed_mean(const SurveyResult& survey) {
  return survey.sides ? survey.sides->mean : std::nullopt;
}

std::optional<Enclosure> kept(const SurveyResult& survey) {
  return survey.statistics ? survey.statistics->kept : std::nullopt;
}

constexpr SurveyFigure kSurveyFigures[] = {
    {FigureKind::kOver, "outward", "over", "farthest outward", 1, true, true,
     of_sides<&SignedFigures::over>},
    {FigureKind::kUnder, "inward", "under", "farthest inward", 1, true, true,
     of_sides<&SignedFigures::under>},
    {FigureKind::kSignedMean, "signed mean", "signed_mean", "", 1, true, true, signed_mean},
    {FigureKind::kKept, "kept", "kept", "", 0, false, false, kept},
    {FigureKind::kMean, "mean", "mean", "mean deviation", 1, false, true,
     of_statistics<&Statistics::mean>},
    {FigureKind::kRms, "rms", "rms", "root mean square", 1, false, true,
     of_statistics<&Statistics::rms>}};

std::string percentile_name(double share) { return "p" + shortest_decimal(100 * share); }

/// A direction's survey, whose figures are added.
struct SurveyOf {
  const SurveyResult& survey;
  bool of_b, are_points;
};

void add_numbers(const SurveyOf& of, std::vector<AnswerFigure>& all) {
  for (const SurveyFigure& one : kSurveyFigures) {
    const std::optional<Enclosure> value = one.value(of.survey);
    if (!value) continue;
    all.push_back({.kind = one.kind,
                   .name = one.name,
                   .key = one.key,
                   .title = one.title,
                   .of_b = of.of_b,
                   .value = *value,
                   .power = one.power,
                   .at = one.kind == FigureKind::kKept ? of.survey.statistics->max_distance : 0,
                   .in_batch = one.in_batch,
                   .in_report = one.in_report});
  }
}

void add_signed_percentiles(const SurveyOf& of, std::vector<AnswerFigure>& all) {
  if (!of.survey.sides) return;
  for (const Percentile& p : of.survey.sides->percentiles)
    all.push_back({.kind = FigureKind::kSignedPercentile,
                   .name = "signed " + percentile_name(p.share),
                   .key = "signed_" + percentile_name(p.share),
                   .of_b = of.of_b,
                   .value = p.distance,
                   .at = p.share,
                   .jump = p.jump,
                   .in_batch = true});
}

void add_distribution(const SurveyOf& of, std::vector<AnswerFigure>& all) {
  if (!of.survey.statistics) return;
  const std::string what = of.are_points ? "points" : "area";
  for (const Percentile& p : of.survey.statistics->percentiles)
    all.push_back({.kind = FigureKind::kPercentile,
                   .name = percentile_name(p.share),
                   .key = percentile_name(p.share),
                   .title = shortest_decimal(100 * p.share) + " % of the " + what +
                            (of.are_points ? " are" : " is") + " within",
                   .of_b = of.of_b,
                   .value = p.distance,
                   .at = p.share,
                   .jump = p.jump,
                   .in_report = true});
  for (const AreaWithin& band : of.survey.statistics->bands)
    all.push_back({.kind = FigureKind::kBand,
                   .name = "within",
                   .key = "within_" + shortest_decimal(band.distance),
                   .title = what + " within",
                   .of_b = of.of_b,
                   .value = band.share,
                   .power = 0,
                   .at = band.distance,
                   .jump = band.jump,
                   .in_report = true});
}

void add_direction(const Answer& answer, bool of_b, std::vector<AnswerFigure>& all) {
  const Report& r = of_b ? *answer.b_to_a : answer.a_to_b;
  all.push_back({.kind = FigureKind::kLargest,
                 .name = "largest",
                 .key = "largest",
                 .title = "largest deviation",
                 .of_b = of_b,
                 .value = deviation_of(answer, r),
                 .in_report = true});
  const std::optional<SurveyResult>& survey = of_b ? answer.survey_b : answer.survey_a;
  if (!survey) return;
  const SurveyOf of{*survey, of_b, answer.inputs[of_b ? 1 : 0].are_points};
  add_numbers(of, all);
  add_signed_percentiles(of, all);
  add_distribution(of, all);
}

void add_metrics(const Metrics& m, std::vector<AnswerFigure>& all) {
  const auto add = [&](FigureKind kind, const auto& named, const Metric& metric,
                       AnswerFigure&& figure) {
    if (named.of_normals && !m.normals) return;
    figure.kind = kind;
    figure.value = metric.value;
    figure.jump = metric.jump;
    figure.is_met = metric.is_met;
    figure.of_normals = named.of_normals;
    all.push_back(std::move(figure));
  };
  for (const NamedMetric& metric : kNamedMetrics)
    add(FigureKind::kMetric, metric, m.*metric.figure,
        {.kind = {},
         .name = name_of(metric, m.percentile),
         .key = metric.name,
         .power = metric.dimension,
         .in_batch = true});
  for (size_t i = 0; i < m.within.size(); ++i) {
    for (const NamedShare& share : kNamedShares)
      add(FigureKind::kMetricShare, share, m.within[i].*share.figure,
          {.kind = {},
           .name = share.name,
           .key = share.name + ("_" + std::to_string(i + 1)),
           .power = 0,
           .at = m.within[i].distance,
           .in_batch = true});
  }
}

}  // namespace

std::vector<AnswerFigure> figures_of(const Answer& answer) {
  std::vector<AnswerFigure> all;
  add_direction(answer, false, all);
  if (answer.b_to_a) add_direction(answer, true, all);
  if (answer.metrics) add_metrics(*answer.metrics, all);
  return all;
}

std::vector<std::string> survey_columns() {
  std::vector<std::string> keys;
  for (const SurveyFigure& one : kSurveyFigures) {
    if (one.in_batch) keys.emplace_back(one.key);
  }
  for (const double share : kSignedShares) keys.push_back("signed_" + percentile_name(share));
  return keys;
}

std::string unit_of(const std::string& unit, int power) {
  if (power == 0 || unit.empty()) return "";
  return power == 1 ? unit : unit + "^" + std::to_string(power);
}

Enclosure deviation_of(const Answer& answer, const Report& report) {
  const bool is_failed = answer.max && !answer.max->area && report.lower > answer.max->limit.beyond;
  const bool is_sought = !is_failed || is_farthest_known(report.lower, report.upper);
  return {report.lower, is_sought ? report.upper : std::numeric_limits<double>::infinity()};
}

Enclosure deviation_of(const Answer& answer) {
  const Enclosure there = deviation_of(answer, answer.a_to_b);
  if (!answer.b_to_a) return there;
  const Enclosure back = deviation_of(answer, *answer.b_to_a);
  return {std::max(there.lower, back.lower), std::max(there.upper, back.upper)};
}

}  // namespace vkh
