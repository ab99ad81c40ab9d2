// The report: one HTML file that needs no network. Verdict, interval, a view to turn, a tolerance
// to drag, the worst places, and everything that names the run.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "host/answer/answer.h"
#include "host/mesh/mesh.h"
#include "host/survey/field.h"

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
};

struct PageLimits {
  size_t bytes = 5'000'000;  ///< size of the file: meshes are decimated until it is no larger
  size_t faces = 150'000;    ///< for a shown mesh: more would be slow to turn without a GPU
};

/// Returns the whole file. Its statements come from the answer's JSON, which it carries. Counts,
/// shares and the histogram are over every face; only the view may be decimated, and shows so.
std::string to_page(const PageContents& contents, const PageLimits& limits = {});

}  // namespace vkh
