// What: the cascade over every child of the wave, or, where centroids are queried, its hard half
// over those past wave_filter: exact case, u1, u2, ha, u3 over every pair of known triangles, u4.
// What is still open enters the next frontier. In: the refined candidates, their splits and queried
// points; the admitted faces of A; survivors and centroids. Out: frontier's writing half; every
// closed child's u is kept (kMaxDropped), every open one's too (kMaxNext); samples are offered as
// witnesses.
//
// A workgroup bounds `children` of them together: an invocation loads one of them and has its last
// word, all share out the distances, three a known triangle, and then the pairs of triangles. So a
// wave of few children is as long as its longest step, not as their sum.
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
layout(scalar, binding = 4) readonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 5) readonly buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 6) readonly buffer Splits { Split splits[]; };
layout(scalar, binding = 7) readonly buffer Points { Point points[]; };
layout(scalar, binding = 8) readonly buffer Survivors { uint survivors[]; };
layout(scalar, binding = 9) readonly buffer Centroids { Point centroids[]; };
layout(scalar, binding = 10) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 11) buffer Areas { Area areas[]; };
layout(scalar, binding = 12) readonly buffer FaceShared { uint face_shared[]; };

#include "shaders/lib/surface.glsl"
#include "shaders/lib/candidate.glsl"
#include "shaders/lib/child.glsl"
#include "shaders/lib/coverage.glsl"
#include "shaders/lib/dispatch.glsl"
#include "shaders/lib/stream.glsl"
#include "shaders/lib/witness.glsl"
#include "shaders/lib/bound_u4.glsl"

const bool kAsksCentroids = (kSwitches & kUseCentroid) != 0u;

// A child as all invocations of the workgroup need it.
struct Held {
  Two3 b, c;  // corners around the first
  Two3 origin;
  float reach, slack;
  float upper;  // u so far
};

shared Held held[kGroupSize];
shared uint known_triangle[kGroupSize * kMaxKnown];
shared uint known_count[kGroupSize];
shared float corner_distance[kGroupSize * kMaxKnown * 3u];
shared uint upper_bits[kGroupSize];
shared uint most_known;
shared uint open_child[kGroupSize];  // children that pairs are tried for
shared uint open_count;

struct Verdict {
  float upper;
  uint by;  // kCull*
};

View view_of_child(uint child) {
  Placement p;
  p.origin = held[child].origin;
  p.reach = held[child].reach;
  return view_of(p, (kSwitches & kUseCertificate) == 0u);
}

Patch patch_of_child(uint child) {
  return make_patch(two(vec3(0.0)), held[child].b, held[child].c);
}

vec3 distances_of(uint child, uint k) {
  uint at = 3u * (child * kMaxKnown + k);
  return vec3(corner_distance[at], corner_distance[at + 1u], corner_distance[at + 2u]);
}

void hold(uint child, Child c, uint code, uint centre) {
  Placement placed = place_corners(load_root(c.root), c.at);
  held[child] = Held(placed.b, placed.c, placed.origin, placed.reach, placed.slack, c.upper);
  Known known;
  known.count = 0u;
  know(known, centre);
  know(known, c.nearest.x);
  know(known, c.nearest.y);
  know(known, c.nearest.z);
  if ((kSwitches & kUseParentSamples) != 0u) know_parent_samples(code, known);
  for (uint k = 0u; k < known.count; ++k) known_triangle[child * kMaxKnown + k] = known.triangle[k];
  known_count[child] = known.count;
  atomicMax(most_known, known.count);
}

// Every corner of every child against every triangle known to it.
void measure_corners(uint children) {
  uint stride = 3u * most_known;
  for (uint n = gl_LocalInvocationID.x; n < children * stride; n += kGroupSize) {
    uint child = n / stride;             // uncertified: integers
    uint k = (n - child * stride) / 3u;  // uncertified: integers
    if (k >= known_count[child]) continue;
    uint corner = n % 3u;
    Two3 p = corner == 0u ? two(vec3(0.0)) : corner == 1u ? held[child].b : held[child].c;
    Surface s = load_surface(known_triangle[child * kMaxKnown + k], view_of_child(child));
    corner_distance[3u * (child * kMaxKnown + k) + corner] = surface_distance_up(p, s);
  }
}

// What single triangles give: u1, u2 and ha, and the exact case, ha of the only one.
Verdict bound_singly(uint child, float threshold) {
  Patch t = patch_of_child(child);
  float shift = held[child].slack;
  vec3 own = vec3(3.0e38);
  float ha = 3.0e38;
  for (uint k = 0u; k < known_count[child]; ++k) {
    vec3 d = distances_of(child, k);
    own = min(own, d);
    ha = min(ha, kept_bound(bound_single(d), shift));
  }
  float u1 = kept_bound(bound_u1(t, own), shift);
  float u2 = kept_bound(bound_u2(t, own), shift);
  uint by = known_count[child] == 1u ? kCullExact
            : u1 <= threshold        ? kCullU1
            : u2 <= threshold        ? kCullU2
            : ha <= threshold        ? kCullHa
                                     : kCullLowerRaised;
  return Verdict(min(held[child].upper, min(ha, min(u1, u2))), by);
}

// u3 for the pairs of open children. A pair cannot beat the better of its two distances at the
// worst corner, so most cost three minima. What is tried does not depend on what others found:
// the bound would depend on their order.
void bound_pairs() {
  uint stride = most_known * (most_known - 1u) / 2u;  // uncertified: integers
  for (uint n = gl_LocalInvocationID.x; n < open_count * stride; n += kGroupSize) {
    uint child = open_child[n / stride];  // uncertified: integers
    uint i = 1u;
    uint j = n % stride;
    for (; j >= i; ++i) j -= i;
    if (i >= known_count[child]) continue;
    vec3 di = distances_of(child, i);
    vec3 dj = distances_of(child, j);
    float shift = held[child].slack;
    if (max3(min(di, dj)) + shift >= held[child].upper) continue;
    View view = view_of_child(child);
    Surface s = load_surface(known_triangle[child * kMaxKnown + i], view);
    Surface r = load_surface(known_triangle[child * kMaxKnown + j], view);
    float u3 = kept_bound(bound_pair(patch_of_child(child), s, di, r, dj), shift);
    atomicMin(upper_bits[child], floatBitsToUint(u3));
  }
}

Verdict last_word(uint child, Child c, Verdict v, float threshold) {
  float u3 = uintBitsToFloat(upper_bits[child]);
  if (u3 < v.upper) v = Verdict(u3, kCullU3);
  if ((kSwitches & kUseU4) == 0u) return v;
  if (v.upper > threshold) {
    float u4 = bound_u4(patch_of_child(child), c.nearest, view_of_child(child), held[child].slack);
    if (u4 < v.upper) v = Verdict(u4, kCullU4);
  }
  return v;
}

uint child_total() {
  return kAsksCentroids ? control.count[kCountSurvivors] : 4u * control.parents + control.roots;
}

// The child's code; kNone where its parent was not split.
uint code_of(uint i) {
  if (kAsksCentroids) return survivors[i];
  return is_root(i) || splits[i >> 2].code != kSplitNone ? i : kNone;
}

uint centre_of(uint i) {
  if (!kAsksCentroids || centroids[i].distance < 0.0) return kNone;
  return centroids[i].nearest;
}

void offer(uint i, uint code) {
  if (kAsksCentroids) {
    offer_sample(i | kCentroidSample);
  } else {
    offer_point(code);
  }
}

void write(bool mine, Child c, uint centre, Verdict v, float threshold) {
  bool closed = mine && v.upper <= threshold;
  bool open = mine && !closed;
  if (mine) close_area(closed, c.root, c.at);
  for (uint why = kCullExact; why <= kCullLowerRaised; ++why)
    count_culled(why, closed && v.by == why);
  raise(kMaxDropped, closed ? v.upper : 0.0);
  raise(kMaxNext, open ? v.upper : 0.0);
  uint slot = stream_append(kCountNext, open);
  if (open)
    frontier[writing(slot)] = Candidate(pack_corners(c.at), c.root, c.nearest, centre, v.upper);
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint total = child_total();
  uint children = children_a_group(total, (kSwitches & kUseGroupWalk) != 0u);
  uint i = workgroup_index() * children + lane;
  float threshold = cull_threshold((kSwitches & kUseToleranceCull) != 0u);
  if (lane == 0u) {
    most_known = 0u;
    open_count = 0u;
  }
  barrier();
  uint code = lane < children && i < total ? code_of(i) : kNone;
  bool mine = code != kNone;
  bool shared_face = false;
  Child c;
  uint centre = kNone;
  known_count[lane] = 0u;
  if (mine) {
    offer(i, code);
    c = load_child(code);
    centre = centre_of(i);
    shared_face = is_root(code) && face_shared[c.root] != 0u;
    if (!shared_face) hold(lane, c, code, centre);
  }
  barrier();
  measure_corners(children);
  barrier();
  Verdict v = Verdict(0.0, kCullExact);
  if (mine && !shared_face) {
    v = bound_singly(lane, threshold);
    held[lane].upper = v.upper;
    upper_bits[lane] = floatBitsToUint(v.upper);
    if (v.upper > threshold && known_count[lane] > 1u) open_child[atomicAdd(open_count, 1u)] = lane;
  }
  barrier();
  if ((kSwitches & kUsePairs) != 0u) bound_pairs();
  barrier();
  if (mine && !shared_face) v = last_word(lane, c, v, threshold);
  write(mine, c, centre, v, threshold);
}
