#include "host/answer/tables.h"

#include <cmath>
#include <vector>

#include "host/base/decimal.h"

namespace vkh {
namespace {

// Quotes the cell if it has to.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

std::string row_of(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& text : cells) row += (&text == cells.data() ? "" : ",") + cell(text);
  return row + "\n";
}

std::string bound(double value, Rounding rounding) {
  return std::isfinite(value) ? decimal(value, kJsonDigits, rounding) : "";
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "; ") + line;
  return text;
}

std::string milliseconds(double ms) { return number_text(ms, std::chars_format::fixed, 3); }

// The names of the columns of signed figures, but for the last: each has a lower and an upper end.
std::vector<std::string> names_of_sides() {
  std::vector<std::string> names{"over", "under", "signed_mean"};
  for (const double share : kSignedShares)
    names.push_back("signed_p" + shortest_decimal(100 * share));
  return names;
}

void add_sides(const Record& r, std::vector<std::string>& cells) {
  std::vector<std::optional<Enclosure>> figures;
  if (r.sides) figures = {r.sides->over, r.sides->under, r.sides->mean};
  if (r.sides) {
    for (const Percentile& p : r.sides->percentiles) figures.emplace_back(p.distance);
  }
  figures.resize(names_of_sides().size());
  for (const std::optional<Enclosure>& figure : figures) {
    cells.push_back(figure ? bound(figure->lower, Rounding::kDown) : "");
    cells.push_back(figure ? bound(figure->upper, Rounding::kUp) : "");
  }
  const bool has_share = r.sides && r.sides->unsigned_share;
  cells.push_back(has_share ? bound(*r.sides->unsigned_share, Rounding::kUp) : "");
}

// Each figure has three columns: what it probably is, and its ends.
void add_names(const std::string& name, std::vector<std::string>& cells) {
  for (const char* end : {"", "_lower", "_upper"}) cells.push_back(name + end);
}

void add_names_of_metrics(const CsvColumns& with, std::vector<std::string>& cells) {
  cells.emplace_back("percentile");
  for (const NamedMetric& metric : kNamedMetrics) {
    if (with.normals || !metric.of_normals) add_names(metric.name, cells);
  }
  for (size_t i = 1; i <= with.distances; ++i) {
    cells.push_back("within_" + std::to_string(i));
    for (const NamedShare& share : kNamedShares) {
      if (with.normals || !share.of_normals)
        add_names(share.name + ("_" + std::to_string(i)), cells);
    }
  }
}

void add_figure(const Metric& metric, std::vector<std::string>& cells) {
  const Enclosure& e = metric.value;
  cells.push_back(e.estimate ? decimal_between(*e.estimate, e.lower, e.upper) : "");
  cells.push_back(bound(e.lower, Rounding::kDown));
  cells.push_back(bound(e.upper, Rounding::kUp));
}

// A record without figures of normals has none of them in its columns.
void add_metrics_cells(const Metrics& m, bool has_normals, std::vector<std::string>& cells) {
  const auto add = [&](const Metric& metric, bool of_normals) {
    if (of_normals && !has_normals) return;
    if (of_normals && !m.normals) return cells.resize(cells.size() + 3);
    add_figure(metric, cells);
  };
  cells.push_back(shortest_decimal(m.percentile));
  for (const NamedMetric& metric : kNamedMetrics) add(m.*metric.figure, metric.of_normals);
  for (const MetricsWithin& at : m.within) {
    cells.push_back(shortest_decimal(at.distance));
    for (const NamedShare& share : kNamedShares) add(at.*share.figure, share.of_normals);
  }
}

}  // namespace

std::string csv_heading(const CsvColumns& with) {
  std::vector<std::string> cells{"id",   "code", "status", "verdict", "lower",   "upper", "gap",
                                 "unit", "a",    "b",      "faces_a", "faces_b", "words", "notes"};
  if (with.run) cells.insert(cells.end(), {"gpu_ms", "total_ms", "host", "started"});
  for (const std::string& name : with.sides ? names_of_sides() : std::vector<std::string>())
    cells.insert(cells.end(), {name + "_lower", name + "_upper"});
  if (with.sides) cells.emplace_back("unsigned_share");
  if (with.metrics) add_names_of_metrics(with, cells);
  return row_of(cells);
}

std::string csv_row(const Record& r, const CsvColumns& with) {
  const bool has_answer = !r.status.empty();
  const auto known = [&](const std::string& text) { return has_answer ? text : std::string(); };
  const auto sought = [&](const std::string& text) {
    return r.is_upper_sought() ? known(text) : std::string();
  };
  std::vector<std::string> cells{
      r.name.id,
      std::to_string(static_cast<int>(r.code)),
      r.status,
      r.verdict,
      known(bound(r.lower, Rounding::kDown)),
      sought(bound(r.upper, Rounding::kUp)),
      sought(shortest_decimal(r.gap)),
      r.unit,
      r.inputs[0].path,
      r.inputs[1].path,
      known(std::to_string(r.inputs[0].faces)),
      known(std::to_string(r.inputs[1].faces)),
      r.words,
      joined(server_notes(r.notes, r.inputs[0].notes, r.inputs[1].notes))};
  if (with.run)
    cells.insert(cells.end(),
                 {milliseconds(r.gpu_ms), milliseconds(r.total_ms), r.host, r.started});
  if (with.sides) add_sides(r, cells);
  const size_t before = cells.size();
  if (with.metrics && r.metrics) add_metrics_cells(*r.metrics, with.normals, cells);
  if (with.metrics) {
    std::vector<std::string> names;
    add_names_of_metrics(with, names);
    cells.resize(before + names.size());
  }
  return row_of(cells);
}

JunitCase junit_case(const Record& r, bool with_run) {
  JunitCase one{.command = "batch",
                .name = r.name.id,
                .words = r.words,
                .seconds = with_run ? r.total_ms / 1000 : 0};
  one.notes = server_notes(r.notes, r.inputs[0].notes, r.inputs[1].notes);
  if (r.code == kExitBeyond) {
    one.element = "failure";
    one.type = "beyond the limit";
  } else if (r.code != kExitClosed) {
    one.element = "error";
    one.type = r.status.empty() ? "no answer" : "undecided";
  }
  return one;
}

}  // namespace vkh
