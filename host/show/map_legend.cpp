#include "host/show/map_legend.h"

#include <algorithm>
#include <cmath>

#include "host/base/decimal.h"
#include "host/show/page_words.h"

namespace vkh::drawing {
namespace {

constexpr double kSmall = 15, kText = 16;

double fitted_size(const std::string& text, double size, double width) {
  return std::min(size, size * width / std::max(text_width(text, size), 1e-9));
}

// Names the whole that shares are parts of.
const char* of_what(const Picture& picture) {
  return picture.mesh.are_points ? " of the points" : " of the area";
}

// A complete survey may leave unresolved cells that are smaller than a pixel. Many of them side by
// side are visible.
std::string unresolved_text(const Picture& picture, double share) {
  const bool is_small = picture.unfinished.empty() && !picture.mesh.are_points;
  if (picture.mesh.polygons.any_triangulation)
    return "not resolved, by any triangulation: " + percent_text(share);
  return (is_small ? "not resolved, in cells under a pixel: " : "not resolved: ") +
         percent_text(share);
}

double draw_rows(const Sheet& sheet, const std::vector<LegendRow>& rows, const Area& area) {
  const double u = sheet.unit, size = kSmall * u, line = 25 * u;
  double y = area.bottom() - line * static_cast<double>(rows.size());
  for (const LegendRow& row : rows) {
    y += line;
    const Area swatch{area.x, y - size, 1.6 * size, size};
    sheet.canvas.fill(swatch, row.colour);
    if (row.is_hatched) sheet.canvas.hatch(swatch, 8 * u);
    sheet.canvas.frame(swatch, 1, kGrey);
    const double x = swatch.right() + 9 * u;
    write(sheet.canvas, {x, y - 0.12 * size}, row.text,
          {fitted_size(row.text, size, area.right() - x), kInk, Align::kLeft});
  }
  return line * static_cast<double>(rows.size());
}

struct DrawnBar {
  Area area;
  const MapScale& scale;
  double y_of(double distance) const {
    return area.bottom() - std::clamp(scale.share_of(distance), 0.0, 1.0) * area.height;
  }
};

void draw_bar_colours(const Sheet& sheet, const DrawnBar& bar) {
  const auto rows = static_cast<int>(bar.area.height);
  for (int row = 0; row < rows; ++row)
    sheet.canvas.fill({bar.area.x, bar.area.y + row, bar.area.width, 1},
                      bar.scale.palette().colour((rows - row - 0.5) / rows));
  sheet.canvas.frame(bar.area, 1, kGrey);
}

void draw_bar_limit(const Sheet& sheet, const DrawnBar& bar, double limit) {
  const double u = sheet.unit, y = bar.y_of(limit), size = kText * u;
  const double left = bar.area.x - 10 * u;
  sheet.canvas.line({left, y}, {bar.area.right() + 4 * u, y}, std::max(2.0, 2.4 * u), kInk);
  write(sheet.canvas, {left - 8 * u, y - 0.25 * size}, "limit", {size, kInk, Align::kRight});
  const std::string text = short_number(limit);
  write(sheet.canvas, {left - 8 * u, y + 0.85 * size}, text,
        {fitted_size(text, size, 90 * u), kInk, Align::kRight});
}

void draw_bar_ticks(const Sheet& sheet, const DrawnBar& bar, const Ticks& ticks) {
  const double u = sheet.unit, size = kText * u, x = bar.area.right();
  for (size_t i = 0; i < ticks.at.size(); ++i) {
    const double y = bar.y_of(ticks.at[i]);
    sheet.canvas.line({x, y}, {x + 6 * u, y}, std::max(1.0, 1.2 * u), kGrey);
    write(sheet.canvas, {x + 11 * u, y + 0.36 * size}, ticks.text[i], {.size = size});
  }
}

// The words beside the ends of a signed bar.
void draw_bar_sides(const Sheet& sheet, const DrawnBar& bar) {
  const double u = sheet.unit, size = kSmall * u, x = bar.area.x + 118 * u;
  const std::string other = sheet.picture.back ? "A" : "B";
  write(sheet.canvas, {x, bar.area.y + size}, "over " + other, {size, kGrey, Align::kLeft});
  write(sheet.canvas, {x, bar.area.bottom()}, "under " + other, {size, kGrey, Align::kLeft});
}

}  // namespace

std::string percent_text(double share) {
  const double percent = 100 * share;
  if (percent <= 0) return "0 %";
  if (percent < 0.01) return "under 0.01 %";
  if (percent > 99.9 && percent < 100) return "over 99.9 %";
  return number_text(percent, std::chars_format::general, percent < 1 ? 2 : 3) + " %";
}

std::string short_number(double x) {
  const std::string text = number_text(std::abs(x), std::chars_format::general, 4);
  return x < 0 ? "\u2212" + text : text;
}

std::vector<LegendRow> legend_rows(const Picture& picture, const MapScale& scale,
                                   const MapCounts& counts) {
  const auto number = [&](double x) { return with_unit(picture, short_number(x)); };
  std::vector<LegendRow> rows;
  if (counts.above > 0)
    rows.push_back(
        {kOver, false,
         "over " + number(scale.high()) + ": " + percent_text(counts.above) + of_what(picture)});
  if (counts.below > 0)
    rows.push_back(
        {kBelow, false,
         "below " + number(scale.low()) + ": " + percent_text(counts.below) + of_what(picture)});
  if (counts.no_side > 0)
    rows.push_back({kNoSide, false, "no side known: " + percent_text(counts.no_side)});
  if (counts.left_out > 0)
    rows.push_back({kLeftOut, false,
                    "left out, over " + number(*picture.map->max_distance) + ": " +
                        percent_text(counts.left_out) + of_what(picture)});
  if (counts.unresolved > 0)
    rows.push_back({kUnresolved, true, unresolved_text(picture, counts.unresolved)});
  return rows;
}

std::string bar_title(const Picture& picture, const MapScale& scale) {
  return (scale.is_signed() ? "signed distance from " : "distance from ") +
         std::string(picture.back ? "A" : "B") + ", estimated";
}

void draw_map_bar(const Sheet& sheet, const MapLegend& legend, const Area& area) {
  const double u = sheet.unit, size = kText * u;
  const double notes =
      draw_rows(sheet, legend_rows(sheet.picture, legend.scale, legend.counts), area);
  const MapScale& scale = legend.scale;
  const double top = area.y + 54 * u;
  const DrawnBar bar{{std::round(area.x + 120 * u), std::round(top), std::round(34 * u),
                      std::round(std::max(area.bottom() - notes - 12 * u - top, 30 * u))},
                     scale};
  const size_t most = std::clamp<size_t>(static_cast<size_t>(bar.area.height / (40 * u)), 2, 8);
  Ticks ticks = ticks_of({scale.low(), scale.high()}, most);
  if (ticks.at.size() < 3) ticks = ticks_of({scale.low(), scale.high()}, 2 * most);
  write(sheet.canvas, {area.x, area.y + size}, bar_title(sheet.picture, scale),
        {size, kGrey, Align::kLeft});
  const std::string unit = sheet.picture.unit.empty() ? "files' units" : sheet.picture.unit;
  write(sheet.canvas, {bar.area.x, area.y + 2.5 * size},
        ticks.power.empty() ? unit : ticks.power + " " + unit, {size, kInk, Align::kLeft});
  draw_bar_colours(sheet, bar);
  draw_bar_ticks(sheet, bar, ticks);
  if (scale.limit()) draw_bar_limit(sheet, bar, *scale.limit());
  if (scale.limit_under()) draw_bar_limit(sheet, bar, *scale.limit_under());
  if (scale.is_signed()) draw_bar_sides(sheet, bar);
}

void draw_number(const Sheet& sheet, glm::dvec2 at, size_t number, bool is_hidden) {
  const double u = sheet.unit, radius = 11 * u;
  sheet.canvas.disc(at, radius + 2 * u, kPaper);
  sheet.canvas.disc(at, radius, is_hidden ? kGrey : kInk);
  if (is_hidden) sheet.canvas.disc(at, radius - 2 * u, kPaper);
  write(sheet.canvas, {at.x, at.y + 5.4 * u}, std::to_string(number),
        {15 * u, is_hidden ? kGrey : kPaper, Align::kCentre});
}

double draw_places(const Sheet& sheet, const MapLegend& legend, const Area& area) {
  const double u = sheet.unit, size = kText * u, line = 28 * u;
  if (legend.places.empty()) return 0;
  write(sheet.canvas, {area.x, area.y + size}, "worst places", {size, kGrey, Align::kLeft});
  double y = area.y + 12 * u;
  for (size_t i = 0; i < legend.places.size(); ++i) {
    y += line;
    const MapPlace& place = legend.places[i];
    draw_number(sheet, {area.x + 12 * u, y}, i + 1, false);
    const std::string text = place_text(sheet.picture, place);
    const double x = area.x + 32 * u, column = 118 * u;
    write(sheet.canvas, {x, y + 0.36 * size}, text,
          {fitted_size(text, size, column - 8 * u), kInk, Align::kLeft});
    const std::string at = point_text(place.point, drawn_diagonal_of(sheet.picture.mesh));
    write(sheet.canvas, {x + column, y + 0.36 * size}, at,
          {fitted_size(at, size, area.right() - x - column), kGrey, Align::kLeft});
  }
  return y + 0.6 * line - area.y;
}

namespace {

std::vector<std::string> figures_of(const Sheet& sheet, const MapLegend& legend) {
  const auto number = [&](const Enclosure& e) {
    return with_unit(sheet.picture, estimate_text(*e.estimate, e));
  };
  std::vector<std::string> figures;
  if (legend.scale.limit())
    figures.push_back(percent_text(legend.counts.within) + of_what(sheet.picture) +
                      (sheet.picture.sided ? " within the limits" : " within the limit"));
  const Statistics* s = sheet.picture.statistics;
  const bool has_mean = s != nullptr && s->mean.estimate;
  const std::string of_rest = legend.counts.left_out > 0 ? "of the rest: mean " : "mean ";
  figures.push_back(of_rest + (has_mean
                                   ? number(s->mean)
                                   : with_unit(sheet.picture, short_number(legend.counts.mean))));
  if (s == nullptr) return figures;
  if (s->rms.estimate) figures.back() += ", rms " + number(s->rms);
  std::string percentiles;
  for (const Percentile& p : s->percentiles) {
    if (p.distance.estimate && p.share > 0.9)
      percentiles += (percentiles.empty() ? "" : ", ") + shortest_decimal(100 * p.share) +
                     " % within " + number(p.distance);
  }
  if (!percentiles.empty()) figures.push_back(percentiles);
  return figures;
}

}  // namespace

void draw_histogram(const Sheet& sheet, const MapLegend& legend, const Area& area) {
  const double u = sheet.unit, size = kSmall * u;
  const std::vector<std::string> figures = figures_of(sheet, legend);
  double y = area.bottom() - 22 * u * static_cast<double>(figures.size());
  const Area plot{area.x, area.y + 26 * u, area.width, y - 30 * u - area.y - 26 * u};
  for (const std::string& text : figures) {
    y += 22 * u;
    write(sheet.canvas, {area.x, y}, text,
          {fitted_size(text, size, area.width), kInk, Align::kLeft});
  }
  if (plot.height < 20 * u) return;
  const std::string title = std::string("share") + of_what(sheet.picture) + " by distance" +
                            (legend.counts.no_side > 0 ? ", where a side is known" : "");
  write(sheet.canvas, {area.x, area.y + size}, title,
        {fitted_size(title, size, area.width), kGrey, Align::kLeft});
  const auto& bins = legend.counts.bins;
  const double most = std::max({*std::max_element(bins.begin(), bins.end()), legend.counts.above,
                                legend.counts.below, 1e-9});
  const double step = plot.width / static_cast<double>(bins.size() + 2);
  const auto bar = [&](size_t i, double share, Rgb colour) {
    const double height = std::round(plot.height * share / most);
    const double drawn = share > 0 ? std::max(height, 1.0) : 0;
    sheet.canvas.fill({plot.x + static_cast<double>(i) * step, plot.bottom() - drawn,
                       std::max(step - 1, 1.0), drawn},
                      colour);
  };
  bar(0, legend.counts.below, kBelow);
  for (size_t i = 0; i < bins.size(); ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(bins.size());
    bar(i + 1, bins[i], legend.scale.palette().colour(share));
  }
  bar(bins.size() + 1, legend.counts.above, kOver);
  sheet.canvas.line({plot.x, plot.bottom()}, {plot.right(), plot.bottom()}, 1, kGrey);
  write(sheet.canvas, {plot.x + step, plot.bottom() + 18 * u}, short_number(legend.scale.low()),
        {size, kGrey, Align::kLeft});
  write(sheet.canvas, {plot.right() - step, plot.bottom() + 18 * u},
        with_unit(sheet.picture, short_number(legend.scale.high())), {size, kGrey, Align::kRight});
}

}  // namespace vkh::drawing
