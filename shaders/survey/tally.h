// A cell's part of the figures of A: what it adds to integers, rounded outward, so that their sums
// do not depend on the order in which cells are added.
//
// The weight of a face is its area as an integer, of all faces together less than 2^62. A cell has
// its face's weight, halved as often as the cell was. Values are measured in a unit that is larger
// than any of them, a power of two, so that what a cell adds is less than its weight.
#ifndef VKH_SHADERS_SURVEY_TALLY_H
#define VKH_SHADERS_SURVEY_TALLY_H

#include "shaders/math/parts.h"
#include "shaders/survey/wide.h"

VKH_LIB_BEGIN

// How often a face was halved to get the cell: the cross product of its edges is a power of two,
// which is 2^40 for a face.
VKH_FN uint halvings_of(Bary3 t) {
  ivec2 u = ivec2(t.b) - ivec2(t.a);
  ivec2 v = ivec2(t.c) - ivec2(t.a);
  int p_high, p_low, q_high, q_low;
  imulExtended(u.x, v.y, p_high, p_low);
  imulExtended(u.y, v.x, q_high, q_low);
  uint low = uint(p_low) - uint(q_low);
  uint high = uint(p_high) - uint(q_high) - choose(uint(p_low) < uint(q_low), 1u, 0u);
  return 2u * kBaryBits - choose(high > 0u, 32u + uint(findMSB(high)), uint(findMSB(low)));
}

// A cell's weight, rounded down and up.
struct CellWeight {
  uvec2 down, up;
};

VKH_FN CellWeight cell_weight(uvec2 of_face, uint halvings) {
  CellWeight w;
  w.down = wide_shifted(of_face, halvings);
  w.up = wide_sum(w.down, uvec2(1u, 0u));
  return w;
}

// A share of the weight, rounded down and up. The product with 2^24 is exact.
VKH_FN uvec2 share_down(CellWeight w, float share) {
  return wide_scaled(w.down, uint(share * 16777216.0f), 24u);
}
VKH_FN uvec2 share_up(CellWeight w, float share) {
  float scaled = share * 16777216.0f;
  uint m = uint(scaled);
  m = m + choose(float(m) < scaled, 1u, 0u);
  return wide_sum(wide_scaled(w.up, m, 24u), uvec2(1u, 0u));
}

// w times a value >= 0 over 2^(unit - 127), which is larger, rounded down. A value is m 2^(e - 150)
// with m < 2^24; one below 2^-126 counts as 0.
VKH_FN uvec2 weighed(uvec2 w, float value, int unit) {
  uint bits = bits_of(value);
  int exponent = int(bits >> 23);
  if (exponent == 0) return uvec2(0u, 0u);
  int shift = min(23 + unit - exponent, 96);
  return wide_scaled(w, (bits & 0x7fffffu) | 0x800000u, uint(shift));
}
VKH_FN uvec2 weighed_down(CellWeight w, float value, int unit) {
  return weighed(w.down, value, unit);
}
VKH_FN uvec2 weighed_up(CellWeight w, float value, int unit) {
  uvec2 down = weighed(w.up, value, unit);
  return wide_sum(down, uvec2(choose(bits_of(value) == 0u, 0u, 1u), 0u));
}

// The bounds of d(x, B) over a cell as the tally takes them.
struct TallyBounds {
  vec3 lower;
  Spread below, above;  // of affine functions, not above d, `lower`, and not below it
  float highest;        // >= d
  float mean_upper, square_upper;
  float sure, may;  // the cell counts on this share of it at least, and at most
};

VKH_FN TallyBounds tally_bounds(CellBounds b) {
  TallyBounds t;
  t.lower = vec3(b.lower_a, b.lower_b, b.lower_c);
  t.below = spread_of(t.lower);
  t.above = spread_of(vec3(b.upper_a, b.upper_b, b.upper_c));
  t.highest = b.highest;
  t.mean_upper = min(b.mean_upper, b.highest);
  float square = choose(b.highest > 0.0f, round_up(b.highest * t.mean_upper, 1.0f), 0.0f);
  t.square_upper = min(b.square_upper, square);
  t.sure = 1.0f;
  t.may = 1.0f;
  return t;
}

// A lower bound of the distances of all points of the cell.
VKH_FN float lowest_of(TallyBounds b) { return max(b.below.least, 0.0f); }

// The bounds of what counts where a distance beyond `most` counts as 0: of a cell that is surely
// within it, all; of one that surely is not, nothing. Of one that may be, nothing is known from
// below, and from above no distance that counts exceeds `most`. It serves moments alone.
VKH_FN TallyBounds within_most(TallyBounds b, SurveyEdge most) {
  if (b.highest <= most.down) return b;
  float cap = choose(lowest_of(b) > most.up, 0.0f, max(most.up, 0.0f));
  b.lower = vec3(0.0f, 0.0f, 0.0f);
  b.mean_upper = min(b.mean_upper, cap);
  b.square_upper = min(b.square_upper, choose(cap > 0.0f, round_up(cap * cap, 1.0f), 0.0f));
  return b;
}

// The share of the cell that is surely within a distance and counts, and the share that may. The
// difference of two shares is off by kUlp of 1.
VKH_FN float surely_within(TallyBounds b, float down) {
  float within = choose(down >= b.highest, 1.0f, share_within(b.above, down).down);
  return choose(b.sure == 1.0f, within, max((within - (1.0f - b.sure)) - 2.0f * kUlp, 0.0f));
}
VKH_FN float perhaps_within(TallyBounds b, float up) {
  return min(share_within(b.below, up).up, b.may);
}

// The weight of such a share: of all of the cell no bit is lost.
VKH_FN uvec2 part_down(CellWeight w, float share) {
  if (share == 1.0f) return w.down;
  return share_down(w, share);
}
VKH_FN uvec2 part_up(CellWeight w, float share) {
  if (share == 1.0f) return w.up;
  return share_up(w, share);
}

// All that is known to count is within the one distance; and nothing that may is nearer than the
// other.
VKH_FN float counts_to(TallyBounds b) { return choose(b.sure == 1.0f, b.highest, 3.0e38f); }
VKH_FN float counts_from(TallyBounds b) { return choose(b.may > 0.0f, lowest_of(b), 3.0e38f); }

VKH_LIB_END
#endif
