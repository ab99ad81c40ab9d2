// Writes B's triangles at their vertices' new positions, in the order that they were sorted in, and
// the levels of the pyramid of boxes over them, as in bvh_leaves. In: triangles[].face, vertices,
// faces. Out: triangles, triangle_lows, boxes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/base/invocation.glsl"

layout(local_size_x = kRun) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 3) writeonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 4) coherent buffer Boxes { Box boxes[]; };
layout(scalar, binding = 5) buffer GroupsDone { uint groups_done; };
layout(scalar, push_constant) uniform PushBlock { PyramidPush push; };

#include "shaders/bvh/run_boxes.glsl"
#include "shaders/bvh/store_triangle.glsl"

void main() {
  uint i = workgroup_index() * kRun + gl_LocalInvocationID.x;
  Box own = empty_box();
  if (i < push.count) own = store_triangle(i, triangles[i].face);
  write_levels(own, push.count, push.quads, push.sixteens);
}
