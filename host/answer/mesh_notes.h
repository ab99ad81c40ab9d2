// Notes of an answer that its question and its meshes decide, and on the memory that a run took.
#pragma once

#include <vector>

#include "host/answer/placing.h"
#include "vkhausdorff/answer.h"
#include "vkhausdorff/frame.h"
#include "vkhausdorff/note.h"

namespace vkh {

/// Returns notes on a unit that was converted, or that one file does not say.
std::vector<Note> notes_on_units(const Mesh& a, const Units& units);
/// Notes how good the fit is, since a fit is no proof.
void add_notes_on_fit(Answer& answer);
/// From a surface to points the farthest places lie between points.
void add_note_on_points(const Question& question, const Mesh& a, const Mesh& b, Answer& answer);
/// A matrix that stretches by s moves points by s times their distance from the origin. From a
/// tenth of the tolerance on this is noted. `box`: A's.
void add_note_on_stretch(const Box& box, Answer& answer);

}  // namespace vkh
