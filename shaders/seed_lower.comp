// What: the first lower bound, to 48 bits above the base. In: vertex_distance in plain floats and
// their maximum, from which the base follows; in a warm run control.witness likewise. Out:
// vertex_distance above the base, at least 0; vertex_nearest of the farthest, looked for again
// where the run is tight; in a warm run control.witness likewise; control.maximum[kMaxLower].
// Also for the witness alone, after a plan that has moved the base.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lib/invocation.glsl"
#include "shaders/gpu_types.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Nodes { uvec4 nodes[]; };
layout(scalar, binding = 2) readonly buffer Triangles { uvec4 triangles[]; };
layout(scalar, binding = 3) buffer VertexNearest { uint vertex_nearest[]; };
layout(scalar, binding = 4) buffer VertexDistance { float vertex_distance[]; };
layout(scalar, binding = 5) buffer ControlBlock { Control control; };
layout(scalar, binding = 6) readonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 7) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, push_constant) uniform PushBlock { SeedPush push; };

#include "shaders/lib/bvh.glsl"
#include "shaders/lib/base.glsl"
#include "shaders/lib/seed.glsl"
#include "shaders/lib/stream.glsl"

// A sample as known in plain floats, above the base; a tight run looks again where that is over 0.
Nearest look_again(uint i, uint nearest, float distance, float base, bool tight) {
  Nearest known = Nearest(nearest, 0.0, max(distance - base, 0.0));
  if (!tight || known.above == 0.0) return known;
  Query q = Query(seed_point(i), base, true);
  known = measured(q, nearest_triangle(q, nearest), -1.0);
  known.above = max(known.above, 0.0);
  return known;
}

void main() {
  uint i = item_index();
  float base = max(base_of_run(), control.base);  // 0 before the first plan
  bool tight = is_tight(base) || control.tight != 0u;
  bool is_vertex = i < push.vertex_count && vertex_nearest[i] != kNone;
  float d = 0.0;
  if (is_vertex || is_old_witness(i)) {
    Nearest found =
        look_again(i, is_vertex ? vertex_nearest[i] : control.witness.nearest,
                   is_vertex ? vertex_distance[i] : control.witness.distance, base, tight);
    d = found.above;
    if (is_vertex) {
      vertex_nearest[i] = found.triangle;
      vertex_distance[i] = d;
    } else {
      control.witness.nearest = found.triangle;
      control.witness.distance = d;
    }
  }
  raise(kMaxLower, d);
}
