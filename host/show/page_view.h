// The texts of a page, as the data of its template: they are in the file, even if the viewer does
// not run.
#pragma once

#include <string>
#include <vector>

#include "host/base/parse_json.h"
#include "host/show/map_legend.h"
#include "host/show/page.h"

namespace vkh {

/// The head of the page: title, files, verdict, warnings and the facts beside them.
Json head_view(const Answer& answer, const std::string& title);

/// The part of a page about one direction.
struct SideText {
  const Picture& drawn;
  const drawing::MapScale& scale;
  const drawing::MapCounts& counts;
  const std::vector<MapPlace>& places;
};

/// One direction: its colours, its worst places and its figures.
Json side_view(const Answer& answer, const SideText& side);

/// The colours of a bar, for the viewer.
Json scale_json(const drawing::MapScale& scale);

/// Describes the inputs, the device and the run: rows of two tables, and notes.
Json record_view(const Answer& answer);

}  // namespace vkh
