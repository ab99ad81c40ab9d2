#include "host/show/report_csv.h"

#include <vector>

#include "host/answer/csv.h"
#include "host/answer/figures.h"
#include "host/base/decimal.h"
#include "host/show/map_places.h"
#include "host/show/page_words.h"

namespace vkh {
namespace {

std::string row_text(const std::vector<std::string>& cells) { return csv_line(cells, "\r\n"); }

std::string figure_row(const Answer& answer, const AnswerFigure& figure) {
  const bool is_band = figure.kind == FigureKind::kBand;
  const Enclosure& e = figure.value;
  return row_text({figure.of_b ? "B" : "A",
                   is_band ? "within " + band_text(answer, figure.at) : figure.name,
                   e.estimate ? decimal_between(*e.estimate, e.lower, e.upper) : "",
                   csv_bound(e.lower, Rounding::kDown), csv_bound(e.upper, Rounding::kUp),
                   figure.power == 0 ? "1" : answer.unit});
}

}  // namespace

std::string figures_csv(const Measured& measured) {
  (void)sides_of(measured);  // throws if nothing was surveyed
  std::string out = row_text({"from", "figure", "estimate", "lower", "upper", "unit"});
  for (const AnswerFigure& figure : figures_of(measured.answer)) {
    if (figure.in_report) out += figure_row(measured.answer, figure);
  }
  return out;
}

std::string points_csv(const Measured& measured) {
  const Answer& answer = measured.answer;
  std::string out =
      row_text({"from", "place", "x", "y", "z", "deviation", "lower", "upper", "face", "unit"});
  for (const Side& side : sides_of(measured)) {
    size_t number = 0;
    for (const MapPlace& place : worst_places(drawn_of(side, answer))) {
      const char* sign = place.side == SurfaceSide::kUnder && place.distance > 0 ? "-" : "";
      out += row_text({side.back ? "B" : "A", std::to_string(++number),
                       shortest_decimal(place.point.x), shortest_decimal(place.point.y),
                       shortest_decimal(place.point.z),
                       sign + decimal_between(place.distance, place.known.lower, place.known.upper),
                       csv_bound(place.known.lower, Rounding::kDown),
                       csv_bound(place.known.upper, Rounding::kUp),
                       std::to_string(side.mesh.file_faces.of(place.face)), answer.unit});
    }
  }
  return out;
}

}  // namespace vkh
