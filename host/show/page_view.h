// The texts of a page, as the data of its template: they stand in the file, whatever the viewer
// does.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/show/page.h"
#include "host/show/page_places.h"

namespace vkh {

/// The input of the functions below. `json` is the answer's JSON, parsed again: texts of files are
/// taken from it, so that they are in UTF-8.
struct PageText {
  const Answer& answer;
  nlohmann::ordered_json json;
};

/// The name of a file without its folder.
std::string file_name_in(const PageText& page, bool is_b);

/// Title, files, verdict, warnings and the facts beside them: what stands above all else.
nlohmann::ordered_json head_view(const PageText& page, const std::string& title);

/// One direction: its worst places and its figures.
nlohmann::ordered_json side_view(const PageText& page, bool back,
                                 const std::vector<WorstPlace>& places,
                                 const Statistics* statistics);

/// Describes the inputs, the device and the run: rows of two tables, and notes.
nlohmann::ordered_json record_view(const PageText& page);

}  // namespace vkh
