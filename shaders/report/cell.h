// Bounds on d(x, B) over a sub-triangle T of A, a cell, from the triangles S of B that may be
// closest somewhere on it: its least and its greatest value, its mean, its mean square.
//
// Above: d(., B) <= d(., S) for every S. That is convex, so it is at most its greatest value at T's
// corners, and its mean is at most theirs; below it, over T, lies the affine function that has the
// same values at the corners, whose mean square is (x x + y y + z z + x y + y z + z x) / 6.
//
// Below: for any g with |g| <= 1, d(x, S) >= min over the corners s of S of g.(x - s), an affine
// function of x. The least of several, one for each S, is concave: over T it is at least its least
// value at T's corners, and its mean is at least theirs. It is under d(., B) where every S that may
// be closest somewhere on T has one. With u not less than d(., B) on T, and r the distance of T's
// farthest corner from a centre c, no S is that is farther from c than u + r: at any x of T it
// would be farther than u. Nor is one that is beyond another (is_beyond). The triangles that are
// not examined, at least D from c, give D - |x - c|, which is concave, too.
//
// T is computed in plain floats around c, S too (Surface::coarse); Cell::slack and Surface::slack
// bound the error. docs/certificate.md adds it up.
#ifndef VKH_SHADERS_REPORT_CELL_H
#define VKH_SHADERS_REPORT_CELL_H

#include "shaders/math/bary.h"
#include "shaders/math/parts.h"

VKH_LIB_BEGIN

// T around its centre, a dyadic point next to its centroid.
struct CellFrame {
  Two3 origin;   // the centre
  Corners at;    // T's corners from there
  float radius;  // >= what any corner is away from it
  float reach;   // >= the largest coordinate magnitude of T's face
  float slack;   // how far a computed point of T can lie from the exact one
};

// Steps are off by 4.5 kUlp2 of the reach, the centre by 8 (position_of), a step's rounding to one
// float by kUlp of itself, and a cut between two corners by 5 kUlp of the radius more.
VKH_FN CellFrame make_cell(Root root, Bary3 t) {
  CellFrame cell;
  uvec2 centre = centroid_of(t);
  cell.origin = position_of(root, centre);
  cell.at.a = rounded(step_between(centre, t.a, root));
  cell.at.b = rounded(step_between(centre, t.b, root));
  cell.at.c = rounded(step_between(centre, t.c, root));
  cell.radius = radius_up(cell.at);
  cell.reach = round_up(norm_up(root.origin.hi) + norm_up(root.ab.hi) + norm_up(root.ac.hi), 8.0f);
  cell.slack = round_up(7.0f * kUlp * cell.radius + 16.0f * kUlp2 * cell.reach, 4.0f);
  return cell;
}

// The view from which B's triangles are measured: coarse, for any slack.
VKH_FN View cell_view(CellFrame cell) {
  View v;
  v.origin = cell.origin;
  v.reach = round_up(cell.reach + cell.radius, 1.0f);
  v.base = 0.0f;
  v.sharp = false;
  v.plain = false;
  v.enough = 3.0e38f;
  v.fine = false;
  return v;
}

// Bounds over the triangles of B examined so far.
struct Gathered {
  uint triangle;     // the first of them, the nearest to c
  vec3 best;         // >= the corners' distances from the one that these add up to least for
  vec3 along;        // a direction that serves the triangles around it, where B is flat
  vec3 below;        // with the affine function of that one
  vec3 corners;      // >= d(x, B) at T's corners
  uvec3 of_corners;  // the triangles that these are the distances from
  float centre;      // <= d(c, S) for every S
  vec3 at_corners;   // the same for one affine function per S
  vec3 upper;        // an affine function, by its values at T's corners, not under d(., B)
  float highest;     // >= d(x, B) for every x of T
  float mean;        // >= the mean of d(x, B) over T
  float square;      // >= the mean of its square
};

VKH_FN Gathered nothing_gathered() {
  Gathered g;
  g.triangle = kNone;
  g.along = vec3(0.0f, 0.0f, 0.0f);
  g.below = vec3(-3.0e37f, -3.0e37f, -3.0e37f);
  g.best = vec3(3.0e38f, 3.0e38f, 3.0e38f);
  g.corners = vec3(3.0e38f, 3.0e38f, 3.0e38f);
  g.of_corners = uvec3(kNone, kNone, kNone);
  g.centre = 3.0e38f;
  g.at_corners = vec3(3.0e38f, 3.0e38f, 3.0e38f);
  g.upper = vec3(3.0e38f, 3.0e38f, 3.0e38f);
  g.highest = 3.0e38f;
  g.mean = 3.0e38f;
  g.square = 3.0e38f;
  return g;
}

// g.(x - s) at T's centre and corners, s the corner of S where it is least: each less `off`.
struct Minorant {
  float centre;
  vec3 at_corners;
};

// Products of vectors are off by 3 kUlp of their lengths' product, the difference by one: 5 kUlp
// of T's radius and S's together.
VKH_FN float minorant_off(CellFrame t, Surface s) {
  float rounding = round_up(5.0f * kUlp * (t.radius + radius_up(s.at)), 4.0f);
  return round_up(rounding + s.slack + t.slack, 2.0f);
}

VKH_FN Minorant minorant(CellFrame t, Surface s, vec3 g, float off) {
  float farthest = max(dot3(g, s.at.a), max(dot3(g, s.at.b), dot3(g, s.at.c)));
  Minorant m;
  m.centre = lowered(-farthest - off);
  m.at_corners.x = lowered((dot3(g, t.at.a) - farthest) - off);
  m.at_corners.y = lowered((dot3(g, t.at.b) - farthest) - off);
  m.at_corners.z = lowered((dot3(g, t.at.c) - farthest) - off);
  return m;
}

// Chooses, of two for the same S, the one that is less under the nearest triangle's, so that it
// lowers the least of all less; both hold at the centre.
VKH_FN Minorant better(Minorant m, Minorant n, vec3 nearest) {
  Minorant best = m;
  if (sum3(min(n.at_corners, nearest)) > sum3(min(m.at_corners, nearest))) best = n;
  best.centre = max(m.centre, n.centre);
  return best;
}

// d(corner, S) from above, marked.
VKH_FN float cell_corner_distance(CellFrame t, vec3 corner, Surface s) {
  bool inside;
  float d = length_up(plain_distance2(corner, s.at, inside)) + (s.slack + t.slack);
  return marked(round_up(d, 3.0f), inside);
}

// The same for each corner of T.
VKH_FN vec3 cell_distances(CellFrame t, Surface s) {
  return vec3(cell_corner_distance(t, t.at.a, s), cell_corner_distance(t, t.at.b, s),
              cell_corner_distance(t, t.at.c, s));
}

// The bounds from above of one triangle, or of two: an affine function that is not under d(., B),
// and a mean and a mean square that may be less than those of the function.
VKH_FN Gathered with_upper(Gathered g, vec3 upper, float mean, float square) {
  if (sum3(upper) < sum3(g.upper)) g.upper = upper;
  g.highest = min(g.highest, max3(upper));
  g.mean = min(g.mean, mean);
  g.square = min(g.square, square);
  return g;
}

// Whether some corner, or all of T, may be nearer to S than to the triangles examined before.
VKH_FN bool may_be_nearer(Gathered g, Minorant m) {
  bool at_corner = either(m.at_corners.x < g.corners.x,
                          either(m.at_corners.y < g.corners.y, m.at_corners.z < g.corners.z));
  return at_corner || max3(m.at_corners) < g.highest || sum3(m.at_corners) * kThirdDown < g.mean;
}

VKH_FN Gathered with_corners(Gathered g, vec3 d, uint triangle) {
  g.of_corners.x = choose(d.x < g.corners.x, triangle, g.of_corners.x);
  g.of_corners.y = choose(d.y < g.corners.y, triangle, g.of_corners.y);
  g.of_corners.z = choose(d.z < g.corners.z, triangle, g.of_corners.z);
  g.corners = min(g.corners, d);
  return g;
}

// Adds a triangle's distances from T's corners.
VKH_FN Gathered with_distances(Gathered g, vec3 d, uint triangle) {
  if (sum3(d) < sum3(g.best)) g.best = d;
  g = with_corners(g, d, triangle);
  return with_upper(g, d, mean_up(d), mean_square_up(d));
}

// Takes the direction for all triangles if it gives S, the nearest to c, more than the one before.
VKH_FN Gathered with_direction(Gathered g, CellFrame t, Surface s, vec3 direction) {
  vec3 along = shortened(direction);
  vec3 below = minorant(t, s, along, minorant_off(t, s)).at_corners;
  bool better = sum3(below) > sum3(g.below);
  g.along = choose(better, along, g.along);
  g.below = choose(better, below, g.below);
  return g;
}

// S's normal, on the side that `offset` leads to.
VKH_FN vec3 normal_towards(Surface s, vec3 offset) {
  vec3 normal = cross3(s.at.b - s.at.a, s.at.c - s.at.a);
  return choose(dot3(normal, offset) < 0.0f, -normal, normal);
}

// Adds S, one that is near: its bounds from above decide which others to examine. It gives no bound
// from below until it is examined as they are. Next to S the closest point's direction is what
// rounding leaves, and its normal serves.
VKH_FN Gathered begin_gathering(CellFrame t, Surface s, uint triangle) {
  Gathered g = nothing_gathered();
  Closest c = closest_point(vec3(0.0f, 0.0f, 0.0f), s.at);
  g.triangle = triangle;
  g = with_direction(g, t, s, c.offset);
  g = with_direction(g, t, s, normal_towards(s, c.offset));
  return with_distances(g, cell_distances(t, s), triangle);
}

// S's minorant: its own directions are from its closest point to the centre, and its normal, which
// serves all of T where that point is at S's border.
VKH_FN Minorant minorant_of(Gathered g, CellFrame t, Surface s) {
  Closest c = closest_point(vec3(0.0f, 0.0f, 0.0f), s.at);
  float off = minorant_off(t, s);
  Minorant m = minorant(t, s, shortened(c.offset), off);
  m = better(m, minorant(t, s, g.along, off), g.below);
  return better(m, minorant(t, s, shortened(normal_towards(s, c.offset)), off), g.below);
}

// Takes in S's minorant, if S is beyond none.
VKH_FN Gathered with_minorant(Gathered g, Minorant m) {
  g.centre = min(g.centre, m.centre);
  g.at_corners = min(g.at_corners, m.at_corners);
  return g;
}

// Examines S, too. It is left out if it is beyond the best so far: that stays, or is beyond one
// that does. None is beyond itself or its equal, since a minorant is lowered.
VKH_FN Gathered gathered(Gathered g, CellFrame t, Surface s, uint triangle) {
  Minorant m = minorant_of(g, t, s);
  if (is_beyond(m.at_corners, g.best)) return g;
  g = with_minorant(g, m);
  if (!may_be_nearer(g, m)) return g;
  return with_distances(g, cell_distances(t, s), triangle);
}

// d(p, S) from above, p off by T's slack.
VKH_FN float cell_distance(CellFrame t, vec3 p, Surface s) {
  return round_up(length_up(plain_distance2(p, s.at)) + (s.slack + t.slack), 3.0f);
}

VKH_FN vec3 placed(Cut cut, float alone, float first, float second) {
  return vec3(choose(cut.alone == 0u, alone, choose(cut.first == 0u, first, second)),
              choose(cut.alone == 1u, alone, choose(cut.first == 1u, first, second)),
              choose(cut.alone == 2u, alone, choose(cut.first == 2u, first, second)));
}

// An affine function on T that is at least `at` at the alone corner and the two others, and at
// least `p` and `q` at the cuts.
// NOLINTNEXTLINE(readability-function-size)
VKH_FN vec3 plane_above(Cut cut, vec3 at, float to_p, float p, float to_q, float q) {
  float on_p = round_down((1.0f - to_p) * at.x + to_p * at.y, 4.0f);
  float on_q = round_down((1.0f - to_q) * at.x + to_q * at.z, 4.0f);
  float more = max(max(p - on_p, q - on_q), 0.0f);
  return placed(cut, round_up(at.x + more, 4.0f), round_up(at.y + more, 4.0f),
                round_up(at.z + more, 4.0f));
}

// Cuts T between S and R where its distances from them, `ds` and `dr` at its corners, even out as
// from_cut has it: the piece with one corner, o, belongs to the nearer there, the other to the
// other. Cuts p and q on the edges from o to f and to h: the pieces are o p q, p f h and p h q.
// NOLINTNEXTLINE(readability-function-size)
VKH_FN Gathered cut_between(Gathered g, CellFrame t, Surface s, vec3 ds, Surface r, vec3 dr) {
  vec3 side = ds - dr;
  Cut cut = cut_by(side);
  if (cut.none) return g;
  bool own_s = pick3(side, cut.alone) < 0.0f;
  vec3 own = choose(own_s, ds, dr);
  vec3 other = choose(own_s, dr, ds);
  vec3 away = from_cut(ds, dr, 0.0f);
  float out_of = abs(pick3(away, cut.alone));
  float to_p = min(ratio(out_of, out_of + abs(pick3(away, cut.first))), 1.0f);
  float to_q = min(ratio(out_of, out_of + abs(pick3(away, cut.second))), 1.0f);
  vec3 o = corner_of(t.at, cut.alone);
  vec3 p = o + to_p * (corner_of(t.at, cut.first) - o);
  vec3 q = o + to_q * (corner_of(t.at, cut.second) - o);
  float ps = cell_distance(t, p, s);
  float pr = cell_distance(t, p, r);
  float qs = cell_distance(t, q, s);
  float qr = cell_distance(t, q, r);
  vec3 x = vec3(pick3(own, cut.alone), choose(own_s, ps, pr), choose(own_s, qs, qr));
  vec3 y = vec3(choose(own_s, pr, ps), pick3(other, cut.first), pick3(other, cut.second));
  vec3 z = vec3(y.x, y.z, choose(own_s, qr, qs));
  vec3 area = vec3(to_p * to_q, 1.0f - to_p, to_p * (1.0f - to_q));
  float mean = area.x * mean_up(x) + area.y * mean_up(y) + area.z * mean_up(z);
  float square =
      area.x * mean_square_up(x) + area.y * mean_square_up(y) + area.z * mean_square_up(z);
  g.highest = min(g.highest, max(max3(x), max(max3(y), max3(z))));
  vec3 at = vec3(x.x, y.y, y.z);
  vec3 above = plane_above(cut, at, to_p, max(ps, pr), to_q, max(qs, qr));
  return with_upper(g, above, round_up(mean, 8.0f), round_up(square, 8.0f));
}

// Accounts for triangles that are not examined, none of them closer to the centre than `distance`.
VKH_FN Gathered without(Gathered g, CellFrame t, float distance) {
  float at_corners = lowered(distance - t.radius);
  g.centre = min(g.centre, distance);
  g.at_corners = min(g.at_corners, vec3(at_corners, at_corners, at_corners));
  return g;
}

// The result: an affine function that is not above d(., B), that of the values at the corners or
// one number; and a distance that some point of T reaches.
VKH_FN vec3 lower_of(Gathered g, CellFrame t) {
  float around = lowered(g.centre - t.radius);
  vec3 lower = g.at_corners;
  if (least3(lower) < around) lower = vec3(around, around, around);
  return lower;
}
// This does not use the centre, which may lie outside of T by a rounding of its barycentrics.
VKH_FN float reached_of(Gathered g) { return max(max3(g.at_corners), 0.0f); }

VKH_LIB_END
#endif
