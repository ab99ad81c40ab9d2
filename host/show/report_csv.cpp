#include "host/show/report_csv.h"

#include <cmath>
#include <initializer_list>

#include "host/base/decimal.h"
#include "host/show/map_places.h"
#include "host/show/page_words.h"

namespace vkh {
namespace {

constexpr const char* kLine = "\r\n";

std::string row_text(std::initializer_list<std::string> cells) {
  std::string text;
  for (const std::string& cell : cells) text += (text.empty() ? "" : ",") + cell;
  return text + kLine;
}

std::string csv_end(double value, Rounding rounding) {
  return std::isfinite(value) ? decimal(value, kJsonDigits, rounding) : "";
}

class FiguresTable {
 public:
  FiguresTable(const Answer& answer, bool back, std::string& out)
      : answer_(answer), from_(back ? "B" : "A"), out_(out) {}

  void add(const std::string& figure, const Enclosure& e, const std::string& unit) {
    out_ +=
        row_text({from_, figure, e.estimate ? decimal_between(*e.estimate, e.lower, e.upper) : "",
                  csv_end(e.lower, Rounding::kDown), csv_end(e.upper, Rounding::kUp), unit});
  }
  void add_length(const std::string& figure, const Enclosure& e) { add(figure, e, answer_.unit); }

  void add_sides(const SignedFigures& sides) {
    add_length("outward", sides.over);
    add_length("inward", sides.under);
    if (sides.mean) add_length("signed mean", *sides.mean);
  }

  void add_statistics(const Statistics& s) {
    add_length("mean", s.mean);
    add_length("rms", s.rms);
    for (const Percentile& p : s.percentiles)
      add_length("p" + shortest_decimal(100 * p.share), p.distance);
    for (const AreaWithin& band : s.bands)
      add("within " + band_text(answer_, band), band.share, "1");
  }

 private:
  const Answer& answer_;
  std::string from_;
  std::string& out_;
};

}  // namespace

std::string figures_csv(const Measured& measured) {
  std::string out = row_text({"from", "figure", "estimate", "lower", "upper", "unit"});
  for (const Side& side : sides_of(measured)) {
    FiguresTable table(measured.answer, side.back, out);
    table.add_length("largest", deviation_of(measured.answer, side.report));
    if (side.survey.sides) table.add_sides(*side.survey.sides);
    if (side.survey.statistics) table.add_statistics(*side.survey.statistics);
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
      out += row_text(
          {side.back ? "B" : "A", std::to_string(++number), shortest_decimal(place.point.x),
           shortest_decimal(place.point.y), shortest_decimal(place.point.z),
           sign + decimal_between(place.distance, place.known.lower, place.known.upper),
           csv_end(place.known.lower, Rounding::kDown), csv_end(place.known.upper, Rounding::kUp),
           std::to_string(side.mesh.file_faces.of(place.face)), answer.unit});
    }
  }
  return out;
}

}  // namespace vkh
