// What: the hard half of the cascade, over the wave's survivors: ha with the centroid's triangle,
// u3 over every pair of known triangles, u4; what is still open enters the next frontier. Culls
// against the newest lower bound. In: survivors, centroids (queried). Out: frontier's writing half.
// Every closed child's u is kept (kMaxDropped), every open one's too (kMaxNext). Also offers
// the centroids that may become the witness.
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
layout(scalar, binding = 12) readonly buffer U3Bounds { float u3_bounds[]; };

#include "shaders/lib/surface.glsl"
#include "shaders/lib/candidate.glsl"
#include "shaders/lib/child.glsl"
#include "shaders/lib/coverage.glsl"
#include "shaders/lib/stream.glsl"
#include "shaders/lib/witness.glsl"

struct Verdict {
  float upper;
  uint by;  // kCull*
};

// u3: pairs (i, j) of known triangles. A pair cannot beat the better of its two distances at the
// worst corner, so most pairs cost three minima.
void bound_pairs(Patch t, Known known, vec3 d[kMaxKnown], View view, float shift, float threshold,
                 inout Verdict v) {
  for (uint i = 1u; i < known.count; ++i) {
    Surface s = load_surface(known.triangle[i], view);
    for (uint j = 0u; j < i; ++j) {
      if (v.upper <= threshold) return;
      if (max3(min(d[i], d[j])) + shift >= v.upper) continue;
      Surface r = load_surface(known.triangle[j], view);
      float u3 = kept_bound(bound_pair(t, s, d[i], r, d[j]), shift);
      if (u3 < v.upper) v = Verdict(u3, kCullU3);
    }
  }
}

// u4: the pair of corners' own closest points, as points (eq. 12), for the two corners at the
// shortest edge.
Surface closest_point_surface(Two3 corner, uint triangle, View view) {
  Surface s = load_surface(triangle, view);
  Two3 offset = offset_from(corner, s, closest_point(rounded(corner), s.at));
  s.a = two_difference(
      corner,
      offset);  // its own rounding is under the slack, which counts for this point and for the next
  s.b = s.a;
  s.c = s.a;
  s.at = Corners(rounded(s.a), rounded(s.a), rounded(s.a));
  s.slack = round_up(2.0f * s.slack, 2.0f);
  return s;
}

void bound_u4(Patch t, uvec3 nearest, View view, float shift, inout Verdict v) {
  uint opposite = opposite_longest(Corners(t.at.a, t.at.b, t.at.c));
  Surface s[3];
  s[0] = closest_point_surface(t.a, nearest.x, view);
  s[1] = closest_point_surface(t.b, nearest.y, view);
  s[2] = closest_point_surface(t.c, nearest.z, view);
  for (uint k = 0u; k < 3u; ++k) {
    if (k == opposite) continue;
    vec3 da = corner_distances(t, s[opposite]);
    vec3 db = corner_distances(t, s[k]);
    float u4 = kept_bound(bound_pair(t, s[opposite], da, s[k], db), shift);
    if (u4 < v.upper) v = Verdict(u4, kCullU4);
  }
}

// The child's face of A is a face of B, too.
bool is_shared(uint root, Known known) {
  uvec3 f = faces[root];
  for (uint k = 0u; k < known.count; ++k) {
    if (lies_in(vertex_at(f.x), vertex_at(f.y), vertex_at(f.z), known.triangle[k])) return true;
  }
  return false;
}

Verdict bound_child(uint code, Child c, Root root, uint centre, float threshold) {
  Placement placed = place_corners(root, c.at);
  Patch t = make_patch(two(vec3(0.0)), placed.b, placed.c);
  View view = view_of(placed, (kSwitches & kUseCertificate) == 0u);
  float shift = placed.slack;
  Known known;
  known.count = 0u;
  know(known, centre);
  know(known, c.nearest.x);
  know(known, c.nearest.y);
  know(known, c.nearest.z);
  if ((kSwitches & kUseParentSamples) != 0u) know_parent_samples(code, known);

  if ((is_root(code) || control.base == 0.0) && is_shared(c.root, known))
    return Verdict(0.0, kCullHa);
  Verdict v = Verdict(c.upper, kCullLowerRaised);
  vec3 d[kMaxKnown];
  vec3 own = vec3(3.0e38);
  for (uint k = 0u; k < known.count; ++k) {
    d[k] = corner_distances(t, load_surface(known.triangle[k], view));
    own = min(own, d[k]);
    float ha = kept_bound(bound_single(d[k]), shift);
    if (ha < v.upper) v = Verdict(ha, kCullHa);
  }
  float simple = kept_bound(min(bound_u1(t, own), bound_u2(t, own)), shift);
  if (simple < v.upper) v = Verdict(simple, kCullU2);
  if (v.upper <= threshold) return v;
  if ((kSwitches & kUsePairs) != 0u) bound_pairs(t, known, d, view, shift, threshold, v);
  if (v.upper > threshold && (kSwitches & kUseU4) != 0u) bound_u4(t, c.nearest, view, shift, v);
  return v;
}

void main() {
  uint i = item_index();
  bool mine = i < control.count[kCountSurvivors];
  float threshold = cull_threshold((kSwitches & kUseToleranceCull) != 0u);
  Verdict v = Verdict(0.0, kCullCount);
  Candidate next;
  if (mine) {
    Point asked = centroids[i];
    if (is_new_lower(asked.distance)) atomicMin(control.witness_centroid_key, key_of_centroid(i));
    Child c = load_child(survivors[i]);
    uint centre = asked.distance >= 0.0 ? asked.nearest : kNone;
    v = bound_child(survivors[i], c, load_root(c.root), centre, threshold);
    if ((kSwitches & kUsePaperU3) != 0u && u3_bounds[i] < v.upper)
      v = Verdict(u3_bounds[i], kCullU3);
    close_area(v.upper <= threshold, c.root, c.at);
    next = Candidate(pack_corners(c.at), c.root, c.nearest, centre, v.upper);
  }
  bool closed = mine && v.upper <= threshold;
  bool open = mine && !closed;
  for (uint why = kCullU2; why <= kCullLowerRaised; ++why) count_culled(why, closed && v.by == why);
  raise(kMaxDropped, closed ? v.upper : 0.0);
  raise(kMaxNext, open ? v.upper : 0.0);
  uint slot = stream_append(kCountNext, open);
  if (open) frontier[writing(slot)] = next;
}
