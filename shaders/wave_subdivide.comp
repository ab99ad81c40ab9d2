// What: chooses each refined candidate's split and writes its new points as queries: three, or,
// where the wave splits twice, three of its own and three of each child (lib/generations.glsl).
// Midpoints, or double longest-edge bisection where the candidate is thin (paper.md §4.1); always 1
// -> 4. Candidates that there is no room to refine (lib/select.glsl) are copied to the next
// frontier. In: the frontier's reading half. Out: splits; points[points_each() i + k], started from
// the best triangle known to the candidate; deferred candidates and kMaxNext. A candidate that the
// risen lower bound closes, or that is too small to be decided, gets kSplitNone; its u is kept.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(constant_id = 0) const uint kSwitches = kUseAll;
layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 2) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 3) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 4) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 5) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 6) writeonly buffer Splits { Split splits[]; };
layout(scalar, binding = 7) writeonly buffer Points { Point points[]; };
layout(scalar, binding = 8) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 9) buffer Areas { Area areas[]; };
layout(scalar, binding = 10) readonly buffer Order { uint order[]; };
layout(scalar, binding = 11) buffer CentroidNearest { uint centroid_nearest[]; };

#include "shaders/lib/bvh.glsl"
#include "shaders/lib/candidate.glsl"
#include "shaders/lib/centroid.glsl"
#include "shaders/lib/coverage.glsl"
#include "shaders/lib/dispatch.glsl"
#include "shaders/lib/stream.glsl"

shared uint place_in_group[kGroupSize];
shared uint inner_in_group[kGroupSize];

uint centre;  // the triangle closest to the candidate's centroid, or kNone

// The code of the candidate's split; kSplitNone where the barycentric bits have run out.
uint choose_split(Bary3 at, Root root) {
  Corners t = plain_corners(root, at);
  if ((kSwitches & kUseThin) != 0u && quality(t) < kThinQuality) {
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

uint best_start(Candidate c, vec3 p) {
  if ((kSwitches & kUseWarmStart) == 0u) return kNone;
  Nearest best = nothing_near();
  for (uint k = 0u; k < 4u; ++k) {
    uint i = k < 3u ? c.nearest[k] : centre;
    if (i != kNone && i != best.triangle) try_triangle(p, i, best);
  }
  return best.triangle;
}

// New point k of a candidate at `at`: of its own split, or of the split of one of its children. A
// negative distance tells the query to skip the point.
void write_point(uint to, uint k, Candidate c, Bary3 at, Root root, uint split, uint group) {
  bool inner = kMaySplitTwice && k >= 3u && split != kSplitNone;
  if (inner) {
    uint which = k / 3u - 1u;  // uncertified: integers
    at = child_of(split_points(at, split), child_points(split, which));
    split = choose_split(at, root);
    if (k % 3u == 0u) atomicOr(inner_in_group[group], (split & kInnerNone) << (5u * which));
  }
  bool asked = split != kSplitNone;
  Bary6 six = split_points(at, asked ? split : kSplitMidpoint);
  Two3 p = place(root, corner_of(six.fresh, k % 3u));
  uint start = asked ? best_start(c, p.hi) : kNone;
  points[to] = Point(p.hi, start, p.lo, asked ? 0.0 : -1.0);
}

void write_points(uint i, uint lane, Candidate c, Bary3 at, Root root, uint split, uint group) {
  for (uint k = lane; k < points_each(); k += split_lanes())
    write_point(points_each() * i + k, k, c, at, root, split, group);
}

// Whether items are taken in the order of the sort. Then the wave's parents come first, and one
// kernel serves both ways to split: at most one subgroup has candidates of both. A second dispatch
// for the thin ones would cost 3.5 us a wave on an H200, and a count of them.
bool is_sorted() { return (kSwitches & kUseSort) != 0u && control.sorted != 0u; }

// Nothing may wait, and there is no room: the candidate is lost, but for its u.
void lose(bool held, Candidate c, float upper) {
  raise(kMaxSpilled, held ? upper : 0.0);
  close_area(held, c.root, unpack_corners(c.corners));
}

void defer(uint place, Candidate c, float upper) {
  c.upper = upper;
  frontier[writing(place)] = c;
  if (kKnowsCentroids) centroid_nearest[writing(place)] = centre;
}

// Where the candidate of an item, `c`, stands among the wave's parents; kNone if there is no room
// for it in this wave: then it is copied to the next frontier. Where none is deferred, items are
// parents.
uint place_of(uint item, bool held, Candidate c, float upper) {
  if (control.deferred == 0u) return held ? item : kNone;
  if ((kSwitches & kUseDefer) == 0u) {
    lose(held, c, upper);
    return kNone;
  }
  if (is_sorted()) {
    bool waits = held && item >= control.parents;
    raise(kMaxNext, waits ? upper : 0.0);
    if (waits) defer(item - control.parents, c, upper);
    return held && !waits ? item : kNone;
  }
  Key key = key_of(c, control.select_largest != 0u);
  bool refined = held && not_after(key, Key(control.select_key, control.select_tie));
  uint place = stream_append(kCountRefined, refined);
  refined = refined && place < control.parents;
  bool deferred = held && !refined;
  uint slot = stream_append(kCountDeferred, deferred);
  // There are as many places as the plan left: no bound rests on its selection.
  bool fits = slot < control.deferred;
  lose(deferred && !fits, c, upper);
  raise(kMaxNext, deferred && fits ? upper : 0.0);
  if (deferred && fits) defer(slot, c, upper);
  return refined ? place : kNone;
}

// Whether it is rounding that holds u up, so that no split helps: the candidate is tiny; or it lies
// on B, where 24-bit weights place feet no nearer than 2^-23 of a triangle, taken to be as large as
// A's.
bool is_noise(Bary3 corners, Root root, float upper) {
  Corners t = plain_corners(root, corners);
  float size2 = max(dot(t.b, t.b), dot(t.c, t.c));
  float root_size2 = max(dot(root.ab.hi, root.ab.hi), dot(root.ac.hi, root.ac.hi));
  float left = upper - uintBitsToFloat(control.maximum[kMaxLower]);
  float tiny = 0.0625 * effective_tolerance();
  return size2 < tiny * tiny ||
         (control.base == 0.0 && left * left <= 0.25 * kUlp * kUlp * root_size2);
}

// The same for all invocations of a candidate, which are `group` of the workgroup: the first asks.
uint shared_place_of(uint item, bool held, Candidate c, float upper, uint group) {
  bool first = item_index() % split_lanes() == 0u;
  uint i = place_of(item, held && first, c, upper);
  if (!kSpread && !kMaySplitTwice) return i;
  if (first) {
    place_in_group[group] = i;
    inner_in_group[group] = 0u;
  }
  barrier();
  return place_in_group[group];
}

void main() {
  uint item = item_index() / split_lanes();  // uncertified: integers
  uint lane = item_index() % split_lanes();
  uint group = gl_LocalInvocationID.x / split_lanes();  // uncertified: integers
  bool held = item < control.count[kCountFrontier];
  uint at = held ? item : 0u;
  if (held && is_sorted()) at = order[item];
  Candidate c = frontier[reading(at)];
  centre = nearest_to_centroid(reading(at));
  float upper = upper_of(c);
  uint i = shared_place_of(item, held, c, upper, group);
  bool mine = i != kNone;
  bool closed = mine && upper <= cull_threshold((kSwitches & kUseToleranceCull) != 0u);
  uint split = kSplitNone;
  bool first = mine && lane == 0u;
  if (mine) {
    Bary3 corners = unpack_corners(c.corners);
    Root root = load_root(c.root);
    if (!closed && !is_noise(corners, root, upper)) split = choose_split(corners, root);
    close_area(first && split == kSplitNone, c.root, corners);
    write_points(i, lane, c, corners, root, split, group);
  }
  if (kMaySplitTwice) barrier();
  if (first) splits[i] = Split(split, kMaySplitTwice ? inner_in_group[group] : 0u, at);
  bool ended = first && split == kSplitNone;
  count_culled(kCullLowerRaised, ended && closed);
  count_culled(kCullPrecision, ended && !closed);
  raise(kMaxDropped, ended ? upper : 0.0);
}
