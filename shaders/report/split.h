// How to split a cell T so that its parts have narrow bounds. T is wide where d(., B) bends between
// its corners, since its bounds are affine, and where no triangle of B serves all of T: above edges
// of B, where triangles are equally near, where A passes through B. These lie along lines, mostly
// straight ones, and a part that is long along a line and narrow across it is known as well as many
// round ones. So T is halved at the edge that leaves the halves the least width, as far as its
// corners and the middles of its edges tell, and its halves are. A split steers: no bound rests on
// it.
#ifndef VKH_SHADERS_REPORT_SPLIT_H
#define VKH_SHADERS_REPORT_SPLIT_H

#include "shaders/math/dyadic.h"
#include "shaders/report/cell.h"

VKH_LIB_BEGIN

// A length in the frame: what plain floats leave of widths.
VKH_CONST float kLeastGain = 2e-6f;

// The square of T's longest edge over twice its area, from which on that edge is halved, whatever
// it leaves: a map must not see needles longer than its pixels.
VKH_CONST float kNeedle = 16.0f;

// Of three points, such as a triangle's corners or the middles of the edges opposite them, the
// distances from each of four triangles of B.
struct Distances {
  vec3 from[4];
};

VKH_FN vec3 least_of(Distances d) {
  return min(min(d.from[0], d.from[1]), min(d.from[2], d.from[3]));
}

// How much more the mean of the corners' distances is if all are from one triangle of the four.
VKH_FN float looseness(Distances corners) {
  float first = min(sum3(corners.from[0]), sum3(corners.from[1]));
  float second = min(sum3(corners.from[2]), sum3(corners.from[3]));
  return (min(first, second) - sum3(least_of(corners))) * kThirdDown;
}

// How far d at the middles is from the mean of the ends of their edges, as a part of the mean over
// the triangle: d as a pyramid of that height over it has a third of the height.
VKH_FN vec3 bends_of(vec3 corners, vec3 middles) {
  vec3 means = 0.5f * vec3(corners.y + corners.z, corners.z + corners.x, corners.x + corners.y);
  return kThirdDown * sizes(middles - means);
}

// ---- halves: at the edge opposite corner x to its middle, as bisected() of math/dyadic.h
// ----------

VKH_FN uint after(uint x) { return choose(x == 2u, 0u, x + 1u); }
VKH_FN uint before(uint x) { return choose(x == 0u, 2u, x - 1u); }

VKH_FN vec3 middle(vec3 p, vec3 q) { return 0.5f * (p + q); }

// The middles of the edges opposite the corners in order.
VKH_FN Corners middles_of(Corners t) {
  Corners m;
  m.a = middle(t.b, t.c);
  m.b = middle(t.c, t.a);
  m.c = middle(t.a, t.b);
  return m;
}

// Half 0 or 1.
VKH_FN Corners half_of(Corners t, uint x, uint side) {
  vec3 m = middle(corner_of(t, after(x)), corner_of(t, before(x)));
  Corners h;
  h.a = corner_of(t, x);
  h.b = choose(side == 0u, corner_of(t, after(x)), m);
  h.c = choose(side == 0u, m, corner_of(t, before(x)));
  return h;
}

// A half's corners' distances by those of the whole's corners and middles.
VKH_FN Distances corners_of_half(Distances corners, Distances middles, uint x, uint side) {
  Distances h;
  for (uint k = 0u; k < 4u; ++k) {
    float m = pick3(middles.from[k], x);
    h.from[k] =
        vec3(pick3(corners.from[k], x), choose(side == 0u, pick3(corners.from[k], after(x)), m),
             choose(side == 0u, m, pick3(corners.from[k], before(x))));
  }
  return h;
}

// The middles of the edges that the whole has not: two on the one that is halved, one between the
// halves.
VKH_FN Corners fresh_middles(Corners t, uint x) {
  Corners first = half_of(t, x, 0u);
  Corners second = half_of(t, x, 1u);
  Corners m;
  m.a = middle(first.b, first.c);
  m.b = middle(second.b, second.c);
  m.c = middle(first.a, first.c);
  return m;
}

// The distances of the middles of a half's edges.
VKH_FN Distances middles_of_half(Distances fresh, Distances middles, uint x, uint side) {
  Distances h;
  for (uint k = 0u; k < 4u; ++k) {
    vec3 f = fresh.from[k];
    vec3 first = vec3(f.x, f.z, pick3(middles.from[k], before(x)));
    vec3 second = vec3(f.y, pick3(middles.from[k], after(x)), f.z);
    h.from[k] = choose(side == 0u, first, second);
  }
  return h;
}

// ---- the choice ---------------------------------------------------------------------------------

// What halving at the edge opposite x takes from the width.
VKH_FN float gain_of(Distances corners, Distances middles, vec3 bends, uint x) {
  float first = looseness(corners_of_half(corners, middles, x, 0u));
  float second = looseness(corners_of_half(corners, middles, x, 1u));
  return pick3(bends, x) + looseness(corners) - 0.5f * (first + second);
}

// The edge to halve, by the corner opposite: the longest of those that gain nearly as much as any.
VKH_FN uint edge_to_halve(Corners t, Distances corners, Distances middles) {
  vec3 ea = t.c - t.b;
  vec3 eb = t.a - t.c;
  vec3 ec = t.b - t.a;
  vec3 squares = vec3(dot3(ea, ea), dot3(eb, eb), dot3(ec, ec));
  vec3 across = cross3(ea, eb);
  bool is_needle = max3(squares) > kNeedle * norm_up(across);
  vec3 bends = bends_of(least_of(corners), least_of(middles));
  vec3 gains = vec3(gain_of(corners, middles, bends, 0u), gain_of(corners, middles, bends, 1u),
                    gain_of(corners, middles, bends, 2u));
  float most = max3(gains);
  float enough = choose(!is_needle && most >= kLeastGain, 0.7f * most, -3.0e38f);
  squares.x = choose(gains.x >= enough, squares.x, -1.0f);
  squares.y = choose(gains.y >= enough, squares.y, -1.0f);
  squares.z = choose(gains.z >= enough, squares.z, -1.0f);
  if (squares.x >= squares.y && squares.x >= squares.z) return 0u;
  return squares.y >= squares.z ? 1u : 2u;
}

// The split of T that begins opposite x, as a code of math/dyadic.h. `fresh`: of fresh_middles().
VKH_FN uint split_from(uint x, Corners t, Distances corners, Distances middles, Distances fresh) {
  uint y = edge_to_halve(half_of(t, x, 0u), corners_of_half(corners, middles, x, 0u),
                         middles_of_half(fresh, middles, x, 0u));
  uint z = edge_to_halve(half_of(t, x, 1u), corners_of_half(corners, middles, x, 1u),
                         middles_of_half(fresh, middles, x, 1u));
  return bisection_code(x, y, z);
}

// The split at the longest edges of T and of its halves.
VKH_FN uint split_as_shaped(Corners t) {
  uint x = opposite_longest(t);
  return bisection_code(x, opposite_longest(half_of(t, x, 0u)),
                        opposite_longest(half_of(t, x, 1u)));
}

// Three points' distances from S.
VKH_FN vec3 distances_from(Surface s, Corners at, CellFrame t) {
  return vec3(cell_distance(t, at.a, s), cell_distance(t, at.b, s), cell_distance(t, at.c, s));
}

VKH_LIB_END
#endif
