#include "host/survey/lengths.h"

#include <algorithm>

#include "host/base/rounding.h"
#include "host/mesh/mesh_pair.h"

namespace vkh {
namespace {

// A length of either sign in the files' units, not above it.
double down_in_files(const SurveyedPair& pair, double length) {
  const double down = add_down(length, -pair.displacement);
  const double in_unit = down < 0 ? -pair.frame.length_up(-down) : pair.frame.length_down(down);
  return std::max(in_unit, -pair.farthest);
}

}  // namespace

Enclosure in_files(const SurveyedPair& pair, const Enclosure& lengths) {
  const FileInterval f =
      pair.frame.to_files(lengths.lower, lengths.upper, pair.displacement, pair.farthest);
  return {f.lower, f.upper};
}

Enclosure signed_in_files(const SurveyedPair& pair, const Enclosure& lengths) {
  return {down_in_files(pair, lengths.lower), -down_in_files(pair, -lengths.upper)};
}

double least_width(const SurveyedPair& pair) {
  constexpr double kFloor = 2e-6;  // what plain floats leave of a cell's bounds, a few times over
  return std::max(1e-6 * pair.frame.to_frame(diagonal(bounding_box(pair.a))), 3 * kFloor);
}

}  // namespace vkh
