// The legend of a map by cells: its bar, its worst places, its distribution.
#pragma once

#include <vector>

#include "host/show/legend.h"
#include "host/show/map_places.h"
#include "host/show/map_scale.h"

namespace vkh::drawing {

/// The legend's input, in addition to the sheet.
struct MapLegend {
  const MapScale& scale;
  const MapCounts& counts;
  const std::vector<MapPlace>& places;
};

/// A row for what the bar's colours do not show: a swatch, and its text with a share of the area or
/// of the points.
struct LegendRow {
  Rgb colour;
  bool is_hatched;
  std::string text;
};
std::vector<LegendRow> legend_rows(const Picture& picture, const MapScale& scale,
                                   const MapCounts& counts);
/// "distance from B, estimated".
std::string bar_title(const Picture& picture, const MapScale& scale);
/// About four digits; a minus sign as a bar has it.
std::string short_number(double x);

/// Draws the bar with its limits, and below it the rows for what its colours do not show.
void draw_map_bar(const Sheet& sheet, const MapLegend& legend, const Area& area);
/// Lists the places by their numbers: distance and coordinates. Returns the height that it takes.
double draw_places(const Sheet& sheet, const MapLegend& legend, const Area& area);
/// Draws the distribution of area, or of points, over the bar, and figures.
void draw_histogram(const Sheet& sheet, const MapLegend& legend, const Area& area);

/// A share for people: "12 %", "0.03 %", "under 0.01 %".
std::string percent_text(double share);

/// The disc with a place's number.
void draw_number(const Sheet& sheet, glm::dvec2 at, size_t number, bool is_hidden);

}  // namespace vkh::drawing
