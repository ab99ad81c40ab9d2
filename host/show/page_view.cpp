// Verdict, places and figures of a page.
#include "host/show/page_view.h"

#include <algorithm>

#include "host/base/decimal.h"
#include "host/show/page_words.h"

namespace vkh {
namespace {

using Json = nlohmann::ordered_json;

// Signs are drawn, for fonts differ in their characters.
constexpr const char* kTick = "M5 13l5 5 9-11";
constexpr const char* kCross = "M6 6l12 12M18 6L6 18";
constexpr const char* kOpen = "M9 9a3 3 0 1 1 4.2 2.7c-.8.4-1.2 1-1.2 2.3M12 17.6v.4";
constexpr const char* kRuler = "M3 12h18M3 8v8M21 8v8";

const char* sign_of(const std::string& style) {
  if (style == "pass") return kTick;
  if (style == "fail") return kCross;
  return style == "undecided" ? kOpen : kRuler;
}

Json named(const std::string& name, const std::string& text) {
  return {{"name", name}, {"text", text}};
}

double asked_share(const Answer& answer, const AreaWithin& band) {
  return is_limit(answer, band) && answer.max->area ? *answer.max->area : -1;
}

Json band_row(const Answer& answer, const AreaWithin& band) {
  Json row = named("area within " + band_text(answer, band),
                   share_text(band.share, asked_share(answer, band)));
  row["is_limit"] = is_limit(answer, band);
  return row;
}

std::string percentile_name(const Percentile& p) {
  return shortest_decimal(100 * p.share) + " % of the area is within";
}

void add_side_rows(const Answer& answer, const SignedFigures& sides, Json& rows) {
  rows.push_back(named("farthest outward", length_text(answer, sides.over)));
  rows.push_back(named("farthest inward", length_text(answer, sides.under)));
  if (sides.mean && sides.mean->lower * sides.mean->upper > 0) {
    const bool is_out = sides.mean->lower > 0;
    const Enclosure size = is_out ? *sides.mean : Enclosure{-sides.mean->upper, -sides.mean->lower};
    rows.push_back(named(is_out ? "mean, outward" : "mean, inward", length_text(answer, size)));
  }
}

Json figure_rows(const Answer& answer, bool back, const Statistics* statistics) {
  const Report& r = back ? *answer.b_to_a : answer.a_to_b;
  Json rows = Json::array();
  rows.push_back(named("largest deviation", length_text(answer, deviation_of(answer, r))));
  if (const SignedFigures* sides = sides_of(answer, back)) add_side_rows(answer, *sides, rows);
  if (!statistics) return rows;
  rows.push_back(named("mean deviation", length_text(answer, statistics->mean)));
  rows.push_back(named("root mean square", length_text(answer, statistics->rms)));
  for (const Percentile& p : statistics->percentiles)
    rows.push_back(named(percentile_name(p), length_text(answer, p.distance)));
  for (const AreaWithin& band : statistics->bands) rows.push_back(band_row(answer, band));
  return rows;
}

std::string array_text(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}).dump(); }

Json place_view(const Answer& answer, const WorstPlace& place, size_t number) {
  const std::string key = std::to_string(number);
  const std::string length = length_text(answer, place.distance);
  return {{"key", key},
          {"where", point_text(place.point, answer.a_to_b.diagonal_a)},
          {"length", length},
          {"face", "face " + std::to_string(place.file_face)},
          {"label", key + ": " + length},
          {"point", array_text(place.point)},
          {"normal", array_text(place.normal)}};
}

Json facts_of(const Answer& answer) {
  Json facts = Json::array();
  facts.push_back(named("Largest deviation", length_text(answer, deviation_of(answer))));
  if (answer.b_to_a) {
    facts.push_back(named("of A from B", length_text(answer, deviation_of(answer, answer.a_to_b))));
    facts.push_back(
        named("of B from A", length_text(answer, deviation_of(answer, *answer.b_to_a))));
  }
  if (answer.max) facts.push_back(named("Limit", limit_text(answer)));
  facts.push_back(named("Unit", unit_text(answer)));
  return facts;
}

}  // namespace

std::string file_name_in(const PageText& page, bool is_b) {
  const std::string path = page.json["inputs"][is_b ? 1 : 0]["path"];
  return path.substr(path.find_last_of("/\\") + 1);
}

Json head_view(const PageText& page, const std::string& title) {
  const Headline headline = headline_of(page.answer);
  const std::string names = file_name_in(page, false) + " against " + file_name_in(page, true);
  Json view = {{"window", headline.word + ": " + (title.empty() ? names : title)},
               {"title", title.empty() ? names : title},
               {"file_a", file_name_in(page, false)},
               {"file_b", file_name_in(page, true)},
               {"word", headline.word},
               {"style", headline.style},
               {"sign", sign_of(headline.style)},
               {"sentence", headline.sentence},
               {"facts", facts_of(page.answer)},
               {"is_two_way", page.answer.b_to_a.has_value()}};
  view["warnings"] = warnings_of(page.answer);
  const bool is_placed = page.answer.placed.has_value();
  view["placement"] = is_placed ? "A was placed by the matrix or the unit that the record names; "
                                  "nothing was fitted."
                                : "Nothing was fitted: A and B were measured as they lie.";
  return view;
}

Json side_view(const PageText& page, bool back, const std::vector<WorstPlace>& places,
               const Statistics* statistics) {
  Json view = {{"index", back ? 1 : 0},
               {"is_second", back},
               {"from", back ? "B" : "A"},
               {"to", back ? "A" : "B"},
               {"places", Json::array()},
               {"has_no_places", places.empty()},
               {"figures", figure_rows(page.answer, back, statistics)}};
  for (size_t i = 0; i < places.size(); ++i)
    view["places"].push_back(place_view(page.answer, places[i], i + 1));
  return view;
}

}  // namespace vkh
