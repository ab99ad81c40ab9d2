// Runs the cheap half of the cascade over every child, if centroids are queried or the paper's u3
// is on: exact case, u1, u2, ha with the triangles already known. In: the refined candidates,
// their splits and queried points; the admitted faces of A. Out: survivors (codes), and for each
// its centroid as a query that starts from the best single triangle. The u of every closed child is
// kept (kMaxClosed).
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/base/switches.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 2) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 3) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 4) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 5) readonly buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 6) readonly buffer Splits { Split splits[]; };
layout(scalar, binding = 7) readonly buffer Points { Point points[]; };
layout(scalar, binding = 8) buffer Survivors { uint survivors[]; };
layout(scalar, binding = 9) buffer Centroids { Point centroids[]; };
layout(scalar, binding = 10) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 11) buffer Areas { Area areas[]; };
layout(scalar, binding = 12) readonly buffer FaceShared { uint face_shared[]; };
layout(scalar, binding = 13) buffer CentroidNearest { uint centroid_nearest[]; };

#include "shaders/base/surface.glsl"
#include "shaders/wave/candidate.glsl"
#include "shaders/wave/centroid.glsl"
#include "shaders/wave/child.glsl"
#include "shaders/base/coverage.glsl"
#include "shaders/wave/dispatch.glsl"
#include "shaders/base/stream.glsl"

const uint kGroupChildren = kGroupSize;
#include "shaders/wave/known.glsl"

struct Verdict {
  float upper;
  uint by;    // kCull*
  uint best;  // triangle of the best ha
};

// Measures T against the next known triangle: keeps the smallest ha, and the corners' own distances
// for u1 and u2.
void measure(Patch t, uint triangle, View view, inout vec3 own, inout Verdict v, inout float ha) {
  vec3 d = corner_distances(t, load_surface(triangle, view));
  own = min(own, d);
  float h = bound_single(d);
  if (h < ha) {
    ha = h;
    v.best = triangle;
  }
}

Verdict filter_child(uint code, Child c, float threshold) {
  uint child = gl_LocalInvocationID.x;
  LocalCorners placed = placed_corners(c.root, c.at);
  Patch t = make_patch(two(vec3(0.0)), placed.b, placed.c);
  View view = view_of(placed, (kSwitches & kUseUncertified) != 0u);
  float shift = placed.slack;
  known_count[child] = 0u;
  add_known_corners(child, c);
  uint own_count = known_count[child];
  add_parent_samples(child, code);

  Verdict v = Verdict(c.upper, kCullU1, c.nearest.x);
  vec3 own = vec3(3.0e38);
  float ha = 3.0e38;
  for (uint k = 0u; k < known_count[child]; ++k) {
    if (k == own_count && v.upper <= threshold) return v;
    measure(t, known_to(child, k), view, own, v, ha);
    if (k + 1u == own_count) {
      float u1 = kept_bound(bound_u1(t, own), shift);
      float u2 = kept_bound(bound_u2(t, own), shift);
      v.by = own_count == 1u   ? kCullExact
             : u1 <= threshold ? kCullU1
             : u2 <= threshold ? kCullU2
                               : kCullHa;
      v.upper = min(v.upper, min(u1, u2));
    }
    if (k + 1u >= own_count) v.upper = min(v.upper, kept_bound(ha, shift));
  }
  return v;
}

void main() {
  uint code = item_index();
  bool mine = code < child_count() && is_child(code);
  float threshold = cull_threshold(lower_with_this_wave(), (kSwitches & kUseToleranceCull) != 0u);
  Verdict v = Verdict(0.0, kCullCount, kNone);
  Two3 centre = two(vec3(0.0));
  if (mine) {
    Child c = load_child(code);
    bool shared_face = is_root(code) && face_shared[c.root] != 0u;
    v = Verdict(0.0, kCullExact, kNone);
    if (!shared_face) v = filter_child(code, c, threshold);
    close_area(v.upper <= threshold, c.root, c.at);
    centre = position_of(root_at(c.root), centroid_of(c.at));
  }
  bool closed = mine && v.upper <= threshold;
  bool open = mine && !closed;
  for (uint why = kCullExact; why <= kCullHa; ++why) count_culled(why, closed && v.by == why);
  raise(kMaxClosed, closed ? v.upper : 0.0);
  uint slot = stream_append(kCountSurvivors, open);
  if (open) {
    survivors[slot] = code;
    // A negative distance tells the query to skip it.
    float asked = (kSwitches & kUseCentroid) != 0u ? 0.0 : -1.0;
    centroids[slot] = Point(centre.hi, v.best, centre.lo, asked);
  }
}
