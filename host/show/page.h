// The report: one HTML file that needs no network. Verdict, a view to turn, a tolerance to drag,
// the worst places, figures, and everything that names the run.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "host/answer/answer.h"
#include "host/mesh/mesh.h"
#include "host/survey/field.h"
#include "host/write/colour_map.h"

namespace vkh {

/// The measured mesh of one direction. All that is pointed at stays the caller's.
struct PageDirection {
  const Mesh* mesh = nullptr;
  const Field* field = nullptr;
  const Statistics* statistics = nullptr;  ///< nullptr: none were asked for
  std::string_view picture = {};           ///< a PNG's bytes; empty: none
};

struct PageContents {
  const Answer* answer = nullptr;
  PageDirection a_to_b;
  std::optional<PageDirection> b_to_a = {};
  std::string title = {};  ///< the page's heading; empty: the names of both files
  ColourMap map = ColourMap::kViridis;
  bool is_y_up = false;  ///< the y axis points up in the view; otherwise z does
};

struct PageLimits {
  size_t bytes = 5'000'000;  ///< size of the file: meshes are decimated until it is no larger
  size_t faces = 150'000;    ///< for a shown mesh: more would be slow to turn without a GPU
};

/// Returns the whole file, which carries the answer's JSON. Its figures are the answer's and its
/// survey's, and shares of area are the survey's at every tolerance. Only the view may be
/// decimated, and shows so.
std::string to_page(const PageContents& contents, const PageLimits& limits = {});

}  // namespace vkh
