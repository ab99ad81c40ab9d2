// Finds the face of B that is closest to each of some points, with a certified enclosure of the
// distance d; one item per point. In: asked; B's BVH. Out: found[point]. One traversal, in plain
// floats, finds a triangle that is near; its distance, rounded up, is the reach of another, which
// bounds the distance of each triangle within it from both sides. Boxes beyond the reach hold
// nothing that is closer than that triangle. If more than kClosestTriangles are within the reach,
// the boxes that are left stand for their triangles. Each result depends on its point alone. If B
// is no mesh or was not built (push.triangle_count is 0), ends are NaN.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 2) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 3) readonly buffer BFault { uint b_fault; };
layout(scalar, binding = 4) readonly buffer Asked { Vertex asked[]; };
layout(scalar, binding = 5) writeonly buffer Found { ClosestFace found[]; };
layout(scalar, push_constant) uniform PushBlock { ClosestPush push; };

#define control push  // there is no run; base/surface.glsl reads only `two_float`
#include "shaders/traversal/traversal.glsl"

const vec3 kHere = vec3(0.0);  // the point, which is the local origin

// A box is off by the low parts of what is in it and of the point, an ulp of each, and its distance
// by its own rounding (docs/certificate.md).
float box_doubt(View from, float distance) { return 4.0 * kUlp * (from.reach + distance); }

// Boxes at this distance, squared, or farther hold nothing that is closer than `within`.
float reach2_of(View from, float within) {
  float far = round_up(within + box_doubt(from, within), 8.0);
  return min(round_up(far * far, 8.0), 3.0e38);
}

// A lower bound of the distance of everything in a box that is at this distance, squared.
float box_distance_down(View from, float distance2) {
  float d = root(min(distance2, 1.0e37));
  return max(round_down(d, 8.0) - box_doubt(from, d), 0.0);
}

// The bounds so far, above the base.
struct Bounds {
  float lower;    // of the triangles examined, and of what else may be closest
  float upper;    // of the closest one
  uint triangle;  // that one
  uint close;     // triangles that were not surely farther
};

// Bounds the distance of triangle i from both sides: to 48 bits if it may be the closest, unless
// there were too many of these.
Bounds examined(Bounds b, View from, uint i) {
  Surface s = load_surface(i, from);
  Closest c = closest_point(kHere, s.at);
  float lower = distance_down(s, c, choose(b.close < kClosestSharp, b.upper, -3.0e38));
  b.lower = min(b.lower, lower);
  if (lower >= b.upper) return b;
  ++b.close;
  float upper = distance_to_up(two(kHere), s, c);
  bool closer = upper < b.upper || (upper == b.upper && i < b.triangle);
  b.upper = choose(closer, upper, b.upper);
  b.triangle = choose(closer, i, b.triangle);
  return b;
}

// Adds the boxes that are left.
Bounds with_boxes(Bounds b, View from, float reach2, inout uint to_go) {
  for (uint k = 0u; k < left_count; ++k) {
    if (left_distance2[k] < reach2)
      b.lower = min(b.lower, lowered(box_distance_down(from, left_distance2[k]) - from.base));
    --to_go;
  }
  return b;
}

// Examines all triangles within `within`, an upper bound of the distance of triangle `nearest`.
// Bounds from below need all of them, and drivers may end a loop early (docs/certificate.md, 'Loops
// that a driver ends'): the loops' work is counted, and not by the variable that ends them, which
// compilers take as known behind them. The first traversal's early end ends these loops, too.
Bounds bounds_within(View from, float within, uint nearest) {
  float reach2 = reach2_of(from, within);
  // Triangles beyond the reach are no closer than `within`.
  Bounds b = Bounds(lowered(within - from.base), raised(within - from.base), nearest, 0u);
  uint not_leaves = 0u;
  uint found_count = 0u;
  uint looked_at = 0u;
  left_count = 0u;
  traversal_at = 0u;
  while (traversal_at != kNone && looked_at < kClosestTriangles) {
    while ((traversal_at & kLeafFlag) == 0u)
      traversal_at = step_down(traversal_at, from.origin.hi, reach2);
    if (traversal_at == kNone) break;
    not_leaves += 1u - (traversal_at >> 31);
    uint first = traversal_at & (kMaxTriangles - 1u);
    uint last = first + ((traversal_at >> 28) & 7u);
    found_count += last - first + 1u;
    for (uint i = first; i <= last; ++i) {
      b = examined(b, from, i);
      ++looked_at;
    }
    traversal_at = pop(reach2);
  }
  if (traversal_at != kNone) ++left_count;  // the box taken from the top is left, too
  uint to_go = left_count;
  b = with_boxes(b, from, reach2, to_go);
  if (not_leaves != 0u || looked_at != found_count || to_go != 0u) b.lower = kSearchEnded;
  return b;
}

ClosestFace closest_of(Two3 p) {
  Nearest near = nearest_triangle(Query(p, 0.0, false, false), kNone);
  uint nearest = min(near.triangle, push.triangle_count - 1u);
  View coarse = View(p, norm_up(p.hi), 0.0, false, false, 3.0e38, false);
  float within = surface_distance_up(two(kHere), load_surface(nearest, coarse));
  // The base is next to the distance; any is right.
  float base = min(root(near.distance2), within);  // uncertified: steers
  Bounds b = bounds_within(view_from(p, base, false), within, nearest);
  return ClosestFace(base, b.lower, b.upper, triangles[kTriangleWords * b.triangle].w);
}

void main() {
  uint i = item_index();
  if (i >= push.count) return;
  if (push.triangle_count == 0u || b_fault != kNone) {
    float nan = uintBitsToFloat(0x7fc00000u);
    found[i] = ClosestFace(nan, nan, nan, kNone);
    return;
  }
  found[i] = closest_of(Two3(asked[i].hi, asked[i].lo));
}
