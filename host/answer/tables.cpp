#include "host/answer/tables.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "host/answer/csv.h"
#include "host/answer/figures.h"
#include "host/answer/rank.h"
#include "host/base/decimal.h"
#include "host/base/rounding.h"

namespace vkh {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "; ") + line;
  return text;
}

std::string milliseconds(double ms) { return number_text(ms, std::chars_format::fixed, 3); }

// An upper bound of the share of A's area that has no side.
double unsigned_share(const SignedFigures::Areas& areas) {
  return std::max(add_up(add_up(1, -areas.over.lower), -areas.under.lower), 0.0);
}

using Cells = std::vector<std::string>;

/// The figures of a result that have columns, by their names: sides of A, and metrics.
std::map<std::string, AnswerFigure> columns_of(const Answer& answer) {
  std::map<std::string, AnswerFigure> columns;
  for (AnswerFigure& figure : figures_of(answer)) {
    if (figure.in_batch && !figure.of_b) columns.emplace(figure.key, std::move(figure));
  }
  return columns;
}

void add_ends(const Enclosure& e, Cells& cells) {
  cells.push_back(csv_bound(e.lower, Rounding::kDown));
  cells.push_back(csv_bound(e.upper, Rounding::kUp));
}

void add_sides(const Answer& answer, Cells& cells) {
  const auto figures = columns_of(answer);
  for (const std::string& name : survey_columns()) {
    const auto found = figures.find(name);
    if (found == figures.end())
      cells.resize(cells.size() + 2);
    else
      add_ends(found->second.value, cells);
  }
  const SignedFigures* sides = sides_of(answer, false);
  const bool has_areas = sides != nullptr && sides->areas;
  cells.push_back(has_areas ? csv_bound(unsigned_share(*sides->areas), Rounding::kUp) : "");
}

// Each figure has three columns: its probable value, and both ends.
void add_names(const std::string& name, std::vector<std::string>& cells) {
  for (const char* end : {"", "_lower", "_upper"}) cells.push_back(name + end);
}

/// Calls `condition` with each column that says to which percentile or distance the figures after
/// it belong (distances are numbered from 1), and `figure` with each figure's name.
template <class Condition, class Figure>
void for_each_metric(const CsvColumns& with, const Condition& condition, const Figure& figure) {
  condition("percentile", 0);
  for (const NamedMetric& metric : kNamedMetrics) {
    if (with.normals || !metric.of_normals) figure(metric.name);
  }
  for (size_t i = 1; i <= with.distances; ++i) {
    const std::string end = "_" + std::to_string(i);
    condition("within" + end, i);
    for (const NamedShare& share : kNamedShares) {
      if (with.normals || !share.of_normals) figure(share.name + end);
    }
  }
}

void add_names_of_metrics(const CsvColumns& with, Cells& cells) {
  for_each_metric(
      with, [&](const std::string& name, size_t) { cells.push_back(name); },
      [&](const std::string& name) { add_names(name, cells); });
}

std::string condition_text(const Metrics& m, size_t number) {
  if (number == 0) return shortest_decimal(m.percentile);
  return number <= m.within.size() ? shortest_decimal(m.within[number - 1].distance) : "";
}

/// An answer without figures of normals, or with fewer distances, has empty cells in those columns.
void add_metrics_cells(const Answer& answer, const CsvColumns& with, Cells& cells) {
  const auto figures = columns_of(answer);
  for_each_metric(
      with,
      [&](const std::string&, size_t number) {
        cells.push_back(answer.metrics ? condition_text(*answer.metrics, number) : "");
      },
      [&](const std::string& name) {
        const auto found = figures.find(name);
        if (found == figures.end()) return cells.resize(cells.size() + 3);
        const Enclosure& e = found->second.value;
        cells.push_back(e.estimate ? decimal_between(*e.estimate, e.lower, e.upper) : "");
        add_ends(e, cells);
      });
}

}  // namespace

std::string csv_heading(const CsvColumns& with) {
  std::vector<std::string> cells{"id",   "code", "status", "verdict", "lower",   "upper", "gap",
                                 "unit", "a",    "b",      "faces_a", "faces_b", "words", "notes"};
  if (with.run) cells.insert(cells.end(), {"gpu_ms", "total_ms", "host", "started"});
  if (with.sides) {
    for (const std::string& name : survey_columns())
      cells.insert(cells.end(), {name + "_lower", name + "_upper"});
    cells.emplace_back("unsigned_share");
  }
  if (with.metrics) add_names_of_metrics(with, cells);
  return csv_line(cells);
}

std::string csv_row(const Result& r, const CsvColumns& with) {
  const Answer& answer = r.answer;
  const CertifiedInterval whole = interval_of(answer);
  const auto known = [&](const std::string& text) { return r.has_answer() ? text : ""; };
  const auto sought = [&](const std::string& text) {
    return r.is_upper_sought() ? known(text) : "";
  };
  std::vector<std::string> cells{r.name.id,
                                 std::to_string(static_cast<int>(r.code)),
                                 known(status_name(whole.status)),
                                 answer.max ? verdict_name(verdict_of(answer)) : "",
                                 known(csv_bound(whole.lower, Rounding::kDown)),
                                 sought(csv_bound(whole.upper, Rounding::kUp)),
                                 sought(shortest_decimal(std::isfinite(whole.gap) ? whole.gap : 0)),
                                 answer.unit,
                                 answer.inputs[0].path,
                                 answer.inputs[1].path,
                                 known(std::to_string(answer.inputs[0].counts.faces)),
                                 known(std::to_string(answer.inputs[1].counts.faces)),
                                 r.words(),
                                 joined(server_notes(answer))};
  if (with.run)
    cells.insert(cells.end(), {milliseconds(r.gpu_ms), milliseconds(answer.waits.total),
                               answer.host, answer.started});
  if (with.sides) add_sides(answer, cells);
  if (with.metrics) add_metrics_cells(answer, with, cells);
  return csv_line(cells);
}

JunitCase junit_case(const Result& r, bool with_run) {
  return {.command = "batch",
          .name = r.name.id,
          .words = r.words(),
          .outcome = outcome_of(r),
          .seconds = with_run ? r.answer.waits.total / 1000 : 0,
          .notes = server_notes(r.answer)};
}

}  // namespace vkh
