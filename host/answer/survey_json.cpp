// A survey as JSON.
#include "host/answer/json_object.h"

namespace vkh {
namespace {

std::string enclosure_json(const Enclosure& e, const Json& unit) {
  JsonObject json;
  json.add_enclosure(e);
  json.add("unit", unit);
  return json.text();
}

template <class Items, class Text>
std::string array_json(const Items& items, const Text& text) {
  std::string rows;
  for (const auto& item : items) rows += (rows.empty() ? "" : ",") + text(item);
  return "[" + rows + "]";
}

std::string within_json(const AreaWithin& within, const Json& unit) {
  JsonObject json;
  json.add("distance", within.distance);
  json.add("unit", unit);
  json.add_text("share", enclosure_json(within.share, nullptr));
  if (within.jump) json.add("jump", true);
  return json.text();
}

std::string percentile_json(const Percentile& percentile, const Json& unit) {
  JsonObject json;
  json.add("share", percentile.share);
  json.add_text("distance", enclosure_json(percentile.distance, unit));
  if (percentile.jump) json.add("jump", true);
  return json.text();
}

std::string statistics_json(const Statistics& s, const Json& unit) {
  JsonObject json;
  json.add("area", s.area);
  if (s.points > 0) json.add("points", s.points);
  if (s.kept) {
    json.add("max_distance", s.max_distance);
    json.add_text("kept", enclosure_json(*s.kept, nullptr));
  }
  json.add_text("mean", enclosure_json(s.mean, unit));
  json.add_text("rms", enclosure_json(s.rms, unit));
  const auto within = [&](const AreaWithin& one) { return within_json(one, unit); };
  json.add_text("bands", array_json(s.bands, within));
  json.add_text("percentiles", array_json(s.percentiles, [&](const Percentile& one) {
                  return percentile_json(one, unit);
                }));
  json.add_text("curve", array_json(s.curve, within));
  return json.text();
}

std::string areas_json(const SignedFigures::Areas& areas) {
  JsonObject json;
  json.add_text("over", enclosure_json(areas.over, nullptr));
  json.add_text("under", enclosure_json(areas.under, nullptr));
  JsonObject doubts;
  for (size_t k = 1; k < kDoubts; ++k)
    doubts.add_text(doubt_name(static_cast<Doubt>(k)), enclosure_json(areas.doubts[k], nullptr));
  json.add_text("unsigned", doubts.text());
  return json.text();
}

std::string witness_json(const std::optional<SidedPoint>& witness, const Json& unit) {
  if (!witness) return "null";
  const auto vector = [](const DVec3& v) { return Json::array({v.x, v.y, v.z}); };
  JsonObject json;
  json.add("face", witness->at.file_face);
  json.add("barycentric", vector(witness->at.barycentric));
  json.add("point", vector(witness->at.point));
  json.add_bound("lower", witness->lower, Rounding::kDown);
  json.add("unit", unit);
  return json.text();
}

std::string signed_json(const SignedFigures& s, const Json& unit, Detail detail) {
  JsonObject json;
  json.add_text("over", enclosure_json(s.over, unit));
  json.add_text("under", enclosure_json(s.under, unit));
  json.add_text("over_witness", witness_json(s.over_witness, unit));
  json.add_text("under_witness", witness_json(s.under_witness, unit));
  json.add("inside", inside_name(s.inside));
  if (s.inside_out != InsideOut::kNone) json.add("inside_out", inside_out_name(s.inside_out));
  json.add("edges", {{"open", s.edges.open}, {"uneven", s.edges.uneven}});
  json.add_text("areas", s.areas ? areas_json(*s.areas) : "null");
  json.add_text("mean", s.mean ? enclosure_json(*s.mean, unit) : "null");
  json.add_text("percentiles", array_json(s.percentiles, [&](const Percentile& one) {
                  return percentile_json(one, unit);
                }));
  if (detail == Detail::kFull) json.add("wall_ms", s.ms);
  return json.text();
}

Json faces_json(const SurveyResult& survey, const Answer& answer) {
  const FieldSummary summary = survey.summary ? *survey.summary : summary_of(answer, survey);
  Json json = {{"faces", summary.faces}, {"width", summary.width}};
  if (!answer.max) return json;
  json["within"] = summary.within;
  json["beyond"] = summary.beyond;
  json["undecided"] = summary.undecided;
  return json;
}

Json map_json(const MapShares& shares, const Json& unit) {
  Json json = {{"low", shares.bar.low},
               {"high", shares.bar.high},
               {"unit", unit},
               {"signed", shares.has_sides}};
  if (shares.bar.limit) json["limit"] = *shares.bar.limit;
  if (shares.bar.limit_under) json["limit_under"] = *shares.bar.limit_under;
  json["above"] = shares.above;
  json["below"] = shares.below;
  json["no_side"] = shares.no_side;
  json["left_out"] = shares.left_out;
  json["unresolved"] = shares.unresolved;
  json["within"] = shares.within;
  json["mean"] = shares.mean;
  return json;
}

}  // namespace

void add_survey(JsonObject& json, const SurveyResult& survey, const Answer& answer, Detail detail) {
  Json found = {{"met", survey.is_met()},
                {"effort", survey.effort},
                {"ended", survey_end_name(survey.ended)},
                {"cells", survey.cells},
                {"bounded", survey.bounded}};
  if (detail == Detail::kFull) found["wall_ms"] = survey.ms;
  json.add("survey", found);
  if (survey.faces) json.add("field", faces_json(survey, answer));
  if (survey.statistics)
    json.add_text("statistics", statistics_json(*survey.statistics, text_or_null(answer.unit)));
  if (survey.sides)
    json.add_text("signed", signed_json(*survey.sides, text_or_null(answer.unit), detail));
  if (survey.shares) json.add("map", map_json(*survey.shares, text_or_null(answer.unit)));
}

}  // namespace vkh
