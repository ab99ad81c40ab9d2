// The figures of an answer, each of them once: pages, tables, CSV and Python iterate them. So a new
// figure is one row of figures.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vkhausdorff/answer.h"

namespace vkh {

/// The quantity of a figure, if its wording depends on that. Figures come in this order, A's
/// direction first.
enum class FigureKind {
  kLargest,  ///< the distance itself
  kOver,     ///< the largest distance on one side of the other mesh
  kUnder,
  kSignedMean,
  kKept,  ///< the share that other figures are of, with Statistics::max_distance
  kMean,
  kRms,
  kOther,  ///< any whose name and value say all
  kSignedPercentile,
  kPercentile,
  kBand,    ///< the share within a distance
  kMetric,  ///< of both directions, as all that follow
  kMetricShare,
};

struct AnswerFigure {
  FigureKind kind;
  std::string name;  ///< "largest", "p95", "within", "hd95": with its own number, if it has one
  std::string key;   ///< the same for programs: "over", "within_0.5", "hd_p", "f1_1"
  std::string title = {};   ///< of its row of a page; empty: the page says it otherwise, or not
  bool of_b = false;        ///< of B's direction
  Enclosure value = {};     ///< an upper end that was not sought is infinite
  int power = 1;            ///< of the answer's unit; 0: a share
  double at = 0;            ///< the share of a percentile; the distance that a share is within
  bool jump = false;        ///< no effort narrows it
  bool is_met = true;       ///< as narrow as was asked
  bool of_normals = false;  ///< of area whose normals agree, too
  bool in_batch = false;    ///< it has columns in a batch's CSV
  bool in_report = false;   ///< it has a row in figures.csv
};

std::vector<AnswerFigure> figures_of(const Answer& answer);

/// The keys of the figures of a survey that have columns in a batch's CSV.
std::vector<std::string> survey_columns();

/// The unit's power as text: "mm^2"; empty where there is none.
std::string unit_of(const std::string& unit, int power);

/// The interval of a direction and of the whole answer. The upper end is infinite if it was not
/// sought because a limit was failed.
Enclosure deviation_of(const Answer& answer, const Report& report);
Enclosure deviation_of(const Answer& answer);

}  // namespace vkh
