// A point of A to two doubles, and planes that separate it from triangles of B.
#pragma once

#include "host/native/place.h"

namespace vkh::native {

/// Differences of corners without low parts are exact, and the combination is off by 4 kUlp2 S.
/// Coordinates are 1 at most, and the weights sum to 1 at most: S is under sqrt(3) + 2 sqrt(3)
/// = 5.2, and 4 * 5.2 kUlp2 are under 32, which are 2^-97.
inline Two3 exact_position(const Corners& face, const uvec2& at) {
  return two_combination(two(face.a), at.x * kUnit, two_difference(two(face.b), two(face.a)),
                         at.y * kUnit, two_difference(two(face.c), two(face.a)));
}

inline constexpr double kPositionError = 0x1p-97;

/// Any direction gives a true bound. A corner is separated along the offset, an edge by what is
/// orthogonal to it, the inside by the normal; where the closest point lies next to a border,
/// rounding may have named the wrong one, so all are tried.
inline double distance_by_features(const Surface& s, const vec3& offset) {
  const Two3 ab = two(s.at.b - s.at.a), ac = two(s.at.c - s.at.a), bc = two(s.at.c - s.at.b);
  const auto along = [&](const Two3& u, bool both_edges) {
    return coarse_distance_down(s, rounded(orthogonal(offset, u, ac, both_edges)));
  };
  return max(max(along(ab, true), along(ab, false)), max(along(ac, false), along(bc, false)));
}

/// <= the distance of the origin from a surface around it, 0 at least. It is precise if it has to
/// be: what is farther than `enough` stays at that.
inline double distance_from_origin_down(const Surface& s, double enough) {
  double best = max(coarse_distance_down(s, -s.at.a), 0.0);
  if (best >= enough) return best;
  const Closest c = closest_point(vec3(0, 0, 0), s.at);
  best = max(best, coarse_distance_down(s, c.offset));
  return best >= enough ? best : max(best, distance_by_features(s, c.offset));
}

}  // namespace vkh::native
