// Notes on a pair of meshes whose boxes are odd.
#pragma once

#include <string>
#include <vector>

#include "host/base/note.h"
#include "host/solve/frame.h"

namespace vkh {

/// Notes that the user may not have meant this pair: `units`, A's box is smaller or larger than B's
/// by 25.4, 10, 100 or 1000, to within 2 % of the diagonal and 10 % on every axis; otherwise
/// `size`, it is under 0.8 or over 1.25 times B's on an axis; and `apart`, the boxes are disjoint,
/// or their centres a tenth of B's diagonal apart. Axes on which both are under a thousandth of the
/// smaller diagonal do not count. `unit` is the coordinates'; empty: unknown. `unit_option` begins
/// the names of the options that convert A.
std::vector<Note> notes_on_boxes(const Box& a, const Box& b, const std::string& unit,
                                 const std::string& unit_option = "--unit");

/// "100 x 80 x 20": the extents of a box, to four digits.
std::string size_text(const Box& box);

}  // namespace vkh
