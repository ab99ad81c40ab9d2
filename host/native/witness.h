// The lower bound: a point of A, every triangle of B as placed, and for each a plane that separates
// them. The tree takes no part.
#pragma once

#include "host/native/candidate.h"

namespace vkh::native {

/// <= the distance of the sample's point of A, as placed, from B as placed; never below 0.
double witness_distance_down(const Problem& problem, const Sample& sample, size_t threads);

/// <= the distance of the origin from a surface around it, 0 at least. It is precise if it has to
/// be: what is farther than `enough` stays at that.
double distance_from_origin_down(const Surface& s, double enough);

/// The point of a face at a sample's place; off by 2^-97 at most.
Two3 exact_position(const Corners& face, const uvec2& at);
inline constexpr double kPositionError = 0x1p-97;

}  // namespace vkh::native
