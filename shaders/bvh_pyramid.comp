// What: one level of the pyramid of boxes over the sorted triangles: each box joins kPyramidFan
// neighbours of the level below. In: triangles, or the level below in boxes. Out: this level in
// boxes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/gpu_types.h"
#include "shaders/lib/invocation.glsl"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Triangles { Triangle triangles[]; };
layout(scalar, binding = 1) buffer Boxes { Box boxes[]; };
layout(scalar, push_constant) uniform PushBlock { PyramidPush push; };

#include "shaders/lib/box.glsl"

void main() {
  uint i = item_index();
  uint begin = i * kPyramidFan;
  if (begin >= push.from_count) return;
  uint end = min(begin + kPyramidFan, push.from_count);
  Box b = empty_box();
  for (uint k = begin; k < end; ++k) {
    if (push.from_triangles != 0u) {
      b = joined(b, triangle_box(k));
    } else {
      b = joined(b, boxes[push.from + k]);
    }
  }
  boxes[push.to + i] = b;
}
