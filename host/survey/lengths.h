// Lengths of a survey in the files' units, of the meshes as they are held.
#pragma once

#include "host/solve/cells.h"
#include "vkhausdorff/field.h"

namespace vkh {

/// Converts lengths in the frame, on the stored meshes, to the files' units.
Enclosure in_files(const SurveyedPair& pair, const Enclosure& lengths);
/// The same for lengths of either sign.
Enclosure signed_in_files(const SurveyedPair& pair, const Enclosure& lengths);

/// The width in the frame that is enough for any figure: a millionth of A's diagonal, or what
/// floats leave.
double least_width(const SurveyedPair& pair);

}  // namespace vkh
