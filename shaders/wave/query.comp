// Finds the closest triangle of B to each of some points: all queries of a run except the paper's
// packets (wave_packet). It is one kernel, since a traversal is most of the code that a driver
// compiles. push.asked selects the points:
//   the new points of a wave, or centroids. In: `points`, each with a triangle to start from; a
// negative distance means skip; or, if is_fused(), the frontier, whose candidates are split here
// (wave/split.glsl). Out: their nearest and distance; control.maximum[kMaxLower]; and for a split
// all that wave_subdivide writes but the points' positions.
//   A's vertices, in plain floats, at the start of a run, and the last run's witness behind them if
// push.warm (wave/seed.glsl). Out: vertex_nearest, vertex_distance; control.witness;
// control.maximum[kMaxVertex].
//   the same once more, or the witness alone if the base has moved, to 48 bits above the base,
// which follows from the maximum of the first. Out: the same; control.maximum[kMaxLower].
// An invocation traverses for a point of its own, or, if there are few, a whole workgroup for one
// (traversal/group_traversal.glsl).
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/base/switches.glsl"

layout(local_size_x = kQueryGroup) in;
layout(scalar, binding = 0) buffer ControlBlock { Control control; };
layout(scalar, binding = 1) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 2) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 3) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 4) readonly buffer Boxes { Box boxes[]; };
layout(scalar, binding = 5) buffer Points { Point points[]; };
layout(scalar, binding = 6) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 7) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 8) buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 9) buffer VertexDistance { uint vertex_distance[]; };
layout(scalar, binding = 10) buffer Frontier { Candidate frontier[]; };
layout(scalar, binding = 11) writeonly buffer Splits { Split splits[]; };
layout(scalar, binding = 12) buffer Areas { Area areas[]; };
layout(scalar, push_constant) uniform PushBlock { QueryPush push; };

#include "shaders/base/coverage.glsl"
#include "shaders/base/stream.glsl"
#include "shaders/wave/candidate.glsl"
#include "shaders/wave/dispatch.glsl"
#include "shaders/wave/no_centroid.glsl"
#include "shaders/wave/unsorted.glsl"
#include "shaders/traversal/group_traversal.glsl"
#include "shaders/traversal/query.glsl"
#include "shaders/wave/seed.glsl"
#include "shaders/wave/split.glsl"

// A wave whose plan has moved the base queries only its witness.
uint what_is_asked() {
  bool again = push.asked == kAskPoints && control.measuring != 0u;
  return again ? kAskVerticesAgain : push.asked;
}

bool are_points(uint asks) { return asks <= kAskCentroids; }

uint asked_count(uint asks) {
  if (asks == kAskPoints) return point_count();
  if (asks == kAskCentroids) return control.count[kCountSurvivors];
  return seed_count();
}

// Uses a whole workgroup for one point, or one invocation for each. The second pass over the
// vertices has few traversals, and does not know which.
bool are_few(uint asks, uint count) {
  if (is_fused() && asks == kAskPoints) return splits_in_groups();
  bool few_vertices = asks == kAskVertices && push.vertex_count <= kGroupTraversalVertices;
  // The test is repeated here so that optimisers leave out the group's traversal.
  return traverses_by_group() && (are_points(asks) ? traverses_in_groups(count) : few_vertices);
}

Item item_at(uint asks, uint i, bool mine) {
  if (are_points(asks)) return point_item(mine ? i : 0u, mine);
  return asks == kAskVertices ? first_item(i, mine) : known_item(i, mine);
}

// Splits a candidate for a fused query, and takes a new point of it. A workgroup has all new points
// of some candidates, or one point, which all its invocations traverse for: then every workgroup of
// a candidate works out its split, and the candidate's first workgroup, that of its first point,
// keeps it. `i`: the number of the point in the wave.
Item new_item(bool by_group, out uint i) {
  uint each = points_each();
  uint lane = gl_LocalInvocationID.x;
  uint group = by_group ? 0u : lane / each;
  uint item = workgroup_index() * candidates_a_group() + group;
  uint k = lane % each;
  bool first = k == 0u;
  if (!by_group && group >= candidates_a_group()) item = kNone;
  if (by_group) {
    item = workgroup_index() / each;
    k = workgroup_index() % each;
    first = k == 0u && lane == 0u;
    // The candidate's first workgroup also keeps the splits of its children. new_point() records a
    // child's split at that child's first point, so each of the first lanes works out one point.
    if (k == 0u && lane < each) k = lane;
  }
  Refined r = refine(item, by_group ? lane == 0u : first, group);
  bool mine = r.slot != kNone;
  NewPoint n = NewPoint(two(vec3(0.0)), kNone, false);
  if (mine) n = new_point(k, r, group);
  keep_split(r, first, group);
  i = each * r.slot + k;
  mine = mine && (!by_group || lane == 0u);
  return Item(mine, mine && n.asked, n.start, -1.0,
              Query(n.p, control.base, control.tight != 0u, is_fine(control.base)));
}

void main() {
  uint asks = what_is_asked();
  uint count = asked_count(asks);
  bool by_group = are_few(asks, count);
  uint lane = gl_LocalInvocationID.x;
  uint i = by_group ? workgroup_index() : workgroup_index() * kQueryGroup + lane;
  bool mine = i < count && (!by_group || lane == 0u);
  Item item;
  if (is_fused() && asks == kAskPoints) {
    item = new_item(by_group, i);
  } else {
    item = item_at(asks, i, mine);
  }
  Nearest found = find_nearest(item.query, item.nearest, item.asked, by_group);
  bool plain = asks == kAskVertices;
  if (item.asked) {
    // A wave looks for samples farther than the witness. This is not kMaxLower, since other
    // invocations raise it meanwhile.
    float than = are_points(asks) ? control.witness.distance : -1.0;
    if (!plain) found = measured(item.query, found, than);
    item.nearest = found.triangle;
    item.distance = max(found.above, 0.0);
    // The distance in plain floats only steers; the second pass measures the distances that matter.
    if (plain) item.distance = root(found.distance2);  // uncertified: steers
  }
  if (are_points(asks)) {
    if (item.exists) answer_point(i, item.nearest, item.distance);
  } else if (item.exists) {
    answer_vertex(i, item);
  }
  raise(plain ? kMaxVertex : kMaxLower, item.distance);
}
