// Verdict, places and figures of a page.
#include "host/show/page_view.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "host/answer/json_text.h"
#include "host/base/decimal.h"
#include "host/show/camera.h"
#include "host/show/page_words.h"

namespace vkh {
namespace {

using drawing::MapScale;

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

// A row with a figure's estimate, and with its range if one number cannot stand for both ends.
Json length_row(const Answer& answer, const std::string& name, const Enclosure& length) {
  Json row = named(name, length_text(answer, length));
  const bool is_range = std::string(row["text"]).find(" to ") != std::string::npos;
  row["estimate"] = "";
  if (length.estimate && is_range)
    row["estimate"] =
        with_unit(estimate_text(*length.estimate, length, answer.max ? answer.max->limit : Limit{}),
                  answer.unit);
  return row;
}

// Two decimals, or as many as are between both ends.
std::string estimated_percent(const Enclosure& share) {
  const double percent = 100 * *share.estimate;
  return decimal_inside(percent, 100 * share.lower, 100 * share.upper,
                        digits_that_matter(percent, 1)) +
         " %";
}

// A row with a share; `asked`: the share that a limit asks for.
Json share_row(const std::string& name, const Enclosure& share, double asked) {
  Json row = named(name, share_text(share, asked));
  const bool is_range = share.upper - share.lower >= 2e-4;
  row["estimate"] = is_range && share.estimate ? estimated_percent(share) : "";
  return row;
}

Json band_row(const Answer& answer, const AnswerFigure& figure) {
  const bool is_of_limit = is_limit(answer, figure.at);
  Json row = share_row(figure.title + " " + band_text(answer, figure.at), figure.value,
                       is_of_limit && answer.max->area ? *answer.max->area : -1);
  row["is_limit"] = is_of_limit;
  return row;
}

// Says how much --max-distance leaves out of the rows below it.
Json left_out_row(const Answer& answer, const AnswerFigure& kept, const char* of) {
  const Enclosure rest{1 - kept.value.upper, 1 - kept.value.lower};
  return named("left out, farther than " + length_text(answer, {kept.at, kept.at}),
               share_text(rest) + " of the " + of);
}

// Adds a signed mean if its sign is known.
void add_signed_mean(const Answer& answer, const Enclosure& mean, Json& rows) {
  if (!(mean.lower * mean.upper > 0)) return;
  const bool is_out = mean.lower > 0;
  const Enclosure size = is_out ? mean : Enclosure{-mean.upper, -mean.lower};
  rows.push_back(named(is_out ? "mean, outward" : "mean, inward", length_text(answer, size)));
}

void add_row(const Answer& answer, const AnswerFigure& figure, bool are_points, Json& rows) {
  switch (figure.kind) {
    case FigureKind::kSignedMean:
      return add_signed_mean(answer, figure.value, rows);
    case FigureKind::kKept:
      return rows.push_back(left_out_row(answer, figure, are_points ? "points" : "area"));
    case FigureKind::kBand:
      return rows.push_back(band_row(answer, figure));
    default:
      if (figure.title.empty()) return;
      rows.push_back(figure.power == 0 ? share_row(figure.title, figure.value, -1)
                                       : length_row(answer, figure.title, figure.value));
  }
}

Json figure_rows(const Answer& answer, bool back, bool are_points) {
  Json rows = Json::array();
  for (const AnswerFigure& figure : figures_of(answer)) {
    if (figure.of_b == back) add_row(answer, figure, are_points, rows);
  }
  return rows;
}

std::string array_text(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}).dump(); }

glm::dvec3 normal_of(const Mesh& mesh, size_t face) {
  const glm::uvec3& f = mesh.faces[face];
  const glm::dvec3 a = mesh.vertices[f.x];
  const glm::dvec3 across = cross(mesh.vertices[f.y] - a, mesh.vertices[f.z] - a);
  const double area = length(across);
  return area > 0 ? across / area : glm::dvec3(0);
}

// The distance is an estimate, written as in the picture; its proven bounds stand below.
Json place_view(const Answer& answer, const Picture& drawn, const MapPlace& place, size_t number) {
  const std::string key = std::to_string(number);
  const std::string length = place_text(drawn, place), known = length_text(answer, place.known);
  const std::string face = (drawn.mesh.are_points ? "point " : "face ") +
                           std::to_string(drawn.mesh.file_faces.of(place.face));
  return {{"key", key},
          {"where", point_text(place.point, drawing::drawn_diagonal_of(drawn.mesh))},
          {"length", length},
          {"face", known == length ? face : face + ", " + known},
          {"label", key + ": " + length},
          {"point", array_text(place.point)},
          {"normal", array_text(normal_of(drawn.mesh, place.face))}};
}

std::string hex_of(Rgb colour) {
  constexpr const char* kHex = "0123456789abcdef";
  std::string text;
  for (const uint8_t part : {colour.red, colour.green, colour.blue}) {
    text += kHex[part >> 4];
    text += kHex[part & 15];
  }
  return text;
}

// The colour bar: coordinates of an SVG of 340 units, whose bar is 312 wide.
class BarView {
 public:
  explicit BarView(const MapScale& scale) : scale_(scale) {}

  Json json() const {
    Json bar = {{"colours", Json::array()}, {"ticks", Json::array()}, {"limits", Json::array()}};
    for (int i = 0; i < kRects; ++i)
      bar["colours"].push_back({{"x", number(kLeft + kWidth * i / kRects)},
                                {"fill", hex_of(scale_.palette().colour((i + 0.5) / kRects))}});
    const drawing::Ticks ticks = drawing::ticks_of({scale_.low(), scale_.high()}, 6);
    for (size_t i = 0; i < ticks.at.size(); ++i)
      bar["ticks"].push_back({{"x", x_of(ticks.at[i])}, {"text", ticks.text[i]}});
    bar["power"] = ticks.power;
    for (const std::optional<double>& limit : {scale_.limit_under(), scale_.limit()}) {
      if (limit && scale_.share_of(*limit) >= 0 && scale_.share_of(*limit) <= 1)
        bar["limits"].push_back(
            {{"x", x_of(*limit)}, {"text", "limit " + drawing::short_number(*limit)}});
    }
    return bar;
  }

 private:
  static constexpr int kRects = 156;
  static constexpr double kLeft = 14, kWidth = 312;

  static std::string number(double x) { return number_text(x, std::chars_format::fixed, 1); }
  std::string x_of(double distance) const {
    return number(kLeft + kWidth * std::clamp(scale_.share_of(distance), 0.0, 1.0));
  }

  const MapScale& scale_;
};

Json legend_view(const SideText& side) {
  Json legend = BarView(side.scale).json();
  legend["title"] = drawing::bar_title(side.drawn, side.scale);
  const std::string unit = side.drawn.unit.empty() ? "the files' unit" : side.drawn.unit;
  const std::string power = legend["power"];
  legend["unit"] = power.empty() ? unit : power + " " + unit;
  legend["is_signed"] = side.scale.is_signed();
  legend["rows"] = Json::array();
  for (const drawing::LegendRow& row : legend_rows(side.drawn, side.scale, side.counts))
    legend["rows"].push_back(
        {{"fill", hex_of(row.colour)}, {"is_hatched", row.is_hatched}, {"text", row.text}});
  return legend;
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

// Whether the effort was used before all figures were as narrow as asked, as happens on most CPUs.
bool has_used_effort(const Answer& answer, bool back) {
  const std::optional<SurveyResult>& survey = back ? answer.survey_b : answer.survey_a;
  return survey && survey->ended == SurveyEnd::kEffort;
}

// The name of a file without its folder.
std::string file_name_in(const Input& input) {
  return in_utf8(input.path.substr(input.path.find_last_of("/\\") + 1));
}

}  // namespace

Json head_view(const Answer& answer, const std::string& title) {
  const Headline headline = headline_of(answer);
  const std::string a = file_name_in(answer.inputs[0]), b = file_name_in(answer.inputs[1]);
  const std::string heading = title.empty() ? a + " against " + b : title;
  Json view = {{"window", headline.word + ": " + heading},
               {"title", heading},
               {"file_a", a},
               {"file_b", b},
               {"word", headline.word},
               {"style", headline.style},
               {"sign", sign_of(headline.style)},
               {"sentence", headline.sentence},
               {"facts", facts_of(answer)},
               {"is_two_way", answer.b_to_a.has_value()}};
  view["warnings"] = warnings_of(answer);
  const bool is_placed = answer.placed.has_value();
  view["placement"] = is_placed ? "A was placed by the matrix or the unit that the record names; "
                                  "nothing was fitted."
                                : "Nothing was fitted: A and B were measured as they lie.";
  return view;
}

Json side_view(const Answer& answer, const SideText& side) {
  const bool back = side.drawn.back;
  Json view = {{"index", back ? 1 : 0},
               {"is_second", back},
               {"from", back ? "B" : "A"},
               {"to", back ? "A" : "B"},
               {"places", Json::array()},
               {"has_no_places", side.places.empty()},
               {"figures", figure_rows(answer, back, side.drawn.mesh.are_points)},
               {"legend", legend_view(side)},
               {"is_finer_with_effort", has_used_effort(answer, back)}};
  size_t number = 0;
  for (const MapPlace& place : side.places)
    view["places"].push_back(place_view(answer, side.drawn, place, ++number));
  return view;
}

Json scale_json(const MapScale& scale) {
  const drawing::Palette& palette = scale.palette();
  const auto text = [](const auto& colours) {
    std::string all;
    for (const Rgb colour : colours) all += hex_of(colour);
    return all;
  };
  return {{"low", scale.low()},
          {"high", scale.high()},
          {"signed", scale.is_signed()},
          {"from", palette.from},
          {"to", palette.to},
          {"bands", palette.bands},
          {"colours", text(palette.below) + text(palette.within) + text(palette.above)},
          {"outside", hex_of(drawing::kBelow) + hex_of(drawing::kOver) + hex_of(drawing::kNoSide) +
                          hex_of(drawing::kLeftOut)}};
}

}  // namespace vkh
