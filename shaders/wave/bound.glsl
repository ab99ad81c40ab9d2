// The cascade over every child of the wave or, if there is a filter, its expensive half over the
// children that the filter leaves: exact case, u1, u2, ha, u3 over every pair of known triangles.
// Shared by wave_bound and paper_bound, which has more bounds. Children that are still open enter
// the next frontier. A workgroup bounds some children together (wave/bound_group.glsl): an
// invocation loads one of them and decides on it at the end; all share out the distances and then
// the cuts of pairs. So a wave of few children is as long as its longest step, not as their sum.
// The kernel declares the buffers of wave_bound.
#ifndef VKH_SHADERS_WAVE_BOUND_GLSL
#define VKH_SHADERS_WAVE_BOUND_GLSL

#include "shaders/base/coverage.glsl"
#include "shaders/base/invocation.glsl"
#include "shaders/base/stream.glsl"
#include "shaders/wave/candidate.glsl"
#include "shaders/wave/centroid.glsl"
#include "shaders/wave/child.glsl"
#include "shaders/wave/dispatch.glsl"
#include "shaders/wave/bound_group.glsl"
#include "shaders/wave/bound_tally.glsl"
#include "shaders/wave/witness.glsl"

// The kernel's further bounds: none in wave_bound; the paper's u3, and u4, in paper_bound.
Verdict bound_besides(uint i, uint child, Child c, Verdict v, float threshold);

// Plain floats are used if their slack is at most this part of the tolerance: they are quicker,
// and close a candidate unless it is as close to the threshold as that. The CPU profile does not
// use them: a CPU goes through both kinds wherever a few invocations of a subgroup have one of them
// each.
const float kEnough = 0.25;

uint child_total() { return is_filtered() ? control.count[kCountSurvivors] : child_count(); }

// Returns the code of the wave's child i, or of survivor i if there is a filter; kNone if i names
// no child (see is_child).
uint code_of(uint i) {
  if (is_filtered()) return survivors[i];
  return is_child(i) ? i : kNone;
}

uint centre_of(uint i) {
  if (!is_filtered() || centroids[i].distance < 0.0) return kNone;
  return centroids[i].nearest;
}

// Whether both kinds of split are sure to find their points: two halvings of every coordinate.
bool has_bits_to_split(Bary3 t) {
  uvec2 any = t.a | t.b | t.c;
  return ((any.x | any.y) & 3u) == 0u;
}

// The same candidate, as a root of its own if its bits run out and there is room.
Candidate with_bits(Candidate c, Bary3 t) {
  if (!has_subroots() || is_subroot(c.root) || has_bits_to_split(t)) return c;
  uint i = atomicAdd(control.subroots, 1u);
  if (i >= most_subroots()) return c;
  frontier[subroot_place(i)] = c;
  close_area(true, c.root, t);
  return Candidate(pack_corners(whole_root()), control.face_count + i, c.nearest, c.upper);
}

void close_or_keep(bool mine, Child c, uint centroid_triangle, Verdict v, float threshold) {
  bool closed = mine && v.upper <= threshold;
  bool open = mine && !closed;
  if (mine) close_area(closed, c.root, c.at);
  uint slot = count_and_place(closed, open, v);
  if (!open) return;
  Candidate left = Candidate(pack_corners(c.at), c.root, c.nearest, v.upper);
  frontier[writing(slot)] = with_bits(left, c.at);
  keep_nearest_to_centroid(writing(slot), centroid_triangle);
}

void bound_children() {
  uint lane = gl_LocalInvocationID.x;
  uint total = child_total();
  uint children = children_a_group(total);
  bool fine = children < kMostChildren;
  uint i = workgroup_index() * children + lane;
  bool tolerant = (kSwitches & kUseToleranceCull) != 0u;
  float threshold = cull_threshold(lower_with_this_wave(), tolerant);
  float enough = kWide && tolerant ? kEnough * effective_tolerance(lower_with_this_wave()) : 0.0;
  begin_group();
  offer_samples();
  uint code = kNone;
  if (lane < children && i < total) code = code_of(i);
  bool mine = code != kNone;
  bool bounded = false;
  Child c;
  uint centroid_triangle = kNone;
  if (mine) {
    c.root = root_of(code);
    c.at = whole_root();
    bounded = !(is_root(code) && face_shared[c.root] != 0u);
  }
  if (bounded) {
    c = load_child(code);
    centroid_triangle = centre_of(i);
    add_known(lane, centroid_triangle);
    add_known_corners(lane, c);
    add_parent_samples(lane, code);
    hold(lane, c);
  }
  barrier();
  measure_corners(fine, enough);
  barrier();
  Verdict v = Verdict(0.0, kCullExact);
  if (bounded) {
    v = bound_singly(lane, threshold);
    if ((kSwitches & kUsePairs) != 0u && v.upper > threshold) list_pairs(lane, v.upper, fine);
  }
  barrier();
  measure_cuts(fine, enough);
  barrier();
  if (kWide) {
    begin_tally();
    if (fine) join_cuts();
    barrier();
  }
  if (bounded) v = bound_besides(i, lane, c, bound_in_pairs(lane, v), threshold);
  close_or_keep(mine, c, centroid_triangle, v, threshold);
}

#endif
