// The pieces of a page that are text: they stand in the file, whatever the viewer does.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/show/page.h"
#include "host/show/page_figures.h"

namespace vkh {

/// Data that the functions below write the page's parts from. `json` is the answer's JSON, parsed
/// again: the page takes its texts from it, so that they agree with the JSON and are in UTF-8.
struct PageText {
  const Answer& answer;
  nlohmann::ordered_json json;
};

/// Returns "0.0441 to 0.0443 mm", rounded outward; "at most" if nothing is known from below.
std::string range_text(const Answer& answer, const Enclosure& length);

/// Returns 1234567 as "1,234,567".
std::string grouped(uint64_t count);

std::string title_text(const PageText& page);
std::string verdict_html(const PageText& page);
std::string facts_html(const PageText& page);
/// Returns a button for each direction, if there are two.
std::string directions_html(const PageText& page);
/// Lists the worst places of one direction, and its witness.
std::string places_html(const PageText& page, bool back, const std::vector<WorstPlace>& places);
std::string statistics_html(const PageText& page, bool back, const Statistics& statistics);
std::string inputs_html(const PageText& page);
std::string run_html(const PageText& page);
std::string notes_html(const PageText& page);

}  // namespace vkh
