// The index page of a folder of a batch's drawings: its pairs, the worst first.
#pragma once

#include <string>
#include <vector>

#include "host/answer/result.h"
#include "host/show/draw_answer.h"

namespace vkh {

/// A pair, and the names of its files beside the page.
struct IndexRow {
  Result result;
  std::vector<std::string> pictures = {};
  std::string report = {};  ///< empty: none
};

struct IndexContents {
  std::vector<IndexRow> rows;
  const std::string& results;  ///< the file of the results
  const PictureStyle& look;
  size_t left = 0;  ///< pairs without a result
  bool has_limit = false;
  bool has_pictures = false, has_reports = false;  ///< the kinds of files in this folder
};

/// The whole page, which needs no script and no network.
std::string to_index(IndexContents contents);

}  // namespace vkh
