// What: the closest triangle of B to each vertex of A. First in plain floats: a warm run starts
// each walk from the triangle that the last run found, and queries the last run's witness as one
// more item. What the last run left may be anything: starts are checked, and the witness is moved
// into A, so that it costs time at worst. Then, where `push.again`, to 48 bits above the base,
// which follows from the maximum of the first; what is farthest is looked for once more where the
// run is tight. Also again for the witness alone, after a plan that has moved the base. In:
// vertices, faces; first, vertex_distance holds the states from seed_faces; where push.warm,
// vertex_nearest and control.witness. Out: vertex_nearest (kNone where no face uses the vertex),
// vertex_distance, again above the base and at least 0; control.maximum[kMaxVertex], again
// [kMaxLower]; where push.warm, control.witness.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(constant_id = 0) const uint kSwitches = kUseAll;
layout(local_size_x = kQueryGroup) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 2) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 3) buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 4) buffer VertexDistance { uint vertex_distance[]; };
layout(scalar, binding = 5) buffer ControlBlock { Control control; };
layout(scalar, binding = 6) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 7) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 8) readonly buffer Boxes { Box boxes[]; };
layout(scalar, push_constant) uniform PushBlock { SeedPush push; };

#include "shaders/lib/bvh.glsl"
#include "shaders/lib/base.glsl"
#include "shaders/lib/dispatch.glsl"
#include "shaders/lib/group_walk.glsl"
#include "shaders/lib/seed.glsl"
#include "shaders/lib/stream.glsl"

// The triangle to start from: what the last run left there, if it is one of B.
uint start_of(uint i) {
  if (push.warm == 0u) return kNone;
  uint start = i < push.vertex_count ? vertex_nearest[i] : control.witness.nearest;
  return start < push.triangle_count ? start : kNone;
}

// Makes the witness a sample of A, if it was none.
void clamp_witness() {
  control.witness.root = min(control.witness.root, control.face_count - 1u);
  control.witness.j = min(control.witness.j, kBaryOne);
  control.witness.k = min(control.witness.k, kBaryOne - control.witness.j);
}

// Adopts what was found for item i.
void answer(uint i, uint nearest, float distance) {
  if (i < push.vertex_count) {
    vertex_nearest[i] = nearest;
    vertex_distance[i] = floatBitsToUint(distance);
  } else {
    control.witness.nearest = nearest;
    control.witness.distance = distance;
  }
}

// A vertex that needs no query: on B, or of no face.
void settle(uint i, uint state) {
  vertex_nearest[i] = state >= kVertexOnB ? state - kVertexOnB : kNone;
  vertex_distance[i] = 0u;
}

// What an invocation knows of its item, and whether a walk is to find more.
struct Item {
  bool exists;  // it is to be answered
  bool asked;
  uint nearest;    // where a walk starts
  float distance;  // above the base
};

// `first`: of the invocations of an item. One alone: others may read the state later than it is
// written.
Item first_item(uint i, bool first) {
  uint state = i < push.vertex_count ? vertex_distance[i] : 0u;
  bool asked = first && (state == kVertexUsed || is_old_witness(i));
  if (first && i < push.vertex_count && !asked) settle(i, state);
  if (is_old_witness(i)) clamp_witness();
  return Item(asked, asked, asked ? start_of(i) : kNone, 0.0);
}

// As known in plain floats; a tight run looks again where that is over 0.
Item known_item(uint i, float base, bool tight) {
  bool is_vertex = i < push.vertex_count && vertex_nearest[i] != kNone;
  Item item = Item(is_vertex || is_old_witness(i), false, kNone, 0.0);
  if (!item.exists) return item;
  item.nearest = is_vertex ? vertex_nearest[i] : control.witness.nearest;
  float distance = is_vertex ? uintBitsToFloat(vertex_distance[i]) : control.witness.distance;
  item.distance = max(distance - base, 0.0);
  item.asked = tight && item.distance > 0.0;
  return item;
}

void main() {
  bool again = push.again != 0u;
  bool in_groups = kSpread && !again && push.vertex_count <= kGroupWalkVertices;
  uint lane = gl_LocalInvocationID.x;
  uint i = in_groups ? workgroup_index() : workgroup_index() * kQueryGroup + lane;
  float base = again ? max(base_of_run(), control.base) : 0.0;  // 0 before the first plan
  bool tight = again && (is_tight(base) || control.tight != 0u);
  Item item = again ? known_item(i, base, tight) : first_item(i, !in_groups || lane == 0u);
  Two3 p = seed_point(item.asked ? i : 0u);
  Query q = Query(p, base, tight);
  Nearest found = find_nearest(q, item.asked ? item.nearest : kNone, item.asked, in_groups);
  if (item.asked) {
    item.nearest = found.triangle;
    item.distance = sqrt(found.distance2);  // uncertified: steers; again measures what matters
    if (again) {
      found = measured(q, found, -1.0);
      item.nearest = found.triangle;
      item.distance = max(found.above, 0.0);
    } else if (i == push.vertex_count) {
      control.witness.position = p.hi;
    }
  }
  if (item.exists) answer(i, item.nearest, item.distance);
  raise(again ? kMaxLower : kMaxVertex, item.distance);
}
