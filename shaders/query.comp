// What: the closest triangle of B to each of some points: all that a run asks for but the witness's
// after a GPU's plan has moved the base (wave_plan), and the paper's packets (wave_packet). One
// kernel, for a walk is most of the code that a driver compiles. push.asked says which points:
//   the new points of a wave, or centroids. In: `points`, each with a triangle to start from; a
// negative distance means skip. Out: their nearest and distance; control.maximum[kMaxLower].
//   A's vertices, in plain floats, at the start of a run, and the last run's witness behind them
// where push.warm (lib/seed.glsl). Out: vertex_nearest, vertex_distance; control.witness;
// control.maximum[kMaxVertex].
//   the same once more, or the witness alone where the base has moved, to 48 bits above the base,
// which follows from the maximum of the first. Out: the same; control.maximum[kMaxLower].
// An invocation walks for a point of its own, or, where there are few, all of a workgroup for one
// (lib/group_walk.glsl).
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(constant_id = 0) const uint kSwitches = kUseAll;
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
layout(scalar, push_constant) uniform PushBlock { QueryPush push; };

#include "shaders/lib/bvh.glsl"
#include "shaders/lib/base.glsl"
#include "shaders/lib/generations.glsl"
#include "shaders/lib/dispatch.glsl"
#include "shaders/lib/group_walk.glsl"
#include "shaders/lib/query.glsl"
#include "shaders/lib/seed.glsl"
#include "shaders/lib/stream.glsl"

bool asks_for_points() { return push.asked <= kAskCentroids; }

uint asked_count() {
  if (push.asked == kAskPoints) return point_count();
  if (push.asked == kAskCentroids) return control.count[kCountSurvivors];
  return seed_count();
}

// All of a workgroup for one point, or an invocation for each. The second pass over the vertices
// has few walks, and does not know which.
bool are_few(uint count) {
  bool few_vertices = push.asked == kAskVertices && push.vertex_count <= kGroupWalkVertices;
  // kSpread once more: optimisers then leave the group's walk out.
  return kSpread && (asks_for_points() ? walks_in_groups(count) : few_vertices);
}

Item item_at(uint i, bool mine) {
  if (asks_for_points()) return point_item(mine ? i : 0u, mine);
  return push.asked == kAskVertices ? first_item(i, mine) : known_item(i, mine);
}

void main() {
  uint count = asked_count();
  bool by_group = are_few(count);
  uint lane = gl_LocalInvocationID.x;
  uint i = by_group ? workgroup_index() : workgroup_index() * kQueryGroup + lane;
  bool mine = i < count && (!by_group || lane == 0u);
  Item item = item_at(i, mine);
  Nearest found = find_nearest(item.query, item.nearest, item.asked, by_group);
  bool plain = push.asked == kAskVertices;
  if (item.asked) {
    // A wave looks for samples farther than the witness. Not kMaxLower: others raise it meanwhile.
    float than = asks_for_points() ? control.witness.distance : -1.0;
    if (!plain) found = measured(item.query, found, than);
    item.nearest = found.triangle;
    item.distance = max(found.above, 0.0);
    // In plain floats it steers; the second pass measures what matters.
    if (plain) item.distance = sqrt(found.distance2);  // uncertified: steers
  }
  if (asks_for_points()) {
    if (item.asked) answer_point(i, item.nearest, item.distance);
  } else if (item.exists) {
    answer_vertex(i, item);
  }
  raise(plain ? kMaxVertex : kMaxLower, item.distance);
}
