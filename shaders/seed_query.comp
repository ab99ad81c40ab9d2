// What: the closest triangle of B to each vertex of A, and the first lower bound. A warm run starts
// each walk from the triangle that the last run found, and queries the last run's witness, wherever
// it is now, as one more item. What the last run left may be anything: starts are checked, and the
// witness is moved into A, so that it costs time at worst.
// In: vertices, faces; vertex_distance from seed_mark; where push.warm, vertex_nearest and
// control.witness. Out: vertex_nearest (kNone where no face uses the vertex), vertex_distance;
// control.maximum[kMaxLower]; where push.warm, control.witness.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) readonly buffer Nodes { Node nodes[]; };
layout(scalar, binding = 3) readonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 4) buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 5) buffer VertexDistance { float vertex_distance[]; };
layout(scalar, binding = 6) buffer ControlBlock { Control control; };
layout(scalar, binding = 7) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, push_constant) uniform PushBlock { SeedPush push; };

#include "shaders/lib/bvh.glsl"
#include "shaders/lib/root.glsl"
#include "shaders/lib/surface.glsl"
#include "shaders/lib/stream.glsl"

struct Query {
  Two3 at;
  uint start;
};

Query vertex_query(uint i) {
  return Query(vertex_at(i), push.warm != 0u ? vertex_nearest[i] : kNone);
}

Query witness_query() {
  control.witness.root = min(control.witness.root, control.face_count - 1u);
  control.witness.j = min(control.witness.j, kBaryOne);
  control.witness.k = min(control.witness.k, kBaryOne - control.witness.j);
  uvec2 at = uvec2(control.witness.j, control.witness.k);
  return Query(place(load_root(control.witness.root), at), control.witness.nearest);
}

void main() {
  uint i = item_index();
  bool is_vertex = i < push.vertex_count && vertex_distance[i] >= 0.0;
  bool is_witness = i == push.vertex_count && push.warm != 0u;
  float d = 0.0;
  if (i < push.vertex_count && !is_vertex) vertex_nearest[i] = kNone;
  if (is_vertex || is_witness) {
    Query q;
    if (is_vertex) {
      q = vertex_query(i);
    } else {
      q = witness_query();
    }
    Nearest found = nearest_triangle(q.at.hi, q.start < push.triangle_count ? q.start : kNone);
    d = steering_distance(q.at, found.triangle, found.distance2);
    if (is_vertex) {
      vertex_nearest[i] = found.triangle;
      vertex_distance[i] = d;
    } else {
      control.witness.position = q.at.hi;
      control.witness.distance = d;
      control.witness.nearest = found.triangle;
    }
  }
  raise(kMaxLower, d);
}
