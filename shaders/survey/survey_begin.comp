// Makes each face of A a cell, with the one bound that no distance is above `farthest`.
// Out: cells, bounds, near_corners, classes, one per face.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/base/invocation.glsl"
#include "shaders/math/dyadic.h"

layout(local_size_x = kGroupSize) in;
layout(scalar, binding = 0) writeonly buffer Cells { Cell cells[]; };
layout(scalar, binding = 1) writeonly buffer Bounds { CellBounds bounds[]; };
layout(scalar, binding = 2) writeonly buffer Classes { uint classes[]; };
layout(scalar, binding = 3) writeonly buffer NearCorners { CornerTriangles near_corners[]; };
layout(scalar, push_constant) uniform PushBlock { SurveyBeginPush push; };

void main() {
  uint i = item_index();
  if (i >= push.faces) return;
  float most = push.farthest;
  cells[i] = Cell(pack_corners(whole_root()), i, kNone);
  bounds[i] = CellBounds(0.0, 0.0, 0.0, most, most, most, most, 0.0, most, 3.0e38, kNone, kNone,
                         kNone, kNone, kNone);
  near_corners[i] = CornerTriangles(kNone, kNone, kNone);
  classes[i] = kClassUnseen;
}
