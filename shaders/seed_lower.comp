// What: the first lower bound, to 48 bits above the base. In: vertex_distance in plain floats and
// their maximum, from which the base follows. Out: vertex_distance above the base, at least 0;
// vertex_nearest of the farthest, looked for again where the run is tight;
// control.maximum[kMaxLower].
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Nodes { Node nodes[]; };
layout(scalar, binding = 2) readonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 3) buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 4) buffer VertexDistance { float vertex_distance[]; };
layout(scalar, binding = 5) buffer ControlBlock { Control control; };
layout(scalar, binding = 6) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

#include "shaders/lib/bvh.glsl"
#include "shaders/lib/base.glsl"
#include "shaders/lib/stream.glsl"

void main() {
  uint i = item_index();
  float base = base_of_run();
  bool tight = is_tight(base);
  float d = 0.0;
  if (i < push.count && vertex_nearest[i] != kNone) {
    d = max(vertex_distance[i] - base, 0.0);
    if (tight && d > 0.0) {
      Two3 p = Two3(vertices[i].hi, vertices[i].lo);
      Nearest found = nearest_triangle(Query(p, base, true), vertex_nearest[i]);
      vertex_nearest[i] = found.triangle;
      d = max(found.above, 0.0);
    }
    vertex_distance[i] = d;
  }
  raise(kMaxLower, d);
}
