// Computes levels of the pyramid of boxes over the sorted triangles, from one level: over runs of
// 4, 16, 64 and 256 of its boxes, and, by the last workgroup, the levels above these. In: the one
// level, in boxes. Out: the levels above it, in boxes. The kernels that write the triangles also
// write the levels over them (bvh_leaves, bvh_move).
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/base/invocation.glsl"

layout(local_size_x = kRun) in;
layout(scalar, binding = 0) coherent buffer Boxes { Box boxes[]; };
layout(scalar, binding = 1) buffer GroupsDone { uint groups_done; };
layout(scalar, push_constant) uniform PushBlock { PyramidPush push; };

#include "shaders/bvh/run_boxes.glsl"

void main() {
  uint i = workgroup_index() * kRun + gl_LocalInvocationID.x;
  Box own = empty_box();
  if (i < push.count) own = boxes[push.from + i];
  write_levels(own, push.count, push.quads, push.sixteens);
}
