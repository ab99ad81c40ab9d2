// A wave's first step, over the frontier: it decides which candidates are refined, how each is
// split, and its new points: three, or, if the wave splits twice, three of its own and three of
// each child (wave/split_counts.glsl). A split is by midpoints, or by double longest-edge
// bisection if the candidate is thin (docs/method.md, section 4); always 1 -> 4. Candidates without
// room to be refined (wave/select.glsl) are copied to the next frontier. A candidate that
// the risen lower bound closes, or that is too small to be decided, gets kSplitNone; its u is kept.
// A workgroup has kGroupSize invocations, and refines as many candidates at most. The kernel
// declares `frontier`, `splits`, `areas`, what traversal/traversal.glsl and wave/candidate.glsl
// need, wave/centroid.glsl or no_centroid.glsl, and wave/unsorted.glsl or paper/sorted.glsl.
#ifndef VKH_SHADERS_WAVE_SPLIT_GLSL
#define VKH_SHADERS_WAVE_SPLIT_GLSL

#include "shaders/base/coverage.glsl"
#include "shaders/base/stream.glsl"
#include "shaders/wave/candidate.glsl"
#include "shaders/wave/dispatch.glsl"
#include "shaders/traversal/traversal.glsl"

shared uint slot_in_group[kGroupSize];
shared uint child_splits_in_group[kGroupSize];

// An invocation's knowledge of its candidate.
struct Refined {
  uint from;   // its slot in the half of the frontier being read
  uint slot;   // place among the wave's parents; kNone: it is none of them
  uint split;  // math/dyadic.h; kSplitNone where it ends here
  bool closed;
  float upper;
  uint centroid_triangle;  // the triangle closest to its centroid, or kNone
  Candidate c;
  Bary3 at;
  Root root;
};

// The code of the candidate's split; kSplitNone if the barycentric bits have run out.
uint choose_split(Bary3 at, Root root) {
  Corners t = plain_corners(root, at);
  if ((kSwitches & kUseThin) != 0u && quality(t) < kThin) {
    uint x = opposite_longest(t);
    Bary6 first = split_points(at, bisection_code(x, 0u, 0u));
    uvec3 all = uvec3(0u, 1u, 2u);
    uint y = opposite_longest(plain_corners(root, child_of(first, bisected(all, x, 3u, 0u))));
    uint z = opposite_longest(plain_corners(root, child_of(first, bisected(all, x, 3u, 1u))));
    uint code = bisection_code(x, y, z);
    if (can_split(at, code)) return code;
  }
  return can_split(at, kSplitMidpoint) ? kSplitMidpoint : kSplitNone;
}

uint best_start(Refined r, vec3 p) {
  if ((kSwitches & kUseWarmStart) == 0u) return kNone;
  Nearest best = nothing_near();
  for (uint k = 0u; k < 4u; ++k) {
    uint i = k < 3u ? r.c.nearest[k] : r.centroid_triangle;
    if (i != kNone && i != best.triangle) try_triangle(p, i, best);
  }
  return best.triangle;
}

// A new point as a query: its position, the triangle to start from, and whether it is one.
struct NewPoint {
  Two3 p;
  uint start;
  bool asked;
};

// New point k, of the candidate's own split or of the split of one of its children, which goes to
// the `group` of the workgroup that belongs to the candidate.
NewPoint new_point(uint k, Refined r, uint group) {
  uint split = r.split;
  bool of_child = kMaySplitTwice && k >= 3u && split != kSplitNone;
  if (of_child) {
    uint which = k / 3u - 1u;
    r.at = child_of(split_points(r.at, split), child_points(split, which));
    split = choose_split(r.at, r.root);
    if (k % 3u == 0u)
      atomicOr(child_splits_in_group[group], (split & kChildSplitNone) << (5u * which));
  }
  bool asked = split != kSplitNone;
  Bary6 six = split_points(r.at, asked ? split : kSplitMidpoint);
  Two3 p = position_of(r.root, corner_of(six.fresh, k % 3u));
  return NewPoint(p, asked ? best_start(r, p.hi) : kNone, asked);
}

// Spills a candidate, and keeps its u: there is no room, and nothing may wait.
void spill(bool held, Candidate c, float upper) {
  raise(kMaxSpilled, held ? upper : 0.0);
  close_area(held, c.root, unpack_corners(c.corners));
}

void defer(uint slot, Refined r) {
  r.c.upper = r.upper;
  frontier[writing(slot)] = r.c;
  keep_nearest_to_centroid(writing(slot), r.centroid_triangle);
}

// The place of an item's candidate among the wave's parents; kNone if there is no room for it in
// this wave: then it is copied to the next frontier. If none is deferred, items are parents.
uint slot_of(uint item, bool held, Refined r) {
  if (control.deferred == 0u) return held ? item : kNone;
  if ((kSwitches & kUseDefer) == 0u) {
    spill(held, r.c, r.upper);
    return kNone;
  }
  if (is_sorted()) {
    bool waits = held && item >= control.parents;
    raise(kMaxNext, waits ? r.upper : 0.0);
    if (waits) defer(item - control.parents, r);
    return held && !waits ? item : kNone;
  }
  Key key = key_of(r.c, control.select_largest != 0u);
  bool refined = held && not_after(key, Key(control.select_key, control.select_tie));
  uint parent = stream_append(kCountRefined, refined);
  refined = refined && parent < control.parents;
  bool deferred = held && !refined;
  uint slot = stream_append(kCountDeferred, deferred);
  // There are as many slots as the plan left: no bound rests on its selection.
  bool fits = slot < control.deferred;
  spill(deferred && !fits, r.c, r.upper);
  raise(kMaxNext, deferred && fits ? r.upper : 0.0);
  if (deferred && fits) defer(slot, r);
  return refined ? parent : kNone;
}

// The result is the same for all invocations of a candidate: the first of them reserves it.
uint shared_slot_of(uint item, bool held, bool first, Refined r, uint group) {
  uint i = slot_of(item, held && first, r);
  if (!kWide && !kMaySplitTwice) return i;
  if (first) {
    slot_in_group[group] = i;
    child_splits_in_group[group] = 0u;
  }
  barrier();
  return slot_in_group[group];
}

// Whether rounding holds u up, so that no split helps: the candidate is tiny; or it lies on B in a
// run that is not fine (math/triangle.h), where float32 barycentrics, of 24 bits, place closest
// points no nearer than 2^-23 of a triangle, taken to be as large as A's.
bool is_noise(Bary3 corners, Root root, float upper) {
  Corners t = plain_corners(root, corners);
  float size2 = max(dot3(t.b, t.b), dot3(t.c, t.c));
  float tiny = 0.0625 * effective_tolerance(adopted_lower());
  if (size2 < tiny * tiny) return true;
  float root_size2 = max(dot3(root.ab.hi, root.ab.hi), dot3(root.ac.hi, root.ac.hi));
  float left = upper - adopted_lower();
  return !has_subroots() && control.base == 0.0 && left * left <= 0.25 * kUlp * kUlp * root_size2;
}

// Whether to end a candidate that the switches would not close. Without kUseToleranceCull, a part
// of A that is as far as the best sample, such as one above a parallel face, never falls under it
// except by rounding: all of its children would be split until their bits run out, 4^20 of them,
// while the candidates that keep the interval wide wait for room. So a candidate within half of the
// tolerance ends. The roundings of u and of the sample are less: a twentieth for lengths in plain
// floats (needs_sharp), an eighth for positions in them (host/solve/pair.cpp), or else under the
// tolerance's floor. It only steers.
bool is_level(float upper, bool tolerant) {
  float lower = adopted_lower();
  return !tolerant && upper <= lower_to_beat(lower) + 0.5 * effective_tolerance(lower);
}

// Called by every invocation of the workgroup, the first of a candidate's among them once.
Refined refine(uint item, bool first, uint group) {
  Refined r;
  bool held = item < control.count[kCountFrontier];
  r.from = held ? slot_of_item(item) : 0u;
  r.c = frontier[reading(r.from)];
  r.centroid_triangle = nearest_to_centroid(reading(r.from));
  r.upper = upper_of(r.c);
  r.slot = shared_slot_of(item, held, first, r, group);
  bool tolerant = (kSwitches & kUseToleranceCull) != 0u;
  r.closed = r.upper <= cull_threshold(adopted_lower(), tolerant) || is_level(r.upper, tolerant);
  r.split = kSplitNone;
  if (r.slot != kNone) {
    r.at = unpack_corners(r.c.corners);
    r.root = root_at(r.c.root);
    if (!r.closed && !is_noise(r.at, r.root, r.upper)) r.split = choose_split(r.at, r.root);
  }
  return r;
}

// Stores the candidate's outcome, once its new points are written. Called by every invocation;
// `first`: the candidate's first one.
void keep_split(Refined r, bool first, uint group) {
  if (kMaySplitTwice) barrier();
  bool mine = first && r.slot != kNone;
  if (mine)
    splits[r.slot] = Split(r.split, kMaySplitTwice ? child_splits_in_group[group] : 0u, r.from);
  bool ended = mine && r.split == kSplitNone;
  if (ended) close_area(true, r.c.root, r.at);
  count_culled(kCullLowerRaised, ended && r.closed);
  count_culled(kCullPrecision, ended && !r.closed);
  raise(kMaxClosed, ended ? r.upper : 0.0);
}

#endif
