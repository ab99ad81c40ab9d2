// Raises each face's highest to that of its cells. In: cells, bounds. Out: faces_highest, floats as
// bits.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/math/certified.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) readonly buffer Cells { Cell cells[]; };
layout(scalar, binding = 1) readonly buffer Bounds { CellBounds bounds[]; };
layout(scalar, binding = 2) buffer FacesHighest { uint faces_highest[]; };
layout(scalar, push_constant) uniform PushBlock { CountPush push; };

void main() {
  uint i = item_index();
  if (i < push.count) atomicMax(faces_highest[cells[i].face], bits_of(bounds[i].highest));
}
