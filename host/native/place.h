// A candidate's corners around a corner of its face of A.
#pragma once

#include "host/native/math.h"

namespace vkh::native {

/// 1 as an integer of barycentrics: 30 halvings, and three of them fit a word (centroid_of).
inline constexpr uint kBits = 30;
inline constexpr uint kOne = 1u << kBits;
inline constexpr double kUnit = 1.0 / kOne;

inline Bary3 whole_face() { return {.a = {0u, 0u}, .b = {kOne, 0u}, .c = {0u, kOne}}; }

/// A face of A: its first corner, which is exact, and the edges from there, each rounded once.
struct Face {
  vec3 a;
  vec3 ab, ac;
  double slack;  ///< how far a point of local_corner, or of a cut between two, is off
};

/// The error of local_corner in terms of the longer edge E from the first corner: an edge is off by
/// u of itself, its product with a weight by u, and the sum by u. The weights sum to 1 at most, so
/// that all are under 3 u E, and the cuts of u3 (cut_point: 4 kUlp2 of E) are beside that nothing.
/// 2 kUlp are 4 u, which also covers that E is measured by rounded edges.
inline constexpr double kCornerError = 2.0 * kUlp;

inline Face make_face(const vec3& a, const vec3& b, const vec3& c) {
  Face f{.a = a, .ab = b - a, .ac = c - a, .slack = 0};
  f.slack = kCornerError * max(norm_up(f.ab), norm_up(f.ac));
  return f;
}

inline vec3 local_corner(const Face& f, const uvec2& at) {
  return (at.x * kUnit) * f.ab + (at.y * kUnit) * f.ac;
}
inline Corners local_corners(const Face& f, const Bary3& t) {
  return {local_corner(f, t.a), local_corner(f, t.b), local_corner(f, t.c)};
}

/// The point in the frame, rounded: it steers.
inline vec3 near_position(const Face& f, const uvec2& at) { return f.a + local_corner(f, at); }

/// The largest length that surfaces are measured with: coordinates are at most 1 in size, or 4
/// where the frame keeps the origin's place.
inline constexpr double kReach = 16;

/// Measures surfaces around a point, all of them coarse: their slack is 12 kUlp of their radius.
inline View view_around(const Two3& origin) {
  View v;
  v.origin = origin;
  v.reach = kReach;
  v.base = 0;
  v.sharp = v.plain = v.fine = false;
  v.enough = 1e300;
  return v;
}

}  // namespace vkh::native
