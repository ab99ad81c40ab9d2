// The bounds of a cell, shaders/report/cell.h and what it includes, with double for float as in
// host/native/math.h; and the boxes of B that they rest on. A cell's corners have 20 bits there and
// here: shaders/math/bary.h has its positions.
#pragma once

#include "host/native/face_tree.h"
#define float double
#include "shaders/report/cell.h"
#include "shaders/report/normal.h"
#include "shaders/report/side.h"
#include "shaders/report/split.h"
#undef float

namespace vkh::native {

/// A length larger than all distances, whose square is a float.
inline constexpr double kFarthest = 1e15;

/// Boxes at more than this distance, squared, hold nothing that is closest anywhere on T, which is
/// nowhere farther from B than `highest`. T's exact points and centre are off by its slack.
/// float_above() takes a half of 2^-23 of it, and so the doubles' roundings, and more than what
/// underflows in the boxes' distances.
inline float cell_reach(double highest, const CellFrame& t) {
  const double far = min(highest + t.radius + t.slack, kFarthest);
  return float_above(far * far);
}

/// <= the distance between an exact point, from which that in doubles is off by `slack`, and what
/// is in boxes at this distance, squared, as Walk has it: of the 2^-148 that underflow may have
/// added, the root is 2^-74. A root and two differences are rounded, 1.5 kUlp of the root.
inline double box_distance_down(double slack, double distance2) {
  return max(round_down(root(distance2), 2.0) - 0x1p-74 - slack, 0.0);
}

}  // namespace vkh::native
