// The lower bound: a point of A, every triangle of B as placed, and for each a plane that separates
// them. The tree takes no part.
#pragma once

#include "host/native/candidate.h"

namespace vkh::native {

/// <= the distance of the sample's point of A, as placed, from B as placed; never below 0.
double witness_distance_down(const Problem& problem, const Sample& sample, size_t threads);

}  // namespace vkh::native
