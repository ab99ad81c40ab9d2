// Notes on a pair of meshes that may not be the pair that the user meant.
#pragma once

#include <string>
#include <vector>

#include "host/mesh/principal_axes.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/note.h"

namespace vkh {

/// The figures of a mesh that the notes compare.
struct MeshShape {
  Box box;
  PrincipalAxes axes = {};
};
MeshShape shape_of(const Mesh& mesh);

/// Finds signs that the user may not have meant this pair: `units`, A's box is smaller or larger
/// than B's by 25.4, 10, 100 or 1000, to within 2 % of the diagonal and 10 % on every axis;
/// otherwise `turn`, the principal axes are turned (turn_between()); otherwise `size`, A's box is
/// under 0.8 or over 1.25 times B's on an axis; and `apart`, the boxes are a hundredth of B's
/// diagonal apart, or their centres a tenth. Axes on which both are under a thousandth of the
/// smaller diagonal do not count. `unit` is the coordinates'; empty: unknown. `unit_option` begins
/// the names of the options that convert A. `is_fitted`: A lies as a fit has turned it. Turned axes
/// then mean another shape, and `turn` is left out.
std::vector<Note> notes_on_pair(const MeshShape& a, const MeshShape& b, const std::string& unit,
                                const std::string& unit_option = "--unit", bool is_fitted = false);

/// Whether an answer's first line warns of it: the pair itself is odd.
bool is_odd_pair(NoteCode code);
/// The note's first clause, which the first line quotes: the text up to a colon or a question.
std::string clause_of(const Note& note);

/// "100 x 80 x 20": the extents of a box, to four digits.
std::string size_text(const Box& box);

}  // namespace vkh
