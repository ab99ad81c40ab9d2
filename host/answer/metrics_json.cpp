// Metrics as JSON, both ways.
#include <array>

#include "host/answer/json_object.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

std::string metric_json(const Metric& metric, const Json& unit) {
  JsonObject json;
  json.add_enclosure(metric.value);
  json.add("unit", unit);
  json.add("met", metric.is_met);
  if (metric.jump) json.add("jump", true);
  return json.text();
}

std::string metrics_within_json(const MetricsWithin& at, const Json& unit, bool has_normals) {
  JsonObject json;
  json.add("distance", at.distance);
  json.add("unit", unit);
  for (const NamedShare& share : kNamedShares) {
    if (has_normals || !share.of_normals)
      json.add_text(share.name, metric_json(at.*share.figure, nullptr));
  }
  return json.text();
}

const Json& metric_member(const Json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (found == object.end()) throw InputError(std::string("metrics: no ") + key);
  return *found;
}

double metric_number(const Json& object, const char* key) {
  const Json& value = metric_member(object, key);
  if (!value.is_number()) throw InputError(std::string("metrics: ") + key + " is no number");
  return value.get<double>();
}

bool metric_truth(const Json& object, const char* key) {
  const Json& value = metric_member(object, key);
  if (!value.is_boolean()) throw InputError(std::string("metrics: ") + key + " is no truth value");
  return value.get<bool>();
}

Metric metric_from(const Json& json) {
  Metric metric{{bound_in(json, "lower"), bound_in(json, "upper")}, metric_truth(json, "met")};
  if (json.contains("estimate")) metric.value.estimate = metric_number(json, "estimate");
  const Enclosure& e = metric.value;
  if (!(e.lower <= e.upper)) throw InputError("metrics: an interval of which lower is above upper");
  if (e.estimate && !(*e.estimate >= e.lower && *e.estimate <= e.upper))
    throw InputError("metrics: an estimate that is not in its interval");
  metric.jump = json.contains("jump") && metric_truth(json, "jump");
  return metric;
}

MetricsWithin metrics_within_from(const Json& json, bool has_normals) {
  MetricsWithin at;
  at.distance = metric_number(json, "distance");
  for (const NamedShare& share : kNamedShares) {
    if (has_normals || !share.of_normals)
      at.*share.figure = metric_from(metric_member(json, share.name));
  }
  return at;
}

std::vector<std::string> figures_from(const Json& json) {
  std::vector<std::string> figures;
  if (!json.contains("figures")) return figures;
  if (!json["figures"].is_array()) throw InputError("metrics: figures is no array");
  for (const Json& figure : json["figures"]) {
    if (!figure.is_string()) throw InputError("metrics: a figure's name is no text");
    figures.push_back(figure.get<std::string>());
  }
  return figures;
}

}  // namespace

void add_metrics(JsonObject& json, const Answer& answer) {
  const Metrics& m = *answer.metrics;
  const Json unit = text_or_null(answer.unit);
  const Json area = answer.unit.empty() ? Json() : Json(answer.unit + "^2");
  JsonObject metrics;
  metrics.add("percentile", m.percentile);
  metrics.add("met", m.is_met());
  if (!m.figures.empty()) metrics.add("figures", Json(m.figures));
  if (m.normals) metrics.add("normals", *m.normals);
  const std::array<Json, 3> units{Json(), unit, area};
  for (const NamedMetric& metric : kNamedMetrics) {
    if (m.normals || !metric.of_normals)
      metrics.add_text(metric.name,
                       metric_json(m.*metric.figure, units[static_cast<size_t>(metric.dimension)]));
  }
  std::string within;
  for (const MetricsWithin& at : m.within)
    within += (within.empty() ? "" : ",") + metrics_within_json(at, unit, m.normals.has_value());
  metrics.add_text("within", "[" + within + "]");
  json.add_text("metrics", metrics.text());
}

Metrics metrics_from(const Json& json) {
  Metrics m;
  m.percentile = metric_number(json, "percentile");
  m.figures = figures_from(json);
  if (json.contains("normals")) m.normals = metric_number(json, "normals");
  for (const NamedMetric& metric : kNamedMetrics) {
    if (m.normals || !metric.of_normals)
      m.*metric.figure = metric_from(metric_member(json, metric.name));
  }
  const Json& within = metric_member(json, "within");
  if (!within.is_array()) throw InputError("metrics: within is no array");
  for (const Json& at : within) m.within.push_back(metrics_within_from(at, m.normals.has_value()));
  if (metric_truth(json, "met") != m.is_met())
    throw InputError("metrics: met contradicts the figures");
  return m;
}

}  // namespace vkh
