#include "host/answer/figures.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "host/base/decimal.h"

namespace vkh {
namespace {

std::string percentile_name(double share) { return "p" + shortest_decimal(100 * share); }

void add_sides(const SignedFigures& s, bool of_b, std::vector<AnswerFigure>& all) {
  all.push_back({FigureKind::kOver, "outward", "over", of_b, s.over});
  all.push_back({FigureKind::kUnder, "inward", "under", of_b, s.under});
  if (s.mean) all.push_back({FigureKind::kSignedMean, "signed mean", "signed_mean", of_b, *s.mean});
  for (const Percentile& p : s.percentiles)
    all.push_back({.kind = FigureKind::kSignedPercentile,
                   .name = "signed " + percentile_name(p.share),
                   .column = "signed_" + percentile_name(p.share),
                   .of_b = of_b,
                   .value = p.distance,
                   .at = p.share,
                   .jump = p.jump});
}

void add_statistics(const Statistics& s, bool of_b, std::vector<AnswerFigure>& all) {
  if (s.kept)
    all.push_back({.kind = FigureKind::kKept,
                   .name = "kept",
                   .column = {},
                   .of_b = of_b,
                   .value = *s.kept,
                   .power = 0,
                   .at = s.max_distance});
  all.push_back({FigureKind::kMean, "mean", "", of_b, s.mean});
  all.push_back({FigureKind::kRms, "rms", "", of_b, s.rms});
  for (const Percentile& p : s.percentiles)
    all.push_back({.kind = FigureKind::kPercentile,
                   .name = percentile_name(p.share),
                   .column = {},
                   .of_b = of_b,
                   .value = p.distance,
                   .at = p.share,
                   .jump = p.jump});
  for (const AreaWithin& band : s.bands)
    all.push_back({.kind = FigureKind::kBand,
                   .name = "within",
                   .column = {},
                   .of_b = of_b,
                   .value = band.share,
                   .power = 0,
                   .at = band.distance,
                   .jump = band.jump});
}

void add_direction(const Answer& answer, bool of_b, std::vector<AnswerFigure>& all) {
  const Report& r = of_b ? *answer.b_to_a : answer.a_to_b;
  all.push_back({FigureKind::kLargest, "largest", "", of_b, deviation_of(answer, r)});
  const std::optional<SurveyResult>& survey = of_b ? answer.survey_b : answer.survey_a;
  if (survey && survey->sides) add_sides(*survey->sides, of_b, all);
  if (survey && survey->statistics) add_statistics(*survey->statistics, of_b, all);
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
         .column = metric.name,
         .power = metric.dimension});
  for (size_t i = 0; i < m.within.size(); ++i) {
    for (const NamedShare& share : kNamedShares)
      add(FigureKind::kMetricShare, share, m.within[i].*share.figure,
          {.kind = {},
           .name = share.name,
           .column = share.name + ("_" + std::to_string(i + 1)),
           .power = 0,
           .at = m.within[i].distance});
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
