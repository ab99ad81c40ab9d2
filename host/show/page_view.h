// The texts of a page, as the data of its template: they stand in the file, whatever the viewer
// does.
#pragma once

#include <string>
#include <vector>

#include "host/base/parse_json.h"
#include "host/show/map_legend.h"
#include "host/show/page.h"

namespace vkh {

/// The input of the functions below. `json` is the answer's JSON, parsed again: texts of files are
/// taken from it, so that they are in UTF-8.
struct PageText {
  const Answer& answer;
  Json json;
};

/// The name of a file without its folder.
std::string file_name_in(const PageText& page, bool is_b);

/// Title, files, verdict, warnings and the facts beside them: what stands above all else.
Json head_view(const PageText& page, const std::string& title);

/// The part of a page about one direction.
struct SideText {
  const Picture& drawn;
  const drawing::MapScale& scale;
  const drawing::MapCounts& counts;
  const std::vector<MapPlace>& places;
};

/// One direction: its colours, its worst places and its figures.
Json side_view(const PageText& page, const SideText& side);

/// The colours of a bar, for the viewer.
Json scale_json(const drawing::MapScale& scale);

/// Describes the inputs, the device and the run: rows of two tables, and notes.
Json record_view(const PageText& page);

}  // namespace vkh
