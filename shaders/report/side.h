// The side of B on which a cell T of A lies.
//
// Where B bounds a solid and T is off it, T is connected and so on one side: that of any of its
// points, by the number of times that B winds round it, which a ray from the point counts. A T that
// touches B has the side of what is off B, if the rest of it is so near that it needs none.
// Elsewhere T is over B where it is in front of the planes of all triangles that may be closest
// somewhere on it, and under B where it is behind them all.
//
// Both are of B's and A's vertices wherever they may be up to `moved`, those of both meshes
// together, from where they are stored. docs/certificate.md adds up the errors.
#ifndef VKH_SHADERS_REPORT_SIDE_H
#define VKH_SHADERS_REPORT_SIDE_H

#include "shaders/report/cell.h"

VKH_LIB_BEGIN

// More than what products that are flushed to zero lose, of coordinates up to 2^15.
VKH_CONST float kLeastHeight = 1e-30f;

VKH_FN int sign_of(float x, float error) {
  float sure = error * (1.0f + 16.0f * kUlp) + kLeastHeight;
  if (x > sure) return 1;
  if (x < -sure) return -1;
  return 0;
}

// The sign of (e x f).(p - a), where it is more than the error; all points may be `off`. Then
// e and f are off by 2 off each, e x f by 2 off (|e| + |f| + 2 off), and p - a by 2 off. Rounding,
// in units of kUlp: differences 1, products of two 3, their difference 1 more, products with
// p - a 2 more, sums 2: 8 of the sum of the sizes, which is at most sqrt(2) |e| |f| |p - a|; 13
// are taken.
VKH_FN int side_of_plane(vec3 p, Corners s, float off) {
  vec3 e = s.b - s.a;
  vec3 f = s.c - s.a;
  vec3 x = p - s.a;
  float height = dot3(cross3(e, f), x);
  float area = norm_up(e) * norm_up(f);
  float away = norm_up(x);
  float turned = 2.0f * off * (norm_up(e) + norm_up(f) + 2.0f * off);
  float error = turned * (away + 2.0f * off) + area * (2.0f * off + 13.0f * kUlp * away);
  return sign_of(height, error);
}

// 1: T is surely in front of S's plane, -1: behind it, 0: neither is sure. The height is affine, so
// the corners tell of all of T.
VKH_FN int side_of_cell(CellFrame t, Surface s, float moved) {
  float off = round_up(s.slack + t.slack + moved, 2.0f);
  int first = side_of_plane(t.at.a, s.at, off);
  if (first == 0 || side_of_plane(t.at.b, s.at, off) != first) return 0;
  if (side_of_plane(t.at.c, s.at, off) != first) return 0;
  return first;
}

// Upper bounds of d(x, B) on T: an affine function by its values at T's corners, and one number.
struct Above {
  vec3 at_corners;
  float highest;
};

// How much farther S is than B, from below, at T's corners: an affine function. Both distances move
// by `moved`.
struct Beyond {
  vec3 at_corners;
  bool is_far;  // S is farther everywhere
};

VKH_FN Beyond beyond_of(CellFrame t, Surface s, Above above, float moved) {
  Closest c = closest_point(vec3(0.0f, 0.0f, 0.0f), s.at);
  float off = round_up(minorant_off(t, s) + 2.0f * moved, 2.0f);
  vec3 below = minorant(t, s, shortened(c.offset), off).at_corners;
  Beyond e;
  e.at_corners = below - above.at_corners;
  e.is_far = either(least3(e.at_corners) > 0.0f, least3(below) > above.highest);
  return e;
}

// Whether S may be closest to some point of T: it is not where a plane that S is behind is surely
// farther than B.
VKH_FN bool may_be_closest(CellFrame t, Surface s, Above above, float moved) {
  return !beyond_of(t, s, above, moved).is_far;
}

// A point of T by its weights, as good as any: `turn` 0 to 2.
VKH_FN vec3 inner_weights(uint turn) {
  vec3 w = vec3(0.5017f, 0.2271f, 0.2712f);
  return choose(turn == 0u, w, choose(turn == 1u, vec3(w.z, w.x, w.y), vec3(w.y, w.z, w.x)));
}

// That point. It is off by T's slack, and by 4 kUlp of the radius.
VKH_FN vec3 inner_point(CellFrame t, uint turn) {
  vec3 w = inner_weights(turn);
  return (w.x * t.at.a + w.y * t.at.b) + w.z * t.at.c;
}

// The error, beyond 3 kUlp of itself, of a coordinate of S's corners as seen from inner_point():
// coarse_difference leaves 2 kUlp of it and of the point, which is no farther than the radius, and
// kUlp2 of what both are; then the point's own error.
VKH_FN float inner_off(CellFrame t) {
  return round_up(t.slack + 8.0f * kUlp * t.radius + 4.0f * kUlp2 * t.reach, 4.0f);
}

// A triangle's part of the number of times that B winds round the origin, by a ray along x.
struct Crossing {
  int winding;
  bool is_sure;
};

VKH_FN Crossing crossing_is(int winding) {
  Crossing c;
  c.winding = winding;
  c.is_sure = true;
  return c;
}

VKH_FN Crossing crossing_is_unsure() {
  Crossing c;
  c.winding = 0;
  c.is_sure = false;
  return c;
}

// Twice the area of the origin, p and q, as they are seen along x, and what it is off: a product of
// two coordinates by 7 kUlp of itself and by `off` of both, their difference by kUlp.
VKH_FN float turn_of(vec3 p, vec3 q) { return p.y * q.z - p.z * q.y; }
VKH_FN float turn_error(vec3 p, vec3 q, float off) {
  float size = abs(p.y * q.z) + abs(p.z * q.y);
  float sum = (abs(p.y) + abs(p.z)) + (abs(q.y) + abs(q.z));
  return 10.0f * kUlp * size + 1.001f * off * (sum + 2.0f * off);
}

// The error of x w, where w is off by `error`, and x by 3 kUlp of itself and by `off`.
VKH_FN float product_error(float x, float w, float error, float off) {
  return abs(x) * error + (abs(w) + error) * (8.0f * kUlp * abs(x) + off);
}

// The ray meets the triangle where it turns one way round the origin at all three edges, and the
// triangle's point there, a mean of the corners by the areas of the others, has x > 0.
VKH_FN Crossing crossing_of(vec3 a, vec3 b, vec3 c, float off) {
  float ab = turn_of(a, b);
  float bc = turn_of(b, c);
  float ca = turn_of(c, a);
  float ab_error = turn_error(a, b, off);
  float bc_error = turn_error(b, c, off);
  float ca_error = turn_error(c, a, off);
  int x = sign_of(ab, ab_error);
  int y = sign_of(bc, bc_error);
  int z = sign_of(ca, ca_error);
  bool is_left = either(x > 0, either(y > 0, z > 0));
  bool is_right = either(x < 0, either(y < 0, z < 0));
  if (both(is_left, is_right)) return crossing_is(0);
  if (x == 0 || y == 0 || z == 0) return crossing_is_unsure();
  float along = (a.x * bc + b.x * ca) + c.x * ab;
  float error = product_error(a.x, bc, bc_error, off) + product_error(b.x, ca, ca_error, off) +
                product_error(c.x, ab, ab_error, off);
  int ahead = sign_of(along, error);
  if (ahead == 0) return crossing_is_unsure();
  return crossing_is(ahead == x ? x : 0);
}

// Turns coordinates so that the axis is x; a winding number stays.
VKH_FN vec3 turned(vec3 p, uint axis) {
  return choose(axis == 0u, p, choose(axis == 1u, vec3(p.y, p.z, p.x), vec3(p.z, p.x, p.y)));
}

VKH_FN Crossing crossing_along(CellFrame t, Surface s, uint axis) {
  vec3 p = inner_point(t, axis);
  return crossing_of(turned(s.at.a - p, axis), turned(s.at.b - p, axis), turned(s.at.c - p, axis),
                     inner_off(t));
}

// Whether T is off B wherever the vertices are: `lowest` is not above d(x, B) on T.
VKH_FN bool is_off(float lowest, float moved) { return lowest > round_up(moved, 4.0f); }

// Whether T is off B except where it is nearer than `near`, and is_off_inside(): where the affine
// function `lower` tells that it is off, T is convex, and so on one side of B.
VKH_FN bool is_off_but_near(vec3 lower, vec3 upper, float moved, float near) {
  return round_up(most_within(lower, upper, round_up(moved, 4.0f)) + moved, 1.0f) < near;
}

// Whether T is off B at an inner point, by `lower`: a mean of its values, off by 5 kUlp of the
// largest.
VKH_FN bool is_off_inside(vec3 lower, uint turn, float moved) {
  return is_off(dot3(inner_weights(turn), lower) - 8.0f * kUlp * max3(sizes(lower)), moved);
}

// The class of a cell when one more triangle that may be closest is looked at: of `kind`, with T on
// this side of it. `before`: kClassUnseen at first.
VKH_FN uint class_with(uint before, uint kind, int side) {
  if ((kind & kFaceBare) != 0u) return kClassDegenerate;
  uint now = choose(side > 0, kClassOver, kClassUnder);
  bool is_doubtful = side == 0 || (before != kClassUnseen && before != now);
  uint why = choose((kind & kFaceTwoSided) != 0u, kClassTwoSided, kClassEdge);
  return choose(is_doubtful, why, now);
}

VKH_FN bool has_side(uint of_class) { return of_class == kClassOver || of_class == kClassUnder; }

VKH_LIB_END
#endif
