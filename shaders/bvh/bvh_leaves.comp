// Writes B's triangles in Morton order, and the levels of the pyramid of boxes over them, all of up
// to kRun^2 triangles (bvh/run_boxes.glsl). In: keys and values (sorted codes and face numbers),
// vertices, faces. Out: triangles, triangle_lows, codes, boxes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/base/invocation.glsl"

layout(local_size_x = kRun) in;
layout(scalar, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(scalar, binding = 1) readonly buffer Faces { uvec3 faces[]; };
layout(scalar, binding = 2) readonly buffer Values { uint values[]; };
layout(scalar, binding = 3) writeonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 4) writeonly buffer TriangleLows { TriangleLow triangle_lows[]; };
layout(scalar, binding = 5) readonly buffer Keys { uint keys[]; };
layout(scalar, binding = 6) writeonly buffer Codes { uint codes[]; };
layout(scalar, binding = 7) coherent buffer Boxes { Box boxes[]; };
layout(scalar, binding = 8) buffer GroupsDone { uint groups_done; };
layout(scalar, push_constant) uniform PushBlock { PyramidPush push; };

#include "shaders/bvh/run_boxes.glsl"
#include "shaders/bvh/store_triangle.glsl"

void main() {
  uint i = workgroup_index() * kRun + gl_LocalInvocationID.x;
  Box own = empty_box();
  if (i < push.count) {
    codes[i] = keys[i];
    own = store_triangle(i, values[i]);
  }
  write_levels(own, push.count, push.quads, push.sixteens);
}
