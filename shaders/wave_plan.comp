// What: everything that a wave decides as a whole: adopts the last wave's witness, flips
// the frontier's halves, moves the base of distances, tests for the end, shares the room out
// between refined, deferred and newly admitted candidates, selects which ones are refined, writes
// the sizes of the wave's first half. One workgroup, of which one invocation plans. After the end
// it writes zeros, so that recorded waves cost empty dispatches only. Invariant: deferred + 4
// parents + roots <= capacity, or 16 parents where they are split twice, and their new points fit
// the stream of points; so no stream of the wave can overflow.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"

layout(constant_id = 0) const uint kSwitches = kUseAll;
layout(local_size_x = kPlanGroup) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) writeonly buffer Dispatches { Dispatch dispatches[]; };
layout(scalar, binding = 2) readonly buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 3) readonly buffer Splits { Split splits[]; };
layout(scalar, binding = 4) readonly buffer Points { Point points[]; };
layout(scalar, binding = 5) readonly buffer Survivors { uint survivors[]; };
layout(scalar, binding = 6) readonly buffer Centroids { Point centroids[]; };
layout(scalar, binding = 7) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 8) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 9) readonly buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 10) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 11) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 12) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };

#include "shaders/lib/bvh.glsl"
#include "shaders/lib/candidate.glsl"
#include "shaders/lib/child.glsl"
#include "shaders/lib/dispatch.glsl"
#include "shaders/lib/schedule.glsl"
#include "shaders/lib/select.glsl"
#include "shaders/lib/witness.glsl"

const uint kAdoptGroup = kPlanGroup;
#include "shaders/lib/adopt.glsl"

bool base_moved = false;  // in this wave; of the invocation that plans

// Adds what the wave before this one did to the totals.
void close_wave() {
  if (control.wave == 0u) return;  // it was left to this plan
  uint w = (control.wave - 1u) % kMaxWaveRecords;
  uint candidates = child_count();
  uint queries = query_count();
  float upper = uintBitsToFloat(max(control.maximum[kMaxNext],
                                    max(control.maximum[kMaxDropped], control.maximum[kMaxLower])));
  control.waves[w] = WaveRecord(
      control.parents, candidates, queries, control.count[kCountSurvivors], control.deferred,
      control.base + uintBitsToFloat(control.maximum[kMaxLower]), control.base + upper);
  control.candidate_total += candidates;
  control.query_total += queries;
}

void flip() {
  control.parity = 1u - control.parity;
  control.count[kCountFrontier] = control.count[kCountNext];
  control.count[kCountNext] = 0u;
  control.count[kCountSurvivors] = 0u;
  control.maximum[kMaxFrontier] = control.maximum[kMaxNext];
  control.maximum[kMaxNext] = 0u;
  control.peak_frontier = max(control.peak_frontier, control.count[kCountFrontier]);
}

void rebase_maximum(uint which) {
  control.maximum[which] = floatBitsToUint(rebased(uintBitsToFloat(control.maximum[which])));
}

// Here where a wave is a chain of steps, and a dispatch is one more. Elsewhere `query` does it,
// which has the code for it: pipelines are created at every start of a program.
void measure_witness() {
  Witness w = control.witness;
  Two3 p = place(load_root(w.root), uvec2(w.j, w.k));
  Query q = Query(p, control.base, true);
  Nearest found = measured(q, nearest_triangle(q, w.nearest), -1.0);
  control.witness.nearest = found.triangle;
  control.witness.distance = max(found.above, 0.0);
  control.maximum[kMaxLower] = floatBitsToUint(control.witness.distance);
}

// The lower bound has risen so far above the base that an ulp of what it is above it matters: moves
// the base up to it, and everything kept above the old one with it. The witness is to be measured
// again. The frontier is moved as it is read in this wave.
void move_base() {
  control.rebase_hi = 0.0;
  control.rebase_lo = 0.0;
  float above = uintBitsToFloat(control.maximum[kMaxLower]);
  if (!needs_sharp(above)) return;
  float from = control.base;
  control.base = from + base_under(above);
  Two by = two_sum(from, -control.base);
  control.rebase_hi = by.hi;
  control.rebase_lo = by.lo;
  control.tight = 1u;
  rebase_maximum(kMaxFrontier);
  rebase_maximum(kMaxDropped);
  rebase_maximum(kMaxSpilled);
  base_moved = true;
  control.maximum[kMaxLower] = 0u;
  control.witness.distance = 3.0e38;
  if (kSpread) measure_witness();
}

// A refined candidate leaves at most four where it was one. While more than the reserve is free, as
// many are refined as surely fit; else one alone, whose descendants fit the reserve (kReserve), so
// that the run always goes on.
void share_room() {
  uint held = control.count[kCountFrontier];
  uint capacity = control.capacity;
  uint room = capacity - held;
  uint parents =
      min(held, room > kReserve + 3u ? (room - kReserve) / 3u : 1u);  // uncertified: integers
  control.parents = parents;
  control.deferred = held - parents;
  held = schedule(held, room);
  parents = control.parents;
  room = capacity - held;
  bool twice = control.deferred == 0u && may_split_twice(parents, room);
  control.twice = twice ? 1u : 0u;
  uint needed = (twice ? 15u : 3u) * parents;  // places besides the candidates' own
  uint roots = roots_to_admit(held, room - needed);
  control.roots = roots;
  control.root_cursor += roots;
}

// All that is left is within the tolerance: what culling would find out with one more wave.
bool within_tolerance() {
  return control.root_cursor == control.face_count && control.count[kCountFrontier] > 0u &&
         uintBitsToFloat(control.maximum[kMaxFrontier]) <= cull_threshold(true);
}

void end_if_done() {
  if (within_tolerance() && control.roots == 0u) {
    control.maximum[kMaxDropped] = max(control.maximum[kMaxDropped], control.maximum[kMaxFrontier]);
    control.status = status_decided();
    return;
  }
  if (control.parents + control.roots > 0u) return;
  if (control.count[kCountFrontier] > 0u) {
    control.maximum[kMaxSpilled] = max(control.maximum[kMaxSpilled], control.maximum[kMaxFrontier]);
    control.status = kStatusMemory;
  } else {
    control.status = status_decided();
  }
}

void write_sizes() {
  bool running = control.status == kStatusRunning;
  uint parents = running ? control.parents : 0u;
  uint held = running ? parents + control.deferred : 0u;
  dispatches[kDispatchSubdivide] = groups_for(held * split_lanes());
  dispatches[kDispatchWitness] = groups_of(base_moved && !kSpread ? 1u : 0u);
  write_query_sizes(parents);
  write_sort_sizes(running ? control.count[kCountFrontier] : 0u);
  uint children = running ? child_count() : 0u;
  dispatches[kDispatchFilter] = groups_for(children);
  dispatches[kDispatchBound] = groups_for_children(children);
  if (!running) return;
  control.count[kCountNext] = may_wait() ? control.deferred : 0u;
  control.count[kCountRefined] = 0u;
  control.count[kCountDeferred] = 0u;
  control.wave += 1u;
}

void plan() {
  if (control.status == kStatusRunning) {
    close_wave();
    flip();
    move_base();
    share_room();
    end_if_done();
  }
  bool short_room = control.status == kStatusRunning && control.deferred > 0u && may_wait();
  held_in_short_room = short_room ? control.count[kCountFrontier] : 0u;
  read_from = reading(0u);
  room_for = control.parents;
  largest_first = control.select_largest != 0u;
}

void main() {
  bool first = gl_LocalInvocationID.x == 0u;
  adopt_witness();
  if (first) plan();
  barrier();
  if (held_in_short_room > 0u) select_smallest(held_in_short_room);
  if (first) write_sizes();
}
