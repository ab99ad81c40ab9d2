// What: the cascade over every child of the wave, or, where there is a filter, its hard half
// over those past it: exact case, u1, u2, ha, u3 over every pair of known triangles, u4.
// What is still open enters the next frontier. In: the refined candidates, their splits and queried
// points; the admitted faces of A; survivors and centroids. Out: frontier's writing half; every
// closed child's u is kept (kMaxDropped), every open one's too (kMaxNext); samples are offered as
// witnesses. Where kFused, the last workgroup to end plans the next wave (plan/plan.glsl):
// control; dispatches.
//
// A workgroup bounds some children together (wave/bound_group.glsl): an invocation loads one of
// them and has its last word; all share out the distances and then the cuts of pairs. So a wave of
// few children is as long as its longest step, not as their sum.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/gpu_types.h"

layout(constant_id = 0) const uint kSwitches = kUseAll;
layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) coherent buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 2) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 3) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 4) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 5) readonly buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 6) readonly buffer Splits { Split splits[]; };
layout(scalar, binding = 7) readonly buffer Points { Point points[]; };
layout(scalar, binding = 8) readonly buffer Survivors { uint survivors[]; };
layout(scalar, binding = 9) readonly buffer Centroids { Point centroids[]; };
layout(scalar, binding = 10) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 11) buffer Areas { Area areas[]; };
layout(scalar, binding = 12) readonly buffer FaceShared { uint face_shared[]; };
layout(scalar, binding = 13) readonly buffer U3Bounds { float u3_bounds[]; };
layout(scalar, binding = 14) buffer CentroidNearest { uint centroid_nearest[]; };
layout(scalar, binding = 15) writeonly buffer Dispatches { Dispatch dispatches[]; };

#include "shaders/base/surface.glsl"
#include "shaders/candidate/candidate.glsl"
#include "shaders/candidate/centroid.glsl"
#include "shaders/candidate/child.glsl"
#include "shaders/base/coverage.glsl"
#include "shaders/candidate/dispatch.glsl"
#include "shaders/base/stream.glsl"
#include "shaders/wave/witness.glsl"
#include "shaders/wave/bound_group.glsl"
#include "shaders/wave/bound_tally.glsl"
#include "shaders/paper/bound_u4.glsl"
#define groups_done control.groups_done  // not a binding more: devices have 16
#include "shaders/base/last_group.glsl"
#include "shaders/paper/schedule.glsl"

// Nobody reads the corners' distances after the cuts, and shared memory is scarce. At least 576
// words; kPlanWords is 272.
#define plan_words corner_bits
#include "shaders/plan/plan.glsl"

// Whether wave_filter has gone over the children.
const bool kFiltered = (kSwitches & kUseFilter) != 0u;

// By what kernels of their own found, and by points.
Verdict bound_besides(uint i, uint child, Child c, Verdict v, float threshold) {
  if ((kSwitches & kUsePaperU3) != 0u && u3_bounds[i] < v.upper) v = Verdict(u3_bounds[i], kCullU3);
  if ((kSwitches & kUseU4) == 0u) return v;  // alone: optimisers then leave all of it out
  if (v.upper <= threshold) return v;
  float u4 =
      bound_u4(patch_of_child(child), c.nearest, view_of_child(child), held[kHeldSlack][child]);
  if (u4 < v.upper) v = Verdict(u4, kCullU4);
  return v;
}

// Of the tolerance, the slack that plain floats may have: they are quicker, and a candidate is
// closed by them all the same, unless it is as close to the threshold as that. Not on CPU devices,
// which go through both kinds wherever a few invocations of a subgroup have one of them each.
const float kEnough = 0.25;

uint child_total() { return kFiltered ? control.count[kCountSurvivors] : child_count(); }

// The child's code; kNone where its parent was not split.
uint code_of(uint i) {
  if (kFiltered) return survivors[i];
  return is_child(i) ? i : kNone;
}

uint centre_of(uint i) {
  if (!kFiltered || centroids[i].distance < 0.0) return kNone;
  return centroids[i].nearest;
}

void write(bool mine, Child c, uint centre, Verdict v, float threshold) {
  bool closed = mine && v.upper <= threshold;
  bool open = mine && !closed;
  if (mine) close_area(closed, c.root, c.at);
  uint slot = give(closed, open, v);
  if (!open) return;
  frontier[writing(slot)] = Candidate(pack_corners(c.at), c.root, c.nearest, v.upper);
  if (kKnowsCentroids) centroid_nearest[writing(slot)] = centre;
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint total = child_total();
  uint children = children_a_group(total);
  bool fine = children < kMostChildren;
  uint i = workgroup_index() * children + lane;
  bool tolerant = (kSwitches & kUseToleranceCull) != 0u;
  float threshold = cull_threshold(raised_lower(), tolerant);
  float enough = kSpread && tolerant ? kEnough * effective_tolerance(raised_lower()) : 0.0;
  begin_group();
  offer_samples();
  uint code = kNone;
  if (lane < children && i < total) code = code_of(i);
  bool mine = code != kNone;
  bool bounded = false;
  Child c;
  uint centre = kNone;
  if (mine) {
    c.root = root_of(code);
    c.at = whole_root();
    bounded = !(is_root(code) && face_shared[c.root] != 0u);
  }
  if (bounded) {
    c = load_child(code);
    centre = centre_of(i);
    know(lane, centre);
    know_corners(lane, c);
    know_parent_samples(lane, code);
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
  if (kSpread) {
    begin_tally();
    if (fine) join_cuts();
    barrier();
  }
  if (bounded) v = bound_besides(i, lane, c, bound_in_pairs(lane, v), threshold);
  write(mine, c, centre, v, threshold);
  if (kFused && is_last_group()) plan_wave();
}
