// Scores: how much a split of a cell helps, as the cell's part of the widths of the figures that
// are not yet narrow. A score only steers.
#ifndef VKH_SHADERS_SURVEY_SCORE_H
#define VKH_SHADERS_SURVEY_SCORE_H

#include "shaders/math/bary.h"
#include "shaders/survey/tally.h"

VKH_LIB_BEGIN

// A width in the frame: what plain floats leave of a cell's bounds, a few times over. Splits gain
// nothing below it.
VKH_CONST float kScoreFloor = 2e-6f;

// The share of the cell that is not known to be within a distance, or beyond it.
VKH_FN float undecided_share(TallyBounds b, SurveyEdge at) {
  return max(perhaps_within(b, at.up) - surely_within(b, at.down), 0.0f);
}

VKH_FN float mean_width(TallyBounds b) { return max(b.mean_upper - mean_over_down(b.lower), 0.0f); }
VKH_FN float square_width(TallyBounds b) {
  return max(b.square_upper - square_over_down(b.lower), 0.0f);
}

// A lower bound of the distances of all points of the cell.
VKH_FN float lowest_of(CellBounds b) {
  return max(min(b.lower_a, min(b.lower_b, b.lower_c)), 0.0f);
}

// The affine functions between which the distances lie, by their values at the corners.
VKH_FN vec3 lower_of(CellBounds b) { return vec3(b.lower_a, b.lower_b, b.lower_c); }
VKH_FN vec3 upper_of(CellBounds b) { return vec3(b.upper_a, b.upper_b, b.upper_c); }

// A cell as a map draws it: an affine function, by its values at the corners.
struct DrawnCell {
  vec3 at;
  float off;  // >= how far the distance of a point of the cell is from what is drawn there
};

// The distance is above `lower` and under `upper`, two affine functions, which are farthest from
// what is drawn at a corner; and between two numbers.
VKH_FN DrawnCell drawn_by(CellBounds b, vec3 at) {
  float farther = min(max3(upper_of(b) - at), b.highest - least3(at));
  float nearer = min(max3(at - lower_of(b)), max3(at) - lowest_of(b));
  DrawnCell drawn;
  drawn.at = at;
  drawn.off = max(farther, nearer);
  return drawn;
}

// Draws the middle of the affine functions, or of the numbers, whichever is less off.
VKH_FN DrawnCell drawn_of(CellBounds b) {
  float lowest = lowest_of(b);
  float middle = 0.5f * (lowest + b.highest);
  vec3 middles = 0.5f * (lower_of(b) + upper_of(b));
  vec3 most = vec3(b.highest, b.highest, b.highest);
  DrawnCell affine = drawn_by(b, min(max(middles, vec3(lowest, lowest, lowest)), most));
  DrawnCell level = drawn_by(b, vec3(middle, middle, middle));
  if (level.off < affine.off) return level;
  return affine;
}

// Scores a cell for a map by how much more than `step` it is off, unless all of it is farther than
// `most`. Where it may touch B it has no side: it has a colour all the same if that part of it
// reaches no farther than a step, or all of it no farther than two. A step of 0: there is no map.
VKH_FN float map_score(CellBounds b, float step, float most) {
  DrawnCell drawn = drawn_of(b);
  float lowest = lowest_of(b);
  float all = choose(lowest > 0.0f, 0.0f, max3(drawn.at) + drawn.off);
  float part = min(most_within(lower_of(b), upper_of(b), 0.0f), b.highest);
  float more = max(max(drawn.off, min(0.5f * all, part)) - step, 0.0f);
  return choose(step == 0.0f || lowest > most, 0.0f, more);
}

// Whether an edge is longer than this: a map may show many needles of little area side by side.
VKH_FN bool is_longer(Corners t, float length) {
  vec3 ab = t.b - t.a;
  vec3 ac = t.c - t.a;
  vec3 bc = t.c - t.b;
  return max(dot3(ab, ab), max(dot3(ac, ac), dot3(bc, bc))) > length * length;
}

// The cell's share of A's area, of which its face has a weight.
VKH_FN float share_of_area(Wide of_face, float of_whole, Bary3 at) {
  float weight = float(of_face.high) * 4294967296.0f + float(of_face.low);
  return (weight * of_whole) * uintBitsToFloat((127u - halvings_of(at)) << 23);
}

// By how much a cell keeps its face open: the face may be this much farther, at the cell, than it
// is known to reach.
VKH_FN float face_score(float highest, float reached, float tolerance, float within, float beyond) {
  float above = min((highest - reached) - tolerance, highest - within);
  return choose(reached > beyond, 0.0f, max(above, 0.0f));
}

// Whether the cell can be split into four at any edges: the middles of its edges, and of theirs,
// are dyadic points where all corners are multiples of four.
VKH_FN bool has_quarters(Bary3 t) {
  uvec2 any = uvec2(t.a.x | t.b.x | t.c.x, t.a.y | t.b.y | t.c.y);
  return ((any.x | any.y) & 3u) == 0u;
}

// The corners of half 0 or 1 of such a split among the six points.
VKH_FN uvec3 half_points(uint split, uint half_side) {
  return bisected(uvec3(0u, 1u, 2u), (split - 1u) % 3u, 3u, half_side);
}

// The bin of a score: eight an octave, larger ones for larger scores; 0 for none.
VKH_FN uint score_bin(float score) {
  uint bits = bits_of(score);
  return choose(score >= kLeastNormal, min(bits >> 20, kScoreBins - 1u), 0u);
}

// A cell that lies on one side of B hands that on to its parts.
VKH_FN uint class_of_parts(uint of_class) {
  return choose(of_class == kClassOver || of_class == kClassUnder, of_class, kClassUnseen);
}

// 1 over B, 2 under it, 0: no side is known.
VKH_FN uint side_index(uint of_class) { return choose(of_class > kClassUnder, 0u, of_class); }

VKH_FN bool is_among(uint of_class, uint classes) { return ((classes >> of_class) & 1u) != 0u; }

// The bounds as tallies and scores of normals take them: at a cell that was not compared nothing is
// known.
VKH_FN TallyBounds with_normals(TallyBounds b, CellAgreement found, uint of_class) {
  CellAgreement a = found;
  if (of_class != kClassCompared) {
    a.least = 0.0f;
    a.most = 1.0f;
    a.sure = 0.0f;
    a.may = 1.0f;
  }
  b.lower = vec3(a.least, a.least, a.least);
  b.mean_upper = a.most;
  b.square_upper = 1.0f;
  b.sure = a.sure;
  b.may = a.may;
  return b;
}

// The width of the mean of a distance of unknown sign, as it is where no side is known.
VKH_FN float either_width(TallyBounds b) { return 2.0f * b.mean_upper; }

// Keeps what a split leaves of a cell's bounds until its parts have theirs: an affine function
// has other values at a part's corners.
VKH_FN CellBounds bounds_of_parts(CellBounds b) {
  float lowest = lowest_of(b);
  b.lower_a = lowest;
  b.lower_b = lowest;
  b.lower_c = lowest;
  b.upper_a = b.highest;
  b.upper_b = b.highest;
  b.upper_c = b.highest;
  b.mean_upper = b.highest;
  b.square_upper = 3.0e38f;
  return b;
}

VKH_LIB_END
#endif
