// What: the closest triangle of B to each vertex of A, in plain floats. A warm run starts each walk
// from the triangle that the last run found, and queries the last run's witness as one more item.
// What the last run left may be anything: starts are checked, and the witness is moved into A, so
// that it costs time at worst.
// In: vertices, faces; vertex_distance holds the states from seed_faces; where push.warm,
// vertex_nearest and control.witness. Out: vertex_nearest (kNone where no face uses the vertex),
// vertex_distance; control.maximum[kMaxVertex]; where push.warm, control.witness.
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

// Adopts what was found for item i; returns its distance.
float answer(uint i, vec3 p, Nearest found) {
  float d = sqrt(found.distance2);  // uncertified: steers; seed_lower measures what matters
  if (i < push.vertex_count) {
    vertex_nearest[i] = found.triangle;
    vertex_distance[i] = floatBitsToUint(d);
  } else {
    control.witness.position = p;
    control.witness.nearest = found.triangle;
    control.witness.distance = d;
  }
  return d;
}

// A vertex that needs no query: on B, or of no face.
void settle(uint i, uint state) {
  vertex_nearest[i] = state >= kVertexOnB ? state - kVertexOnB : kNone;
  vertex_distance[i] = 0u;
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  bool in_groups = kSpread && push.vertex_count <= kGroupWalkVertices;
  uint i = in_groups ? workgroup_index() : workgroup_index() * kQueryGroup + lane;
  uint state = i < push.vertex_count ? vertex_distance[i] : 0u;
  bool is_asked = state == kVertexUsed || is_old_witness(i);
  // One alone: others of the group may read the state later than it is written.
  bool first = !in_groups || lane == 0u;
  bool asked = is_asked && first;
  if (first && i < push.vertex_count && !asked) settle(i, state);
  if (is_old_witness(i)) clamp_witness();
  uint at = asked ? i : 0u;
  Two3 p = seed_point(at);
  Nearest found =
      find_nearest(Query(p, 0.0, false), asked ? start_of(at) : kNone, asked, in_groups);
  raise(kMaxVertex, asked ? answer(at, p.hi, found) : 0.0);
}
