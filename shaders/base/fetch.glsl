// Nodes and triangles in whole 16-byte loads: the buffers that traversals read are declared as
// arrays of uvec4, and this file repeats the layout of Node and Triangle (gpu_types.h). The kernel
// declares `triangles`.
#ifndef VKH_SHADERS_BASE_FETCH_GLSL
#define VKH_SHADERS_BASE_FETCH_GLSL

#include "shaders/math/triangle.h"

const uint kTriangleWords = 3u;
const uint kNodeWords = 8u;

Corners triangle_corners(uint i) {
  Corners t;
  t.a = uintBitsToFloat(triangles[kTriangleWords * i].xyz);
  t.b = uintBitsToFloat(triangles[kTriangleWords * i + 1u].xyz);
  t.c = uintBitsToFloat(triangles[kTriangleWords * i + 2u].xyz);
  return t;
}

#endif
